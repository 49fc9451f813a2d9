// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>

#include "lanes.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Levels (4 d^2 / s^2) around a block; zero where not traversable.
using Levels = Bordered<std::uint32_t>;

inline Levels gather_levels(const EsdfMap& esdf, const VoxelMask& traversable, std::uint32_t slot) {
  Levels levels{};
  for_each_bordered_row(esdf.layout, slot, [&](std::size_t place, VoxelId first, auto count) {
    if (first == kNoVoxel) return;
    const std::uint64_t all = (std::uint64_t{1} << count) - 1;
    const std::uint64_t layer = traversable.block(first / kBlockVoxels)[first / 64 % kBlockSide];
    const std::uint64_t members = layer >> (first % 64) & all;
    if (members == 0) return;
    std::copy_n(&esdf.squared[first], count, &levels[place]);
    for (std::uint64_t others = ~members & all; others != 0; others &= others - 1)
      levels[place + static_cast<std::size_t>(std::countr_zero(others))] = 0;
  });
  return levels;
}

/// For some voxels, their neighbours above them and those as high as they are.
template <int lanes>
struct LevelCubes {
  using Cubes = typename Row<lanes>::Cubes;
  Cubes higher{};
  Cubes level{};

  [[gnu::always_inline]] LevelCubes(const Levels& levels, std::size_t first) {
    const auto own = load_lanes<Cubes>(&levels[first]);
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d) {
      const auto beside = load_lanes<Cubes>(&levels[first] + bordered_step(d));
      const Cube27 cell = 1u << d;
      higher |= reinterpret_cast<Cubes>(beside > own) & cell;
      level |= reinterpret_cast<Cubes>(beside == own) & cell;
    }
  }
};

}  // namespace ridgeway::detail
