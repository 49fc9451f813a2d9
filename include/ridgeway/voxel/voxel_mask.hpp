// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <vector>

#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {
namespace detail {

/// One word for each layer [z], bit x + 8 y of it for each voxel.
using MaskBlock = std::array<std::uint64_t, kBlockSide>;

// One page of zeros for all, wherever it is used.
extern template class SharedPages<MaskBlock>;

}  // namespace detail

/// A set of voxels: one bit a voxel, a row of eight along x is one byte, a block is 64 bytes
/// (one z-layer is one 64-bit word). A whole map of it fits the cache, which is what makes
/// thinning fast. Memory, and the time to make a set or to walk through it, follow the blocks that
/// have members, but for an eighth of a byte for each other one. A copy is a set of its own, and
/// shares the memory of what is the same in both.
class VoxelMask {
 public:
  /// One word for each layer [z], bit x + 8 y of it for each voxel.
  using Block = detail::MaskBlock;

  VoxelMask() = default;
  /// The empty set on a layout.
  explicit VoxelMask(const BlockLayout& layout) : stamp_(layout.stamp()) {
    blocks_.grow(layout.block_count());
  }

  /// Follows a layout to which blocks were added since; none of their voxels is a member.
  void grow(const BlockLayout& layout) {
    assert(stamp_ == layout.stamp_of_first(blocks_.size()));
    blocks_.grow(layout.block_count());
    stamp_ = layout.stamp();
  }
  /// Leaves it without members.
  void clear() noexcept { blocks_.clear(); }
  /// Whether this is a mask of a layout, for assertions where both are handed in.
  bool is_of(const BlockLayout& layout) const {
    return stamp_ == layout.stamp() && blocks_.size() == layout.block_count();
  }

  /// Whether a voxel is a member.
  bool test(VoxelId id) const { return block(id >> 9)[id >> 6 & 7] >> (id & 63) & 1; }
  /// Makes it one.
  void set(VoxelId id) { block(id >> 9)[id >> 6 & 7] |= 1ull << (id & 63); }
  /// Makes it none.
  void reset(VoxelId id) {
    if (test(id)) block(id >> 9)[id >> 6 & 7] &= ~(1ull << (id & 63));
  }

  /// The members in a slot, to be written to: by any number of threads, each its own words, while
  /// none reads others.
  Block& block(std::uint32_t slot) { return blocks_.own(slot); }
  /// The members in a slot.
  const Block& block(std::uint32_t slot) const { return blocks_[slot]; }
  /// Blocks of the layout.
  std::size_t block_count() const { return blocks_.size(); }

  /// Calls body(slot) for those with members, in ascending order.
  template <typename Body>
  void for_each_slot(const Body& body) const {
    constexpr auto kBlocks = detail::SharedPages<Block>::kPerPage;
    for (std::uint32_t page = 0; page < blocks_.page_count(); ++page) {
      if (!blocks_.is_there(page)) continue;
      const std::uint32_t end = std::min(blocks_.size(), (page + 1) * kBlocks);
      for (std::uint32_t slot = page * kBlocks; slot < end; ++slot) {
        std::uint64_t any = 0;
        for (const std::uint64_t layer : block(slot)) any |= layer;
        if (any != 0) body(slot);
      }
    }
  }
  /// Those slots in the order of their blocks (BlockLayout::rank).
  std::vector<std::uint32_t> slots_in_order(const BlockLayout& layout) const {
    assert(is_of(layout));
    std::vector<std::uint32_t> slots;
    for_each_slot([&](std::uint32_t slot) { slots.push_back(layout.rank(slot)); });
    if (layout.is_in_order()) return slots;
    std::sort(slots.begin(), slots.end());
    for (std::uint32_t& slot : slots) slot = layout.slot_at(slot);
    return slots;
  }

  /// How many voxels are members.
  std::size_t count() const {
    std::size_t total = 0;
    for_each_slot([&](std::uint32_t slot) {
      for (const std::uint64_t layer : block(slot))
        total += static_cast<std::size_t>(bit_count(layer));
    });
    return total;
  }

  /// Members in the order of their voxels (BlockLayout::order_of).
  std::vector<VoxelId> members(const BlockLayout& layout) const {
    std::vector<VoxelId> ids;
    for (const std::uint32_t slot : slots_in_order(layout))
      for (std::uint32_t z = 0; z < kBlockSide; ++z)
        for (std::uint64_t bits = block(slot)[z]; bits != 0; bits &= bits - 1)
          ids.push_back(slot * kBlockVoxels + z * 64 +
                        static_cast<VoxelId>(std::countr_zero(bits)));
    return ids;
  }

  /// The same members in the same slots.
  friend bool operator==(const VoxelMask& a, const VoxelMask& b) {
    if (a.block_count() != b.block_count()) return false;
    bool same = true;
    a.for_each_slot([&](std::uint32_t slot) { same &= a.block(slot) == b.block(slot); });
    b.for_each_slot([&](std::uint32_t slot) { same &= a.block(slot) == b.block(slot); });
    return same;
  }
  /// Bytes that the mask takes.
  std::size_t memory_bytes() const { return blocks_.memory_bytes(); }

 private:
  detail::SharedPages<Block> blocks_;  // by slot
  std::uint64_t stamp_ = 0;            // of the layout
};

/// The voxels of a block for which holds(place in the block) is true. It should not branch: then
/// the compiler asks for many of them at once.
template <typename Holds>
VoxelMask::Block block_where(const Holds& holds) {
  VoxelMask::Block block;
  for (int z = 0; z < kBlockSide; ++z) {
    std::array<std::uint8_t, 64> ones;
    for (int i = 0; i < 64; ++i)
      ones[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(holds(64 * z + i));
    std::uint64_t& layer = block[static_cast<std::size_t>(z)];
    layer = 0;
    for (std::size_t y = 0; y < kBlockSide; ++y) {
      std::uint64_t row = 0;
      std::memcpy(&row, &ones[8 * y], sizeof row);
      layer |= row * 0x0102040810204080u >> 56 << 8 * y;  // the lowest bit of each byte
    }
  }
  return block;
}

/// The 3x3x3 cube around a voxel, voxels outside the allocated blocks counting as absent. The
/// voxel's own bit is included.
inline Cube27 cube_around(const BlockLayout& layout, const VoxelMask& mask, VoxelId id) {
  assert(mask.is_of(layout));
  const int x = static_cast<int>(id & 7), y = static_cast<int>(id >> 3 & 7),
            z = static_cast<int>(id >> 6 & 7);
  const std::uint32_t slot = id >> 9;
  Cube27 cube = 0;
  if (x > 0 && x < 7 && y > 0 && y < 7) {  // no more than two blocks, one above the other
    const int shift = x - 1 + 8 * (y - 1);
    for (int dz = -1; dz <= 1; ++dz) {
      const std::uint32_t n = layout.neighbour_block(slot, 13 + 9 * ((z + dz) >> 3));
      if (n == BlockLayout::kNoBlock) continue;
      const std::uint64_t layer = mask.block(n)[static_cast<std::size_t>((z + dz) & 7)] >> shift;
      cube |= static_cast<Cube27>((layer & 7) | (layer >> 8 & 7) << 3 | (layer >> 16 & 7) << 6)
              << (9 * (dz + 1));
    }
    return cube;
  }
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy) {
      const int beside = 13 + 9 * ((z + dz) >> 3) + 3 * ((y + dy) >> 3);
      const auto row = [&](int dx) -> unsigned {
        const std::uint32_t n = layout.neighbour_block(slot, beside + dx);
        if (n == BlockLayout::kNoBlock) return 0;
        return static_cast<unsigned>(mask.block(n)[static_cast<std::size_t>((z + dz) & 7)] >>
                                     (8 * ((y + dy) & 7))) &
               0xffu;
      };
      unsigned bits = row(0) << 1;
      if (x == 0) bits |= row(-1) >> 7;
      if (x == 7) bits |= (row(1) & 1u) << 9;
      cube |= (bits >> x & 7u) << (9 * (dz + 1) + 3 * (dy + 1));
    }
  return cube;
}

}  // namespace ridgeway
