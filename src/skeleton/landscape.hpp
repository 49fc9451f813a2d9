// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway::detail {

/// What one look at every traversable voxel and its neighbours tells.
struct Landscape {
  Basins basins;                  ///< without passes and dynamics
  std::vector<VoxelId> critical;  ///< peaks and possible passes, in the order of voxels
};

/// Leads every voxel to its peak by the steepest of the ways that do not dip.
Landscape survey(const EsdfMap& esdf, const VoxelMask& traversable);

}  // namespace ridgeway::detail
