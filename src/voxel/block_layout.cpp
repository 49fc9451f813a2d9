// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/block_layout.hpp"

#include <algorithm>
#include <bit>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
BlockLayout::BlockLayout(std::vector<BlockIndex> blocks) : blocks_(std::move(blocks)) {
  std::sort(blocks_.begin(), blocks_.end());
  blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
  if (blocks_.size() >= (1u << 23)) {
    throw InputError("map", "needs more than 8 million blocks of 8x8x8 voxels",
                     "use a larger --voxel-size or smaller --bounds");
  }
  table_.assign(std::bit_ceil(2 * blocks_.size() + 1), kNoBlock);
  const std::size_t mask = table_.size() - 1;
  for (std::uint32_t slot = 0; slot < blocks_.size(); ++slot) {
    std::size_t place = hash_of(blocks_[slot]) & mask;
    while (table_[place] != kNoBlock) place = (place + 1) & mask;
    table_[place] = slot;
  }
  neighbours_.resize(blocks_.size());
  parallel_for_each_index(
      blocks_.size(),
      [&](std::size_t slot) {
        for (int d = 0; d < 27; ++d) {
          const VoxelIndex o = offset_of(d);
          neighbours_[slot][static_cast<std::size_t>(d)] =
              find_block(blocks_[slot] + BlockIndex{o.x, o.y, o.z});
        }
      },
      256);
}

std::uint32_t BlockLayout::find_block(const BlockIndex& block) const {
  if (table_.empty()) return kNoBlock;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t place = hash_of(block) & mask;; place = (place + 1) & mask) {
    const std::uint32_t slot = table_[place];
    if (slot == kNoBlock || blocks_[slot] == block) return slot;
  }
}

std::size_t BlockLayout::memory_bytes() const {
  return blocks_.capacity() * sizeof(BlockIndex) + table_.capacity() * sizeof(std::uint32_t) +
         neighbours_.capacity() * sizeof(neighbours_[0]);
}

}  // namespace ridgeway
