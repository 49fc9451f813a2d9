// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "skeleton/level_gather.hpp"
#include "skeleton/steepest_ways.hpp"

namespace ridgeway::detail {
namespace {

/// What is found of every voxel of a block: neighbours above, as high, and steepest ways.
template <int lanes>
void look(const Levels& levels, const Bordered<float>& heights, std::vector<std::uint32_t>& found) {
  for (VoxelId first = 0; first < kBlockVoxels; first += lanes) {
    const LevelCubes<lanes> cubes(levels, bordered_place(first));
    const auto steepest = steepest_ways<lanes>(&heights[bordered_place(first)], cubes.higher);
    for (int lane = 0; lane < lanes; ++lane)
      found.insert(found.end(), {cubes.higher[lane], cubes.level[lane], steepest[lane]});
  }
}

TEST(Lanes, ForTheMachinesRegistersGiveWhatFourGive) {
  std::mt19937 random(1);
  for (const std::uint32_t highest : {2u, 9u, 1000u, 4000000000u}) {
    Levels levels{};
    for (std::uint32_t& level : levels)
      level = std::uniform_int_distribution<std::uint32_t>(0, highest)(random);
    Bordered<float> heights{};
    std::transform(levels.begin(), levels.end(), heights.begin(),
                   [](std::uint32_t level) { return static_cast<float>(level); });
    std::vector<std::uint32_t> by_four, by_machine;
    look<4>(levels, heights, by_four);
    with_lanes([&]<int lanes>(LaneCount<lanes>) { look<lanes>(levels, heights, by_machine); });
    EXPECT_EQ(by_four, by_machine) << highest;
  }
}

TEST(Lanes, RowsOfAMaskAreItsMembers) {
  const BlockLayout layout({{0, 0, 0}});
  VoxelMask mask(layout);
  std::mt19937 random(2);
  for (VoxelId id = 0; id < kBlockVoxels; ++id)
    if (random() % 3 == 0) mask.set(id);
  for (VoxelId id = 64; id < 128; ++id) mask.reset(id);
  with_lanes([&]<int lanes>(LaneCount<lanes>) {
    VoxelMask again(layout);
    for_each_row_of<lanes>(mask, 0, [&](VoxelId first, unsigned members) {
      EXPECT_NE(members, 0u);
      for (VoxelId x = 0; x < lanes; ++x)
        if ((members >> x & 1) != 0) again.set(first + x);
    });
    EXPECT_EQ(again.block(0), mask.block(0));
  });
}

}  // namespace
}  // namespace ridgeway::detail
