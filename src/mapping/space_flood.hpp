// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "touched_voxels.hpp"

namespace ridgeway {

/// The voxels of a range that are reached from others by steps across faces that stay in the range
/// and out of walls. Memory follows what is reached. For one thread.
class SpaceFlood {
 public:
  /// `walls` must outlive this. `name` stands in errors where memory would not do.
  SpaceFlood(const BlockMasks& walls, const VoxelRange& range, std::string name);

  /// Whether a voxel is within the range and no wall.
  bool is_open(const VoxelIndex& voxel) const;
  bool is_reached(const VoxelIndex& voxel) const;

  /// Spreads from a voxel; returns how many more are reached now.
  std::uint64_t spread_from(const VoxelIndex& voxel);
  /// Spreads from all open voxels of the outermost layers.
  std::uint64_t spread_from_sides();
  /// The next open voxel that is not reached, by block in (z, y, x) order from the block that the
  /// last call ended in; nothing if there is none.
  std::optional<VoxelIndex> find_unreached();
  /// Whether a voxel of the outermost layers is reached.
  bool reaches_sides() const;

  /// What is reached, in order.
  BlockMasks reached() const;

 private:
  using Bits = VoxelMask::Block;
  struct Block {
    BlockIndex index;
    Bits open{}, reached{};
    bool is_waiting = false;
  };

  bool holds(const BlockIndex& block) const;
  bool is_inner(const BlockIndex& block) const;
  Bits open_bits(const BlockIndex& block) const;
  Bits side_bits(const BlockIndex& block) const;
  std::uint32_t slot_of(const BlockIndex& block);
  std::uint64_t reach(std::uint32_t slot, const Bits& more);
  void pass_on(std::uint32_t slot, std::uint64_t& count);
  std::uint64_t run();
  template <typename Visit>
  void for_each_block_at_sides(const Visit& visit) const;

  const BlockMasks& walls_;
  VoxelRange range_;
  BlockIndex first_, last_;
  std::string name_;
  std::size_t most_blocks_;
  std::unordered_map<BlockIndex, std::uint32_t, BlockHash> wall_slots_, slots_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> waiting_;
  std::uint64_t next_block_ = 0;
};

}  // namespace ridgeway
