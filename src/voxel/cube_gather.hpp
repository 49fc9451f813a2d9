// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>

#include "ridgeway/voxel/voxel_mask.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {

/// Calls body(id) for every member of a mask in one block, in ascending order.
template <typename Body>
void for_each_member(const VoxelMask& mask, std::uint32_t slot, const Body& body) {
  detail::for_each_in(mask.block(slot), slot, body);
}

/// A block of a mask with a border of one voxel: 10 x 10 rows of 10 bits, so that the 3x3x3 cube
/// around each of its voxels is nine shifts. For passes over whole blocks.
class CubeGather {
 public:
  CubeGather(const BlockLayout& layout, const VoxelMask& mask, std::uint32_t slot)
      : CubeGather([&](int direction) {
          const std::uint32_t n = layout.neighbour_block(slot, direction);
          return n == BlockLayout::kNoBlock ? nullptr : &mask.block(n);
        }) {
    assert(mask.is_of(layout));
  }
  /// `block_in(direction)`: the members of the block in one of 27 directions, or null.
  template <typename BlockIn>
  explicit CubeGather(const BlockIn& block_in) {
    std::array<const VoxelMask::Block*, 27> blocks;
    for (int d = 0; d < 27; ++d) blocks[static_cast<std::size_t>(d)] = block_in(d);
    for (int z = -1; z <= kBlockSide; ++z)
      for (int y = -1; y <= kBlockSide; ++y) {
        const int beside = 3 * ((y >> 3) + 1) + 9 * ((z >> 3) + 1);
        const auto part = [&](int dx) -> unsigned {
          const VoxelMask::Block* block = blocks[static_cast<std::size_t>(beside + dx + 1)];
          if (block == nullptr) return 0;
          return static_cast<unsigned>((*block)[static_cast<std::size_t>(z & 7)] >> (8 * (y & 7))) &
                 0xffu;
        };
        rows_[static_cast<std::size_t>((z + 1) * 10 + y + 1)] =
            static_cast<std::uint16_t>(part(0) << 1 | part(-1) >> 7 | (part(1) & 1u) << 9);
      }
  }

  /// Whether neither the block nor its border has a member.
  bool is_empty() const { return rows_ == std::array<std::uint16_t, 100>{}; }

  /// The cube around a voxel of this block; its own bit included.
  Cube27 cube(VoxelId id) const {
    const int x = static_cast<int>(id & 7);
    const std::size_t first = (id >> 6 & 7) * 10 + (id >> 3 & 7);
    Cube27 cube = 0;
    for (std::size_t z = 0; z < 3; ++z)
      for (std::size_t y = 0; y < 3; ++y)
        cube |= (static_cast<Cube27>(rows_[first + 10 * z + y]) >> x & 7u) << (9 * z + 3 * y);
    return cube;
  }

  /// The voxels of this block that are members or beside one.
  VoxelMask::Block dilated() const {
    VoxelMask::Block block;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      block[z] = 0;
      for (std::size_t y = 0; y < kBlockSide; ++y) {
        unsigned row = 0;
        for (std::size_t dz = 0; dz < 3; ++dz)
          for (std::size_t dy = 0; dy < 3; ++dy) row |= rows_[10 * (z + dz) + y + dy];
        row |= row << 1 | row >> 1;
        block[z] |= std::uint64_t{row >> 1 & 0xffu} << 8 * y;
      }
    }
    return block;
  }

  /// The voxels of this block that are members, as are all across their faces and edges.
  VoxelMask::Block surrounded() const {
    VoxelMask::Block block;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      block[z] = 0;
      for (std::size_t y = 0; y < kBlockSide; ++y) {
        const auto row = [&](std::size_t dy, std::size_t dz) -> unsigned {
          return rows_[10 * (z + dz) + y + dy];
        };
        const unsigned near = row(1, 1) & row(0, 1) & row(2, 1) & row(1, 0) & row(1, 2);
        const unsigned far = row(0, 0) & row(2, 0) & row(0, 2) & row(2, 2);
        block[z] |= std::uint64_t{(near & near << 1 & near >> 1 & far) >> 1 & 0xffu} << 8 * y;
      }
    }
    return block;
  }

 private:
  std::array<std::uint16_t, 100> rows_;
};

}  // namespace ridgeway
