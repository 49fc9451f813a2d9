// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

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
  const Level* at(VoxelId id) const { return &levels_[place(id)]; }
  static constexpr std::size_t place(VoxelId id) {
    return ((id >> 6 & 7) + 1) * 100 + ((id >> 3 & 7) + 1) * 10 + (id & 7) + 1;
  }
  const std::array<Level, 1000>& all() const { return levels_; }
  static constexpr int step(int direction) {
    const VoxelIndex o = offset_of(direction);
    return o.x + 10 * o.y + 100 * o.z;
  }

 private:
  std::array<Level, 1000> levels_;
};

/// Four voxels in a row along x, the first at a multiple of four, are compared at once: a number
/// for each. Comparisons give all ones where they hold.
inline constexpr int kLanes = 4;
typedef Cube27 Cubes __attribute__((vector_size(16)));
typedef float Floats __attribute__((vector_size(16)));

template <typename Lanes>
Lanes load_lanes(const void* first) {
  Lanes lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

/// For four voxels of a gather, their neighbours above them and those as high as they are.
struct LevelCubes {
  Cubes higher{};
  Cubes level{};

  explicit LevelCubes(const LevelGather::Level* first) {
    const auto own = load_lanes<Cubes>(first);
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d) {
      const auto beside = load_lanes<Cubes>(first + LevelGather::step(d));
      const Cube27 cell = 1u << d;
      higher |= reinterpret_cast<Cubes>(beside > own) & cell;
      level |= reinterpret_cast<Cubes>(beside == own) & cell;
    }
  }
};

inline bool any(const Cubes& cubes) {
  std::array<std::uint64_t, 2> halves;
  std::memcpy(halves.data(), &cubes, sizeof cubes);
  return (halves[0] | halves[1]) != 0;
}

/// flood26 and flood6 for four cubes.
inline Cubes flood26(Cubes cells, const Cubes& within) {
  for (Cubes before = cells ^ 1u; any(before ^ cells);) {
    before = cells;
    cells = grow26(cells) & within;
  }
  return cells;
}
inline Cubes flood6(Cubes cells, const Cubes& within) {
  for (Cubes before = cells ^ 1u; any(before ^ cells);) {
    before = cells;
    cells = grow6(cells) & within;
  }
  return cells;
}

/// is_simple for four cubes.
inline Cubes are_simple(const Cubes& cubes) {
  const Cubes foreground = cubes & kCells26, background = ~cubes & kCells18;
  const Cubes faces = background & kCells6;
  const Cubes part = flood26(foreground & -foreground, foreground);
  const Cubes unreached = faces & ~flood6(faces & -faces, background);
  return reinterpret_cast<Cubes>((foreground != 0u) & (faces != 0u) & (part == foreground) &
                                 (unreached == 0u));
}

/// Calls body(first of four voxels, those of a mask as four bits) for a block, where there are any.
template <typename Body>
void for_each_four(const VoxelMask& mask, std::uint32_t slot, const Body& body) {
  for (std::uint32_t place = 0; place < kBlockVoxels; place += kLanes)
    if (const unsigned members = mask.block(slot)[place / 64] >> (place % 64) & 0xf; members != 0)
      body(slot * kBlockVoxels + place, members);
}

}  // namespace ridgeway::detail
