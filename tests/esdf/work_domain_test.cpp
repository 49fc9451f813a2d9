// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/work_domain.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "support/brute_force.hpp"
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

/// Islands that no step leads between, half of them without an obstacle.
TEST(SweepDomain, IslandsHaveTheDistancesOfBruteForce) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    std::vector<BlockIndex> blocks;
    blocks.reserve(7);
    for (int i = 0; i < 7; ++i) blocks.push_back({3 * below(4), 3 * below(3), 3 * below(4)});
    OccupancyMap map;
    map.voxel_size = 1.0;
    map.layout = BlockLayout(blocks);
    map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
    for (std::uint32_t slot = 0; slot < map.layout.block_count(); slot += 2)
      map.state[slot * kBlockVoxels + static_cast<VoxelId>(below(kBlockVoxels))] =
          VoxelState::kOccupied;
    for (const double farthest : {kAnyDistance, 30.0, 12.0}) {
      const EsdfMap esdf =
          compute_esdf(map, {.unknown = UnknownPolicy::kIgnore, .max_distance = farthest});
      const std::vector<VoxelIndex> obstacles = testing::all_obstacles(map, UnknownPolicy::kIgnore);
      for (VoxelId id = 0; id < esdf.layout.voxel_count(); id += 7) {
        if (esdf.state[id] != VoxelState::kFree) continue;
        const double brute = std::sqrt(
            testing::brute_squared_distance(centre_of(esdf.layout.index_of(id), 1.0), obstacles));
        if (brute < farthest - 2.0) {
          ASSERT_NEAR(esdf.distance(id), brute, 1e-9);
        } else if (std::isfinite(farthest)) {
          ASSERT_GE(esdf.distance(id), farthest - 2.0);
        }
      }
    }
  }
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
