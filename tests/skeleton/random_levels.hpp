// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <random>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::testing {

/// Voxels with levels that no distance field has, so that what holds for any order of voxels is
/// seen to: few levels (plateaus) or many, slopes or none, in blocks with gaps. Of an EsdfMap it
/// has the layout and `squared` alone.
struct RandomLevels {
  EsdfMap esdf;
  VoxelMask traversable;
};

inline RandomLevels random_levels(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  std::vector<BlockIndex> blocks;
  for (int i = 1 + below(9); i > 0; --i) blocks.push_back({below(3) - 1, below(2) - 1, below(2)});
  RandomLevels result;
  result.esdf.voxel_size = 1.0;
  result.esdf.layout = BlockLayout(blocks);
  const BlockLayout& layout = result.esdf.layout;
  result.esdf.squared = VoxelField<std::uint32_t>(layout, 0);
  result.traversable = VoxelMask(layout);
  constexpr unsigned kLevels[] = {1, 2, 3, 8, 40, 1000};
  const unsigned levels = kLevels[seed % 6];
  const int slope[] = {below(9), below(9), below(9)};
  const int missing = below(6);  // of ten
  for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
    if (below(10) < missing) continue;
    result.traversable.set(id);
    const VoxelIndex v = layout.index_of(id);
    const int sloped = slope[0] * (v.x + 8) + slope[1] * (v.y + 8) + slope[2] * v.z;
    result.esdf.squared[id] =
        static_cast<std::uint32_t>(1 + below(levels) + (seed % 2 == 0 ? 0 : sloped));
  }
  return result;
}

}  // namespace ridgeway::testing
