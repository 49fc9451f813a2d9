// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/voxel/cube_gather.hpp"

namespace ridgeway::detail {

/// Levels (4 d^2 / s^2) of a block's voxels and of a border of one voxel around them; zero where
/// not traversable. Passes over whole blocks compare rows of eight voxels at once.
class LevelGather {
 public:
  using Level = std::uint32_t;

  LevelGather(const EsdfMap& esdf, const VoxelMask& traversable, std::uint32_t slot) {
    for (int z = -1; z <= kBlockSide; ++z)
      for (int y = -1; y <= kBlockSide; ++y) {
        const int beside = 13 + 3 * (y >> 3) + 9 * (z >> 3);
        const auto place = static_cast<VoxelId>((y & 7) << 3 | (z & 7) << 6);
        const auto level = [&](int dx, int x) -> Level {
          const std::uint32_t n = esdf.layout.neighbour_block(slot, beside + dx);
          if (n == BlockLayout::kNoBlock) return 0;
          const VoxelId id = n * kBlockVoxels + place + static_cast<VoxelId>(x);
          return traversable.test(id) ? esdf.squared[id] : 0;
        };
        Level* row = levels_.data() + (z + 1) * 100 + (y + 1) * 10;
        row[0] = level(-1, 7);
        for (int x = 0; x < kBlockSide; ++x) row[x + 1] = level(0, x);
        row[9] = level(1, 0);
      }
  }

  /// Level of a voxel of this block; its neighbour's is `step(direction)` away.
  const Level* at(VoxelId id) const {
    return &levels_[((id >> 6 & 7) + 1) * 100 + ((id >> 3 & 7) + 1) * 10 + (id & 7) + 1];
  }
  static constexpr int step(int direction) {
    const VoxelIndex o = offset_of(direction);
    return o.x + 10 * o.y + 100 * o.z;
  }

 private:
  std::array<Level, 1000> levels_;
};

/// For the voxels of a row of eight, beginning at `row` in a gather, their neighbours above them
/// and those as high as they are.
struct RowCubes {
  std::array<Cube27, kBlockSide> higher{};
  std::array<Cube27, kBlockSide> level{};

  explicit RowCubes(const LevelGather::Level* row) {
    for (int d = 0; d < 27; ++d) {
      const LevelGather::Level* beside = row + LevelGather::step(d);
      for (std::size_t x = 0; x < kBlockSide; ++x) {
        higher[x] |= static_cast<Cube27>(beside[x] > row[x]) << d;
        level[x] |= static_cast<Cube27>(beside[x] == row[x]) << d;
      }
    }
  }
};

/// Calls body(first voxel of the row, its members as bits) for the rows of a block that hold any
/// voxel of a mask.
template <typename Body>
void for_each_row(const VoxelMask& mask, std::uint32_t slot, const Body& body) {
  for (std::uint32_t z = 0; z < kBlockSide; ++z)
    for (std::uint32_t y = 0; y < kBlockSide; ++y)
      if (const auto bits = static_cast<unsigned>(mask.block(slot)[z] >> (8 * y) & 0xff); bits != 0)
        body(slot * kBlockVoxels + z * 64 + y * 8, bits);
}

}  // namespace ridgeway::detail
