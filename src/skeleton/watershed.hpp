// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway::detail {

/// What one look at every traversable voxel and its neighbours tells.
struct Watershed {
  Basins basins;                  ///< without passes and dynamics
  std::vector<VoxelId> critical;  ///< peaks and possible passes, in the order of voxels
};

/// What the look at one block's voxels tells, but for the directions.
struct BlockWays {
  std::uint32_t top = 0;  ///< highest level
  bool has_peak = false;
  std::vector<VoxelId> critical;  ///< ascending
};

/// What is known of each block by itself: of its voxels and those around them alone.
struct LocalWays {
  VoxelField<Direction> next;  ///< as in Basins
  VoxelMask not_simple_at_first_turn;
  std::vector<BlockWays> blocks;  ///< by slot

  /// Follows a layout to which blocks were added since, none of whose voxels is traversable.
  void grow(const BlockLayout& layout);
};

/// Looks at the voxels of some blocks, each named once; the others stay as they are.
void look_at_blocks(const EsdfMap& esdf, const VoxelMask& traversable,
                    std::span<const std::uint32_t> slots, LocalWays& ways);

/// Numbers the basins. `basins` has the local results; blocks those that belong to it.
Watershed watershed_of(const EsdfMap& esdf, const VoxelMask& traversable,
                       const std::vector<BlockWays>& blocks, Basins basins);

/// Leads every voxel to its peak by the steepest of the ways that do not dip.
///
/// Plain form: plain_watershed.hpp, plain_climb() for each voxel. From it, docs/fast-kernels.md
/// section 3: critical voxels by a local test (2), peaks by whole blocks (7), four voxels at a time
/// (8); voxels not simple at their first turn, section 4 (2).
Watershed find_watershed(const EsdfMap& esdf, const VoxelMask& traversable);

/// The rest of find_basins.
Basins find_passes(const EsdfMap& esdf, const VoxelMask& traversable, double radius,
                   Watershed watershed);

}  // namespace ridgeway::detail
