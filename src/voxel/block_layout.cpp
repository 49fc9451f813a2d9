// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/block_layout.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <unordered_set>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

constexpr double kMostPlaces = 8.0;  // in the box around all blocks for each of them

std::uint64_t stamped(std::uint64_t stamp, std::span<const BlockIndex> blocks) {
  for (const BlockIndex& block : blocks) stamp = stamp * 0x9e3779b97f4a7c15ull + hash_of(block) + 1;
  return stamp;
}

bool is_legal(const BlockIndex& block) {
  constexpr int kFarthest = BlockLayout::kFarthestBlock;
  const auto is_near = [](int k) { return k >= -kFarthest && k <= kFarthest; };
  return is_near(block.x) && is_near(block.y) && is_near(block.z);
}

}  // namespace

BlockLayout::BlockLayout(std::vector<BlockIndex> blocks) : blocks_(std::move(blocks)) {
  if (!std::is_sorted(blocks_.begin(), blocks_.end())) std::sort(blocks_.begin(), blocks_.end());
  blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
  require_legal(0);
  index_blocks();
  neighbours_.grow(block_count());
  parallel_for_each_index(
      blocks_.size(), [&](std::size_t slot) { find_neighbours(static_cast<std::uint32_t>(slot)); },
      256);
  stamp_ = stamped(0, blocks_);
}

void BlockLayout::add(std::span<const BlockIndex> blocks) {
  if (std::all_of(blocks.begin(), blocks.end(),
                  [&](const BlockIndex& block) { return find_block(block) != kNoBlock; }))
    return;
  BlockLayout grown = *this;  // where memory runs out, this one is as it was
  grown.append(blocks);
  *this = std::move(grown);
}

void BlockLayout::append(std::span<const BlockIndex> blocks) {
  const std::uint32_t before = block_count();
  for (const BlockIndex& block : blocks)
    if (find_block(block) == kNoBlock) blocks_.push_back(block);
  drop_doubles(before);
  require_legal(before);
  index_blocks_from(before);
  neighbours_.grow(block_count());
  for (std::uint32_t slot = before; slot < blocks_.size(); ++slot) {
    find_neighbours(slot);
    for (int d = 0; d < 27; ++d)
      if (const std::uint32_t n = neighbour_block(slot, d); n != kNoBlock)
        neighbours_.own(n)[static_cast<std::size_t>(opposite(d))] = slot;
  }
  order_blocks(before);
  stamp_ = stamped(stamp_, this->blocks().subspan(before));
}

/// Of the blocks from a slot on, keeps the first of each.
void BlockLayout::drop_doubles(std::uint32_t first) {
  std::unordered_set<BlockIndex, BlockHash> seen;
  const auto begin = blocks_.begin() + first;
  blocks_.erase(std::remove_if(begin, blocks_.end(),
                               [&](const BlockIndex& b) { return !seen.insert(b).second; }),
                blocks_.end());
}

/// Of those from a slot on.
void BlockLayout::require_legal(std::uint32_t first) const {
  if (blocks_.size() > kMostBlocks)
    throw InputError("map", "needs more than 8 million blocks of 8x8x8 voxels",
                     "use larger voxels, or cut the map down to a smaller box");
  if (!std::all_of(blocks_.begin() + first, blocks_.end(), is_legal))
    throw InputError("map", "has a block farther than 1e9 voxels from its origin",
                     "move the map to its origin, or use larger voxels");
}

void BlockLayout::find_neighbours(std::uint32_t slot) {
  std::array<std::uint32_t, 27>& neighbours = neighbours_.own(slot);
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex o = offset_of(d);
    neighbours[static_cast<std::size_t>(d)] = find_block(blocks_[slot] + BlockIndex{o.x, o.y, o.z});
  }
}

/// Merges the new blocks, from a slot on, into the order of those before.
void BlockLayout::order_blocks(std::uint32_t first_new) {
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) { return blocks_[a] < blocks_[b]; };
  const bool were_in_order = rank_.empty();
  if (were_in_order &&
      std::is_sorted(blocks_.begin() + (first_new > 0 ? first_new - 1 : 0), blocks_.end()))
    return;
  if (were_in_order) {
    by_rank_.resize(first_new);
    std::iota(by_rank_.begin(), by_rank_.end(), 0u);
  }
  by_rank_.resize(blocks_.size());
  const auto middle = by_rank_.begin() + first_new;
  std::iota(middle, by_rank_.end(), first_new);
  std::sort(middle, by_rank_.end(), is_before);
  std::inplace_merge(by_rank_.begin(), middle, by_rank_.end(), is_before);
  rank_.resize(blocks_.size());
  for (std::uint32_t rank = 0; rank < by_rank_.size(); ++rank) rank_[by_rank_[rank]] = rank;
}

std::uint64_t BlockLayout::stamp_of_first(std::uint32_t count) const {
  return stamped(0, blocks().first(count));
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
  for (std::uint32_t slot = 0; slot < blocks_.size(); ++slot)
    table_[place_of(blocks_[slot])] = slot;
}

/// Adds those from a slot on; where they lie in the box around the others, in time that follows
/// their number.
void BlockLayout::index_blocks_from(std::uint32_t first) {
  const auto begin = blocks_.begin() + first;
  if (first == 0 || is_spread_ ||
      !std::all_of(begin, blocks_.end(), [&](const BlockIndex& b) { return is_in_box(b); }))
    return index_blocks();
  for (std::uint32_t slot = first; slot < blocks_.size(); ++slot)
    table_[place_of(blocks_[slot])] = slot;
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

void BlockLayout::swap(BlockLayout& other) noexcept {
  std::swap(blocks_, other.blocks_);
  std::swap(neighbours_, other.neighbours_);
  std::swap(rank_, other.rank_);
  std::swap(by_rank_, other.by_rank_);
  std::swap(table_, other.table_);
  std::swap(stamp_, other.stamp_);
  std::swap(low_, other.low_);
  std::swap(extent_, other.extent_);
  std::swap(is_spread_, other.is_spread_);
}

std::uint32_t BlockLayout::find_hashed(const BlockIndex& block) const {
  const std::size_t mask = table_.size() - 1;
  for (std::size_t place = hash_of(block) & mask;; place = (place + 1) & mask) {
    const std::uint32_t slot = table_[place];
    if (slot == kNoBlock || blocks_[slot] == block) return slot;
  }
}

std::size_t BlockLayout::memory_bytes() const {
  return blocks_.capacity() * sizeof(BlockIndex) +
         (table_.capacity() + rank_.capacity() + by_rank_.capacity()) * sizeof(std::uint32_t) +
         neighbours_.memory_bytes();
}

}  // namespace ridgeway
