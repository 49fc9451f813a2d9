// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::testing {

/// All voxels whose centre a sphere fits at, or those of a set.
inline std::vector<VoxelId> traversable_places(const EsdfMap& esdf, double radius,
                                               const VoxelMask* within = nullptr) {
  std::vector<VoxelId> places;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (esdf.is_open(id) && esdf.squared[id] >= least_clearance(radius, esdf.voxel_size) &&
        (within == nullptr || within->test(id)))
      places.push_back(id);
  return places;
}

}  // namespace ridgeway::testing
