// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/sensing/world.hpp"
#include "support/random_maps.hpp"

namespace ridgeway::testing {

/// What a perfect survey would find of a world within a box of metres: voxels whose centre is
/// within half a voxel of a surface, or behind one, are occupied, all others free.
inline OccupancyMap map_of_world(const World& world, double voxel_size, const Point& low,
                                 const Point& high) {
  return make_map(
      voxel_size, voxel_at(low, voxel_size), voxel_at(high, voxel_size), [&](const VoxelIndex& v) {
        const Point centre = centre_of(v, voxel_size);
        return surface_distance(world, centre).distance < 0.5 * voxel_size ? VoxelState::kOccupied
                                                                           : VoxelState::kFree;
      });
}

}  // namespace ridgeway::testing
