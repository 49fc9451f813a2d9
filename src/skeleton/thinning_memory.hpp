// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/voxel/voxel_mask.hpp"
#include "turn_replay.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {

/// How a set was thinned: when each voxel went. After voxels came or went only those are asked
/// again whose turn, or what they see at it, may be another; the result is that of thin().
class ThinningMemory {
 public:
  /// Brings `thinned`, what is left of `voxels`, up to date. Blocks may have come since the last
  /// call; `changed`: the voxels that came or went, `slots`: the blocks that hold some of them.
  void thin(const BlockLayout& layout, const VoxelMask& voxels, const VoxelMask& changed,
            std::span<const std::uint32_t> slots, VoxelMask& thinned);

 private:
  struct Rule;

  void thin_all(const BlockLayout& layout, const VoxelMask& voxels, VoxelMask& thinned);
  void thin_again(const BlockLayout& layout, const VoxelMask& voxels, const VoxelMask& changed,
                  std::span<const std::uint32_t> slots, VoxelMask& thinned);
  void make_room(const VoxelMask& voxels, const VoxelMask& changed, std::uint32_t slot);
  std::size_t place_of(const VoxelMask& voxels, VoxelId id) const;
  Turn turn_of(const VoxelMask& voxels, VoxelId id) const;
  void set_turn(const VoxelMask& voxels, VoxelId id, Turn turn);

  std::size_t count_ = 0;  // voxels
  // By slot, of each voxel that there is in the block, in their order.
  std::vector<std::vector<std::uint8_t>> codes_;
  FlatTable<VoxelId, Turn> long_;  // turns that have no code
  ReplayScratch scratch_;
};

}  // namespace ridgeway::detail
