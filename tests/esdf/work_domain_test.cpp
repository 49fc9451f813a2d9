// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/work_domain.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr int kBytesPerVoxel = 11;
constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

std::vector<bool> occupied_blocks(const OccupancyMap& map) {
  std::vector<bool> occupied(map.layout.block_count(), false);
  for (VoxelId id = 0; id < map.state.size(); ++id)
    if (map.state[id] == VoxelState::kOccupied) occupied[id / kBlockVoxels] = true;
  return occupied;
}

TEST(SweepDomain, IsNoMoreThanTheCubeOfAFloorUnderFreeSpace) {
  const OccupancyMap cube = testing::make_map(
      0.5, {0, 0, 0}, {79, 79, 79},
      [](const VoxelIndex& v) { return v.z == 0 ? VoxelState::kOccupied : VoxelState::kFree; });
  const BlockLayout domain =
      detail::sweep_domain(cube.layout, occupied_blocks(cube), kAnyDistance, kBytesPerVoxel);
  EXPECT_EQ(domain.block_count(), 1000u);
  EXPECT_EQ(compute_esdf(cube, {.unknown = UnknownPolicy::kIgnore}).layout.block_count(), 1728u);
}

TEST(SweepDomain, HoldsTheTargetAndStaysInTheBoxAroundItAndInReach) {
  std::mt19937 random(1);
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  for (int round = 0; round < 60; ++round) {
    std::vector<BlockIndex> blocks;
    BlockIndex low{99, 99, 99}, high{-99, -99, -99};
    for (int i = 0; i < 12; ++i) {
      const BlockIndex b{below(14) - 7, below(9) - 4, below(14) - 7};
      blocks.push_back(b);
      low = {std::min(low.x, b.x), std::min(low.y, b.y), std::min(low.z, b.z)};
      high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
    }
    const BlockLayout target(blocks);
    std::vector<bool> occupied(target.block_count(), false);
    occupied[static_cast<std::size_t>(below(target.block_count()))] = true;
    const int reach = below(3);
    const BlockLayout domain = detail::sweep_domain(
        target, occupied, reach == 0 ? kAnyDistance : 8.0 * reach, kBytesPerVoxel);
    for (const BlockIndex& b : target.blocks())
      ASSERT_NE(domain.find_block(b), BlockLayout::kNoBlock);
    for (const BlockIndex& b : domain.blocks()) {
      ASSERT_TRUE(b.x >= low.x && b.y >= low.y && b.z >= low.z);
      ASSERT_TRUE(b.x <= high.x && b.y <= high.y && b.z <= high.z);
      if (reach == 0) continue;
      ASSERT_TRUE(std::any_of(target.blocks().begin(), target.blocks().end(), [&](const auto& t) {
        return std::max({std::abs(b.x - t.x), std::abs(b.y - t.y), std::abs(b.z - t.z)}) <= reach;
      }));
    }
  }
}

TEST(SweepDomain, OfAFarAwayBlockIsThreeRunsToIt) {
  const BlockLayout target({{0, 0, 0}, {900, -800, 1000}});
  const BlockLayout domain =
      detail::sweep_domain(target, {true, false}, kAnyDistance, kBytesPerVoxel);
  EXPECT_EQ(domain.block_count(), 900u + 800u + 1000u + 1u);
}

TEST(SweepDomain, ABlockFarAwayDoesNotLetItGrowAroundACube) {
  OccupancyMap cube = testing::make_map(0.5, {0, 0, 0}, {79, 79, 79}, [](const VoxelIndex& v) {
    return v.z == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const std::vector<BlockIndex> stray{{100, 100, 100}};
  cube.layout.add(stray);
  cube.state.grow(cube.layout, VoxelState::kOccupied);
  const BlockLayout domain =
      detail::sweep_domain(cube.layout, occupied_blocks(cube), kAnyDistance, kBytesPerVoxel);
  EXPECT_EQ(domain.block_count(), 1001u);
}

TEST(SweepDomain, RefusesWhatMemoryWouldNotDoForBeforeItIsTaken) {
  const BlockLayout target({{0, 0, 0}, {900, 900, 900}});
  constexpr int kManyBytes = 1 << 30;
  try {
    detail::sweep_domain(target, {true, false}, kAnyDistance, kManyBytes);
    FAIL() << "terabytes were granted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "map");
    EXPECT_NE(error.remedy().find("max_distance"), std::string::npos) << error.remedy();
  }
}

}  // namespace
}  // namespace ridgeway
