// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "ridgeway/voxel/voxel_mask.hpp"

/// Sets of voxels, block by block.
namespace ridgeway::detail {

/// Whether a block has no member: to compare it with an empty one takes a call for each block.
inline bool is_empty(const VoxelMask::Block& block) {
  std::uint64_t any = 0;
  for (const std::uint64_t layer : block) any |= layer;
  return any == 0;
}

/// Those of both of two blocks.
inline VoxelMask::Block both(VoxelMask::Block a, const VoxelMask::Block& b) {
  for (std::size_t z = 0; z < kBlockSide; ++z) a[z] &= b[z];
  return a;
}

/// Members of a block.
inline std::size_t count_of(const VoxelMask::Block& block) {
  int count = 0;
  for (const std::uint64_t layer : block) count += bit_count(layer);
  return static_cast<std::size_t>(count);
}

/// Members of its block that come before a voxel.
inline std::size_t members_before(const VoxelMask::Block& block, VoxelId id) {
  const std::size_t layer = id / 64 % kBlockSide;
  int before = bit_count(block[layer] & ((std::uint64_t{1} << id % 64) - 1));
  for (std::size_t z = 0; z < layer; ++z) before += bit_count(block[z]);
  return static_cast<std::size_t>(before);
}

/// Calls body(id) for the members of a block, in ascending order.
template <typename Body>
void for_each_in(const VoxelMask::Block& block, std::uint32_t slot, const Body& body) {
  for (std::uint32_t z = 0; z < kBlockSide; ++z)
    for (std::uint64_t bits = block[z]; bits != 0; bits &= bits - 1)
      body(slot * kBlockVoxels + z * 64 + static_cast<VoxelId>(std::countr_zero(bits)));
}

/// The members of both of two sets of one layout.
inline VoxelMask common_members(VoxelMask a, const VoxelMask& b) {
  a.for_each_slot([&](std::uint32_t slot) { a.block(slot) = both(a.block(slot), b.block(slot)); });
  return a;
}

/// Those of either of two sets of one layout.
inline VoxelMask united(VoxelMask a, const VoxelMask& b) {
  b.for_each_slot([&](std::uint32_t slot) {
    for (std::size_t z = 0; z < kBlockSide; ++z) a.block(slot)[z] |= b.block(slot)[z];
  });
  return a;
}

/// What is left of a set without the members of another one.
struct Rest {
  const VoxelMask* all = nullptr;
  const VoxelMask* without = nullptr;

  VoxelMask::Block block(std::uint32_t slot) const {
    VoxelMask::Block block = all->block(slot);
    for (std::size_t z = 0; z < kBlockSide; ++z) block[z] &= ~without->block(slot)[z];
    return block;
  }
  bool test(VoxelId id) const { return all->test(id) && !without->test(id); }
};

inline void remove_members(VoxelMask& voxels, const VoxelMask& others) {
  voxels.for_each_slot([&](std::uint32_t slot) {
    for (std::size_t z = 0; z < kBlockSide; ++z) voxels.block(slot)[z] &= ~others.block(slot)[z];
  });
}

/// Slots in which one of some sets of a layout has members, in ascending order.
inline std::vector<std::uint32_t> slots_of_any(std::initializer_list<const VoxelMask*> sets) {
  std::vector<std::uint64_t> has_any((*sets.begin())->block_count() / 64 + 1);  // by bit
  for (const VoxelMask* set : sets)
    set->for_each_slot(
        [&](std::uint32_t slot) { has_any[slot / 64] |= std::uint64_t{1} << slot % 64; });
  std::vector<std::uint32_t> slots;
  for (std::uint32_t word = 0; word < has_any.size(); ++word)
    for (std::uint64_t bits = has_any[word]; bits != 0; bits &= bits - 1)
      slots.push_back(word * 64 + static_cast<std::uint32_t>(std::countr_zero(bits)));
  return slots;
}

}  // namespace ridgeway::detail
