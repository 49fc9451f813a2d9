// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway::detail {

/// Some blocks of a layout, to be asked whether a box touches any of them: in eight look-ups,
/// however large the box. Of blocks that are too far apart for that it says that all boxes do.
class ChangedBlocks {
 public:
  ChangedBlocks() = default;
  /// By slot; those named twice count once.
  ChangedBlocks(const BlockLayout& layout, std::span<const std::uint32_t> slots);

  /// Whether they are too far apart.
  bool are_all() const { return are_all_; }
  /// Whether a box touches one; its corners are in voxels.
  bool touch(const Point& low, const Point& high) const;

 private:
  std::uint32_t& sum(int x, int y, int z);
  std::uint32_t sum_up_to(int x, int y, int z) const;

  // How many there are up to each block of the box around them.
  BlockIndex low_{}, extent_{};
  std::vector<std::uint32_t> sums_;
  bool are_all_ = false;
};

}  // namespace ridgeway::detail
