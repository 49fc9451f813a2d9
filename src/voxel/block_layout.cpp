// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/block_layout.hpp"

#include <algorithm>
#include <bit>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

constexpr double kMostPlaces = 8.0;  // in the box around all blocks for each of them

}  // namespace

BlockLayout::BlockLayout(std::vector<BlockIndex> blocks) : blocks_(std::move(blocks)) {
  std::sort(blocks_.begin(), blocks_.end());
  blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
  if (blocks_.size() >= (1u << 23)) {
    throw InputError("map", "needs more than 8 million blocks of 8x8x8 voxels",
                     "use larger voxels, or cut the map down to a smaller box");
  }
  index_blocks();
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

void BlockLayout::index_blocks() {
  if (blocks_.empty()) return;
  BlockIndex high = low_ = blocks_.front();
  for (const BlockIndex& b : blocks_) {
    low_ = {std::min(low_.x, b.x), std::min(low_.y, b.y), std::min(low_.z, b.z)};
    high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
  }
  extent_ = {steps(low_.x, high.x) + 1, steps(low_.y, high.y) + 1, steps(low_.z, high.z) + 1};
  const double volume = 1.0 * extent_[0] * extent_[1] * extent_[2];
  is_spread_ = volume > kMostPlaces * static_cast<double>(blocks_.size());
  if (is_spread_) return hash_blocks();
  table_.assign(static_cast<std::size_t>(volume), kNoBlock);
  for (std::uint32_t slot = 0; slot < blocks_.size(); ++slot) {
    const BlockIndex b = blocks_[slot] - low_;
    table_[static_cast<std::size_t>(b.x) +
           extent_[0] *
               (static_cast<std::size_t>(b.y) + extent_[1] * static_cast<std::size_t>(b.z))] = slot;
  }
}

void BlockLayout::hash_blocks() {
  table_.assign(std::bit_ceil(2 * blocks_.size() + 1), kNoBlock);
  const std::size_t mask = table_.size() - 1;
  for (std::uint32_t slot = 0; slot < blocks_.size(); ++slot) {
    std::size_t place = hash_of(blocks_[slot]) & mask;
    while (table_[place] != kNoBlock) place = (place + 1) & mask;
    table_[place] = slot;
  }
}

std::uint32_t BlockLayout::find_hashed(const BlockIndex& block) const {
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
