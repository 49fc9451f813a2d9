// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <random>

#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::testing {

struct RandomShape {
  BlockLayout layout;
  VoxelMask voxels;
};

/// Boxes and balls added and taken away, and single voxels flipped: solids with tunnels, cavities
/// and rough skins, over several blocks and up to the border of what is allocated.
inline RandomShape random_shape(unsigned seed, int side = 22) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<BlockIndex> blocks;
  const int count = (side + kBlockSide - 1) / kBlockSide;
  for (int z = 0; z < count; ++z)
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < count; ++x)
        if (below(12) != 0) blocks.push_back({x - 1, y - 1, z - 1});
  RandomShape shape{BlockLayout(std::move(blocks)), {}};
  shape.voxels = VoxelMask(shape.layout);
  const int low = -kBlockSide;
  const auto put = [&](const VoxelIndex& v, bool present) {
    const VoxelId id = shape.layout.find(v);
    if (id == kNoVoxel) return;
    present ? shape.voxels.set(id) : shape.voxels.reset(id);
  };
  const int things = 8 + below(30);
  for (int i = 0; i < things; ++i) {
    const bool add = i < 4 || below(5) < 2, ball = below(2) == 0;
    // What is added is bulky, what is taken away is thin: it leaves tunnels and cavities.
    const int bulk = add ? side / 2 : 4;
    VoxelIndex size{1 + below(bulk), 1 + below(bulk), 1 + below(bulk)};
    if (!add) (i % 3 == 0 ? size.x : i % 3 == 1 ? size.y : size.z) = 1 + below(side);
    const VoxelIndex from{low + below(side), low + below(side), low + below(side)};
    for (int z = 0; z < size.z; ++z)
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
          const double r = std::hypot((2.0 * x + 1) / size.x - 1, (2.0 * y + 1) / size.y - 1,
                                      (2.0 * z + 1) / size.z - 1);
          if (!ball || r < 1.0) put(from + VoxelIndex{x, y, z}, add);
        }
  }
  const int flips = below(120);
  for (int i = 0; i < flips; ++i)
    put({low + below(side), low + below(side), low + below(side)}, below(2) == 0);
  return shape;
}

}  // namespace ridgeway::testing
