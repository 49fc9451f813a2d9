// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/occupancy_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <type_traits>

#include "mapping/random_map.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

TEST(OccupancyBuilder, OccupiedWinsOverFreeInAnyOrder) {
  for (const bool occupied_first : {true, false}) {
    OccupancyBuilder builder(0.1);
    const VoxelRange box = {{-9, -9, -9}, {9, 9, 9}};
    if (occupied_first) builder.set({-9, 3, 8}, VoxelState::kOccupied);
    builder.fill(box, VoxelState::kFree);
    if (!occupied_first) builder.set({-9, 3, 8}, VoxelState::kOccupied);
    builder.set({-9, 3, 8}, VoxelState::kFree);
    builder.set({-9, 3, 8}, VoxelState::kUnknown);
    const OccupancyMap map = std::move(builder).finish();
    EXPECT_EQ(testing::state_at(map, {-9, 3, 8}), VoxelState::kOccupied);
    EXPECT_EQ(count_voxels(map).occupied, 1u);
    EXPECT_EQ(count_voxels(map).free, 19u * 19u * 19u - 1u);
  }
}

TEST(OccupancyBuilder, EqualsAPlainTableOfVoxels) {
  std::mt19937 random(7);
  const auto below = [&random](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
  };
  OccupancyBuilder builder(0.2, {.clip = {{-25, -20, -30}, {25, 29, 20}}});
  std::map<VoxelIndex, VoxelState> table;
  for (int i = 0; i < 200; ++i) {
    const auto state = below(3) == 0 ? VoxelState::kOccupied : VoxelState::kFree;
    const VoxelIndex low = {below(60) - 30, below(60) - 30, below(60) - 30};
    const VoxelRange range = {low, low + VoxelIndex{below(12), below(3), below(20)}};
    builder.fill(range, state);
    testing::for_each_in(range, [&](const VoxelIndex& v) {
      if (builder.clip().contains(v)) table[v] = std::max(table[v], state);
    });
  }
  const OccupancyMap map = std::move(builder).finish();
  for (const auto& [voxel, state] : table) EXPECT_EQ(testing::state_at(map, voxel), state);
  EXPECT_EQ(count_voxels(map).known(), table.size());
}

TEST(OccupancyBuilder, RefusesWhatDoesNotFitBeforeTakingIt) {
  OccupancyBuilder builder(0.1, {.name = "huge.bt"});
  try {
    builder.fill({{0, 0, 0}, {100'000'000, 100'000'000, 100}}, VoxelState::kFree);
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "huge.bt");
    EXPECT_NE(error.remedy().find("larger voxels"), std::string::npos);
    EXPECT_NE(error.remedy().find("smaller box"), std::string::npos);
  }
}

TEST(OccupancyBuilder, RefusesNonsenseVoxelSizes) {
  for (const double size : {0.0, -0.1, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(OccupancyBuilder{size}, InputError);
}

TEST(OccupancyMap, KnownBoundsAreTight) {
  EXPECT_FALSE(
      known_bounds(OccupancyMap{.voxel_size = 0.1, .origin = {}, .layout = {}, .state = {}}));
  for (unsigned seed = 0; seed < 5; ++seed) {
    const OccupancyMap map = testing::clumped_map(seed);
    Point low = Point::Constant(1e9), high = Point::Constant(-1e9);
    testing::for_each_known(map, [&](const VoxelIndex& v, VoxelState) {
      low = low.cwiseMin(Point(v.x, v.y, v.z) * 0.1);
      high = high.cwiseMax(Point(v.x + 1, v.y + 1, v.z + 1) * 0.1);
    });
    const auto bounds = known_bounds(map);
    ASSERT_TRUE(bounds);
    EXPECT_EQ(bounds->min, low);
    EXPECT_EQ(bounds->max, high);
  }
}

TEST(Normalised, KeepsAllVoxelsOnTheBlocksThatHoldAKnownOne) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    OccupancyMap map = testing::clumped_map(seed);
    for (int local = 0; local < kBlockVoxels; ++local)
      map.state.block(4)[local] = VoxelState::kUnknown;
    const OccupancyMap same = normalised(map);
    EXPECT_TRUE(testing::same_voxels(map, same));
    EXPECT_EQ(known_range(same).min, (VoxelIndex{0, 0, 0}));
    for (std::uint32_t slot = 0; slot < same.layout.block_count(); ++slot) {
      const VoxelState* states = same.state.block(slot);
      EXPECT_TRUE(std::any_of(states, states + kBlockVoxels,
                              [](VoxelState s) { return s != VoxelState::kUnknown; }));
    }
  }
}

TEST(Normalised, MapsThatDifferByWholeVoxelsBecomeTheSame) {
  std::mt19937 random(5);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const OccupancyMap map = testing::clumped_map(seed);
    const auto part = [&] { return static_cast<int>(random() % 4001) - 2000; };
    const VoxelIndex shift = {part(), part(), part()};
    OccupancyMap elsewhere;  // the same voxels, counted from another one
    elsewhere.voxel_size = map.voxel_size;
    elsewhere.origin = VoxelIndex{5'000'000, -70'000'000, 3} - shift;
    std::vector<BlockIndex> blocks;
    testing::for_each_known(map, [&](const VoxelIndex& v, VoxelState) {
      blocks.push_back(block_of(v - map.origin + shift));
    });
    elsewhere.layout = BlockLayout(std::move(blocks));
    elsewhere.state = VoxelField<VoxelState>(elsewhere.layout);
    testing::for_each_known(map, [&](const VoxelIndex& v, VoxelState state) {
      elsewhere.state[elsewhere.layout.find(v - map.origin + shift)] = state;
    });
    const OccupancyMap same = normalised(std::move(elsewhere));
    EXPECT_EQ(same.origin, (VoxelIndex{5'000'000, -70'000'000, 3}));
    EXPECT_TRUE(same.layout == map.layout);
    EXPECT_TRUE(same.state.values() == map.state.values());
  }
}

TEST(Normalised, RefusesWhatLiesBeyondTheLimitOfTheLattice) {
  for (const int far : {1'000'000'000, -1'000'000'000}) {
    OccupancyBuilder builder(0.1, {.name = "far.bt"});
    builder.fill({{far, 0, far}, {far, 3, far}}, VoxelState::kFree);
    const VoxelIndex beyond = {0, far > 0 ? far + 1 : far - 1, 0};
    try {
      builder.set(beyond, VoxelState::kFree);
      FAIL() << "was not refused";
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), "far.bt");
    }
    EXPECT_EQ(std::move(builder).finish().origin, (VoxelIndex{far, 0, far}));
    OccupancyMap map = testing::clumped_map(1);
    map.origin = {0, far, 0};
    if (far > 0)
      EXPECT_THROW(normalised(map), InputError);
    else
      EXPECT_NO_THROW(normalised(map));
  }
}

TEST(OccupancyBuilder, TakesNoStatesOfOthers) {
  OccupancyBuilder builder(0.1);
  for (const int state : {3, 100, 255}) {
    EXPECT_THROW(builder.set({1, 2, 3}, static_cast<VoxelState>(state)), InputError) << state;
    EXPECT_THROW(builder.fill({{0, 0, 0}, {1, 1, 1}}, static_cast<VoxelState>(state)), InputError);
  }
  static_assert(!std::is_copy_constructible_v<OccupancyBuilder>);  // it points into itself
  static_assert(!std::is_move_constructible_v<OccupancyBuilder>);
}

}  // namespace
}  // namespace ridgeway
