// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway::detail {

/// What one look at every traversable voxel and its neighbours tells.
struct Watershed {
  Basins basins;                  ///< without passes and dynamics
  std::vector<VoxelId> critical;  ///< peaks and possible passes, in the order of voxels
};

/// Leads every voxel to its peak by the steepest of the ways that do not dip.
///
/// Plain form: plain_watershed.hpp, plain_climb() for each voxel. From it, docs/fast-kernels.md
/// section 3: critical voxels by a local test (2), peaks by whole blocks (7), four voxels at a time
/// (8); voxels not simple at their first turn, section 4 (2).
Watershed find_watershed(const EsdfMap& esdf, const VoxelMask& traversable);

}  // namespace ridgeway::detail
