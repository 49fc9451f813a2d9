// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// A few voxels of a layout: found block by block, and forgotten, in time that follows their
/// number. Invariant: blocks that `slots` does not name hold none.
struct MarkedVoxels {
  VoxelMask voxels;
  VoxelMask lowered;                 ///< those of them that obstacles came nearer to; for sweeps
  std::vector<std::uint32_t> slots;  ///< of blocks that may hold some, ascending, each once

  void grow(const BlockLayout& layout) {
    voxels.grow(layout);
    lowered.grow(layout);
  }
  /// Where it is not for sweeps.
  void grow_voxels(const BlockLayout& layout) { voxels.grow(layout); }

  void clear() {
    voxels.clear();
    lowered.clear();
    slots.clear();
  }

  /// Names blocks in which voxels were marked; in any order, some of them maybe twice.
  void name(const std::vector<std::uint32_t>& blocks) {
    slots.insert(slots.end(), blocks.begin(), blocks.end());
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  }

  std::size_t count() const {
    std::size_t total = 0;
    for (const std::uint32_t slot : slots)
      for (const std::uint64_t layer : voxels.block(slot))
        total += static_cast<std::size_t>(std::popcount(layer));
    return total;
  }
};

}  // namespace ridgeway::detail
