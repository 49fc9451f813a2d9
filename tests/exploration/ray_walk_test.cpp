// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration/ray_walk.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace ridgeway {
namespace {

/// Steps along the line by a hundredth of a voxel.
bool brute_sees(const EsdfMap& esdf, const Point& from, const VoxelIndex& target) {
  const Point to = centre_of(target, esdf.voxel_size);
  const int steps = static_cast<int>((to - from).norm() / (0.01 * esdf.voxel_size)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const VoxelIndex voxel = voxel_at(from + (to - from) * i / steps, esdf.voxel_size);
    if (voxel == target) return true;
    const VoxelId id = esdf.layout.find(voxel);
    if (id == kNoVoxel || esdf.state[id] != VoxelState::kFree) return false;
  }
  return true;
}

TEST(RayWalk, SeesWhatSmallStepsSee) {
  OccupancyMap map;
  map.voxel_size = 0.25;
  std::vector<BlockIndex> blocks;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) blocks.push_back({x, y, z});
  map.layout = BlockLayout(blocks);
  map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const VoxelIndex low{static_cast<int>(random.below(24)), static_cast<int>(random.below(24)),
                         static_cast<int>(random.below(24))};
    for (int d = 0; d < 27; ++d)
      if (const VoxelId id = map.layout.find(low + offset_of(d)); id != kNoVoxel)
        map.state[id] = i % 3 == 0 ? VoxelState::kUnknown : VoxelState::kOccupied;
  }
  const EsdfMap esdf = compute_esdf(map);
  int seen = 0, asked = 0, different = 0;
  while (asked < 3000) {
    const Point from(random.uniform(0.0, 6.0), random.uniform(0.0, 6.0), random.uniform(0.0, 6.0));
    const VoxelId id = esdf.layout.find(voxel_at(from, 0.25));
    if (esdf.state[id] != VoxelState::kFree) continue;
    const VoxelIndex target{static_cast<int>(random.below(26)) - 1,
                            static_cast<int>(random.below(26)) - 1,
                            static_cast<int>(random.below(26)) - 1};
    ++asked;
    const bool sees = detail::sees(esdf, from, target);
    seen += sees;
    different += sees != brute_sees(esdf, from, target);
  }
  // Steps miss corners that are cut by less than a hundredth of a voxel.
  EXPECT_LE(different, asked / 200);
  EXPECT_GT(seen, asked / 10);
  EXPECT_LT(seen, asked * 9 / 10);
}

}  // namespace
}  // namespace ridgeway
