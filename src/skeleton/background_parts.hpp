// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/voxel/voxel_mask.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {

/// The 6-connected parts of all that is not in a set of voxels, blocks that are not allocated
/// included: one part surrounds everything, the others float in the set. Blocks without a member
/// count as not allocated: it takes time that follows the set.
class BackgroundParts {
 public:
  BackgroundParts(const BlockLayout& layout, const VoxelMask& voxels);

  /// Whether anything floats.
  bool is_one() const { return is_one_; }

  /// A number that all voxels of a part share, of a voxel that is not in the set.
  std::uint32_t part_of(const VoxelIndex& voxel) { return sets_.find(number_of(voxel)); }

  /// The number of a part as it is after all joins so far.
  std::uint32_t find(std::uint32_t part) { return sets_.find(part); }

  /// From now on two parts are one.
  void join(std::uint32_t a, std::uint32_t b) { sets_.join(a, b); }

 private:
  /// A row of blocks along x in which some have members, from the first to the last of them.
  struct Row {
    int y, z, first_x, last_x;
    std::uint32_t first_gap, gaps;
  };
  /// Between two blocks of a row.
  struct Gap {
    int first_x, last_x;
  };

  void find_blocks(const VoxelMask& voxels);
  void find_gaps();
  void join_gaps();
  void find_parts(const VoxelMask& voxels);
  void join_parts();
  const Row* row_at(int y, int z) const;
  std::uint32_t number_of(const VoxelIndex& voxel) const;
  std::uint32_t number_outside(const BlockIndex& block) const;
  /// Among the blocks with members; BlockLayout::kNoBlock for others.
  std::uint32_t place_of(std::uint32_t slot) const {
    return slot == BlockLayout::kNoBlock ? slot : place_of_[slot];
  }

  const BlockLayout& layout_;
  std::vector<std::uint32_t> slots_;     // of blocks with members, in the order of blocks
  std::vector<std::uint32_t> place_of_;  // among these, by slot
  std::vector<Row> rows_;                // by (z, y)
  std::vector<Gap> gaps_;                // by row, then x
  // Of each of those blocks' voxels that are not in the set, their parts inside the block.
  std::vector<std::vector<VoxelMask::Block>> parts_;
  std::vector<std::uint32_t> first_part_;
  // Numbers: 0 is what no row encloses, then come gaps, then parts of blocks.
  DisjointSets sets_{0};
  bool is_one_ = true;
};

}  // namespace ridgeway::detail
