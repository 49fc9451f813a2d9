// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>

#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway::detail {

/// The first and the last voxel of the box around all blocks of a layout; without any it is empty.
struct LayoutBox {
  VoxelIndex low{kMaxVoxelIndex, kMaxVoxelIndex, kMaxVoxelIndex}, high = VoxelIndex{} - low;

  explicit LayoutBox(const BlockLayout& layout) {
    if (layout.block_count() == 0) return;
    BlockIndex first = layout.block(0), last = first;
    for (const BlockIndex& b : layout.blocks()) {
      first = {std::min(first.x, b.x), std::min(first.y, b.y), std::min(first.z, b.z)};
      last = {std::max(last.x, b.x), std::max(last.y, b.y), std::max(last.z, b.z)};
    }
    low = voxel_of(first, 0);
    high = voxel_of(last, kBlockVoxels - 1);
  }

  /// Whether it shares a voxel with the box from `first` to `last`, both inclusive.
  bool meets(const VoxelIndex& first, const VoxelIndex& last) const {
    return first.x <= high.x && last.x >= low.x && first.y <= high.y && last.y >= low.y &&
           first.z <= high.z && last.z >= low.z;
  }
};

}  // namespace ridgeway::detail
