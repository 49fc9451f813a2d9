// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::testing {

/// What a map knows of a voxel of the lattice, wherever the map's own voxels begin.
inline VoxelState state_at(const OccupancyMap& map, const VoxelIndex& lattice) {
  return map.at(lattice - map.origin);
}

/// Centre of a voxel in the world.
template <typename Map>
Point centre_in_world(const Map& map, VoxelId id) {
  return to_world(map, centre_of(map.layout.index_of(id), map.voxel_size));
}

}  // namespace ridgeway::testing
