// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <bit>
#include <cstdint>
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

/// The members of both of two sets of one layout.
inline VoxelMask common_members(VoxelMask a, const VoxelMask& b) {
  for (std::uint32_t slot = 0; slot < a.block_count(); ++slot)
    for (std::size_t z = 0; z < kBlockSide; ++z) a.block(slot)[z] &= b.block(slot)[z];
  return a;
}

inline void remove_members(VoxelMask& voxels, const VoxelMask& others) {
  for (std::uint32_t slot = 0; slot < voxels.block_count(); ++slot)
    for (std::size_t z = 0; z < kBlockSide; ++z) voxels.block(slot)[z] &= ~others.block(slot)[z];
}

/// Adds those of `more` that are in `within`; `more` may be of a layout to which blocks were added
/// since.
inline void add_members(VoxelMask& voxels, const VoxelMask& more, const VoxelMask& within) {
  for (std::uint32_t slot = 0; slot < more.block_count(); ++slot)
    for (std::size_t z = 0; z < kBlockSide; ++z)
      voxels.block(slot)[z] |= more.block(slot)[z] & within.block(slot)[z];
}

/// VoxelMask::members, faster where most blocks have none.
inline std::vector<VoxelId> members_of_sparse(const BlockLayout& layout, const VoxelMask& voxels) {
  std::vector<VoxelId> ids;
  for (std::uint32_t rank = 0; rank < layout.block_count(); ++rank) {
    const std::uint32_t slot = layout.slot_at(rank);
    const VoxelMask::Block& block = voxels.block(slot);
    if (is_empty(block)) continue;
    for (std::uint32_t z = 0; z < kBlockSide; ++z)
      for (std::uint64_t bits = block[z]; bits != 0; bits &= bits - 1)
        ids.push_back(slot * kBlockVoxels + z * 64 + static_cast<VoxelId>(std::countr_zero(bits)));
  }
  return ids;
}

}  // namespace ridgeway::detail
