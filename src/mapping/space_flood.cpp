// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "space_flood.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "memory_limit.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

using Bits = VoxelMask::Block;

// Of a layer of a block, bit x + 8 y.
constexpr std::uint64_t kFirstX = 0x0101010101010101ull, kLastX = kFirstX << 7;
constexpr std::uint64_t kFirstY = 0xffull, kLastY = kFirstY << 56;

std::uint64_t count_of(const Bits& bits) {
  std::uint64_t count = 0;
  for (const std::uint64_t layer : bits) count += static_cast<std::uint64_t>(std::popcount(layer));
  return count;
}

bool any(const Bits& bits) {
  return std::any_of(bits.begin(), bits.end(), [](std::uint64_t layer) { return layer != 0; });
}

std::uint64_t beside(std::uint64_t w) {
  return (w & ~kLastX) << 1 | (w & ~kFirstX) >> 1 | w << 8 | w >> 8;
}

/// Spreads within a block until nothing changes.
void spread(Bits& reached, const Bits& open) {
  bool changes = true;
  while (changes) {
    changes = false;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      std::uint64_t w = reached[z] | beside(reached[z]);
      if (z > 0) w |= reached[z - 1];
      if (z + 1 < kBlockSide) w |= reached[z + 1];
      w &= open[z];
      changes |= w != reached[z];
      reached[z] = w;
    }
  }
}

/// The places x, y, z from `first` to `last` of a block.
Bits box_bits(const VoxelIndex& first, const VoxelIndex& last) {
  Bits bits{};
  for (int z = std::max(first.z, 0); z <= std::min(last.z, kBlockSide - 1); ++z)
    for (int y = std::max(first.y, 0); y <= std::min(last.y, kBlockSide - 1); ++y)
      for (int x = std::max(first.x, 0); x <= std::min(last.x, kBlockSide - 1); ++x)
        bits[static_cast<std::size_t>(z)] |= 1ull << (x + kBlockSide * y);
  return bits;
}

}  // namespace

SpaceFlood::SpaceFlood(const BlockMasks& walls, const VoxelRange& range, std::string name)
    : walls_(walls),
      range_(range),
      first_(block_of(range.min)),
      last_(block_of(range.max)),
      name_(std::move(name)),
      most_blocks_(static_cast<std::size_t>(
          available_memory_bytes() /
          (std::uint64_t{kBlockVoxels} * std::uint64_t{kPipelineBytesPerVoxel}))) {
  wall_slots_.reserve(walls.blocks.size());
  for (std::uint32_t i = 0; i < walls.blocks.size(); ++i) wall_slots_.emplace(walls.blocks[i], i);
}

bool SpaceFlood::holds(const BlockIndex& b) const {
  return b.x >= first_.x && b.y >= first_.y && b.z >= first_.z && b.x <= last_.x &&
         b.y <= last_.y && b.z <= last_.z;
}

bool SpaceFlood::is_inner(const BlockIndex& b) const {
  return b.x > first_.x && b.y > first_.y && b.z > first_.z && b.x < last_.x && b.y < last_.y &&
         b.z < last_.z;
}

Bits SpaceFlood::open_bits(const BlockIndex& block) const {
  Bits open;
  open.fill(~0ull);
  const VoxelIndex corner = voxel_of(block, 0);
  if (!is_inner(block)) open = box_bits(range_.min - corner, range_.max - corner);
  if (const auto wall = wall_slots_.find(block); wall != wall_slots_.end())
    for (std::size_t z = 0; z < kBlockSide; ++z) open[z] &= ~walls_.voxels[wall->second][z];
  return open;
}

/// The places of a block that are in the outermost layers.
Bits SpaceFlood::side_bits(const BlockIndex& block) const {
  if (is_inner(block)) return {};
  const VoxelIndex corner = voxel_of(block, 0), one = {1, 1, 1};
  const Bits all = box_bits(range_.min - corner, range_.max - corner),
             within = box_bits(range_.min + one - corner, range_.max - one - corner);
  Bits sides;
  for (std::size_t z = 0; z < kBlockSide; ++z) sides[z] = all[z] & ~within[z];
  return sides;
}

bool SpaceFlood::is_open(const VoxelIndex& voxel) const {
  const BlockIndex block = block_of(voxel);
  if (!holds(block)) return false;
  const int local = local_of(voxel);
  return open_bits(block)[static_cast<std::size_t>(local >> 6)] >> (local & 63) & 1;
}

bool SpaceFlood::is_reached(const VoxelIndex& voxel) const {
  const auto slot = slots_.find(block_of(voxel));
  const int local = local_of(voxel);
  return slot != slots_.end() &&
         (blocks_[slot->second].reached[static_cast<std::size_t>(local >> 6)] >> (local & 63) & 1);
}

std::uint32_t SpaceFlood::slot_of(const BlockIndex& block) {
  const auto [place, is_new] =
      slots_.try_emplace(block, static_cast<std::uint32_t>(blocks_.size()));
  if (is_new) {
    if (blocks_.size() >= most_blocks_)
      require_memory_for_blocks(static_cast<double>(blocks_.size() + 1), kPipelineBytesPerVoxel,
                                name_);
    blocks_.push_back({block, open_bits(block), {}, false});
  }
  return place->second;
}

std::uint64_t SpaceFlood::reach(std::uint32_t slot, const Bits& more) {
  Block& block = blocks_[slot];
  std::uint64_t count = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t fresh = more[z] & block.open[z] & ~block.reached[z];
    count += static_cast<std::uint64_t>(std::popcount(fresh));
    block.reached[z] |= fresh;
  }
  if (count > 0 && !block.is_waiting) {
    block.is_waiting = true;
    waiting_.push_back(slot);
  }
  return count;
}

/// To the six blocks around one.
void SpaceFlood::pass_on(std::uint32_t slot, std::uint64_t& count) {
  const BlockIndex at = blocks_[slot].index;
  const Bits from = blocks_[slot].reached;
  std::array<Bits, 6> to{};
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    to[0][z] = (from[z] & kFirstX) << 7;
    to[1][z] = (from[z] & kLastX) >> 7;
    to[2][z] = (from[z] & kFirstY) << 56;
    to[3][z] = (from[z] & kLastY) >> 56;
  }
  to[4][kBlockSide - 1] = from[0];
  to[5][0] = from[kBlockSide - 1];
  constexpr std::array<BlockIndex, 6> kSteps = {
      BlockIndex{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const BlockIndex block = at + kSteps[i];
    if (holds(block) && any(to[i])) count += reach(slot_of(block), to[i]);
  }
}

std::uint64_t SpaceFlood::run() {
  std::uint64_t count = 0;
  while (!waiting_.empty()) {
    const std::uint32_t slot = waiting_.back();
    waiting_.pop_back();
    Block& block = blocks_[slot];
    block.is_waiting = false;
    const std::uint64_t before = count_of(block.reached);
    spread(block.reached, block.open);
    count += count_of(block.reached) - before;
    pass_on(slot, count);
  }
  return count;
}

std::uint64_t SpaceFlood::spread_from(const VoxelIndex& voxel) {
  Bits seed{};
  const int local = local_of(voxel);
  seed[static_cast<std::size_t>(local >> 6)] = 1ull << (local & 63);
  const std::uint64_t first = holds(block_of(voxel)) ? reach(slot_of(block_of(voxel)), seed) : 0;
  return first + run();
}

template <typename Visit>
void SpaceFlood::for_each_block_at_sides(const Visit& visit) const {
  const BlockIndex &low = first_, &high = last_;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y) {
      const bool is_whole = z == low.z || z == high.z || y == low.y || y == high.y;
      const int step = is_whole ? 1 : std::max(high.x - low.x, 1);
      for (int x = low.x; x <= high.x; x += step) visit(BlockIndex{x, y, z});
    }
}

std::uint64_t SpaceFlood::spread_from_sides() {
  std::uint64_t count = 0;
  for_each_block_at_sides(
      [&](const BlockIndex& block) { count += reach(slot_of(block), side_bits(block)); });
  return count + run();
}

std::optional<VoxelIndex> SpaceFlood::find_unreached() {
  const auto count = [](int low, int high) { return static_cast<std::uint64_t>(high - low) + 1; };
  const std::uint64_t nx = count(first_.x, last_.x), ny = count(first_.y, last_.y),
                      nz = count(first_.z, last_.z);
  for (; next_block_ < nx * ny * nz; ++next_block_) {
    const BlockIndex block = first_ + BlockIndex{static_cast<int>(next_block_ % nx),
                                                 static_cast<int>(next_block_ / nx % ny),
                                                 static_cast<int>(next_block_ / nx / ny)};
    const auto slot = slots_.find(block);
    Bits left = slot != slots_.end() ? blocks_[slot->second].open : open_bits(block);
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      if (slot != slots_.end()) left[z] &= ~blocks_[slot->second].reached[z];
      if (left[z] != 0)
        return voxel_of(block, static_cast<int>(64 * z) + std::countr_zero(left[z]));
    }
  }
  return std::nullopt;
}

bool SpaceFlood::reaches_sides() const {
  return std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& block) {
    const Bits sides = side_bits(block.index);
    for (std::size_t z = 0; z < kBlockSide; ++z)
      if ((sides[z] & block.reached[z]) != 0) return true;
    return false;
  });
}

BlockMasks SpaceFlood::reached() const {
  std::vector<const Block*> order;
  for (const Block& block : blocks_)
    if (any(block.reached)) order.push_back(&block);
  std::sort(order.begin(), order.end(),
            [](const Block* a, const Block* b) { return a->index < b->index; });
  BlockMasks masks;
  for (const Block* block : order) {
    masks.blocks.push_back(block->index);
    masks.voxels.push_back(block->reached);
  }
  return masks;
}

}  // namespace ridgeway
