// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/map_edits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "mapping/random_map.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Crop, KeepsWhatIsWhollyInsideAndObstaclesThatTheBoxCutsThrough) {
  const Box box = {{-1.0, -0.55, -0.3}, {0.7, 1.2, 0.95}};  // faces on and between the planes
  const VoxelRange inside{{-10, -5, -3}, {6, 11, 8}}, touched{{-10, -6, -3}, {6, 11, 9}},
      with_faces{{-10, -6, -3}, {7, 12, 9}};
  for (const double beyond : {0.0, 1e-4}) {
    std::size_t cut_through = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      const OccupancyMap map = testing::clumped_map(seed);
      const OccupancyMap cut = crop(map, box, beyond);
      testing::for_each_known(map, [&](const VoxelIndex& v, VoxelState state) {
        const bool is_obstacle = state == VoxelState::kOccupied;
        const VoxelRange& kept = !is_obstacle ? inside : beyond > 0.0 ? with_faces : touched;
        EXPECT_EQ(testing::state_at(cut, v), kept.contains(v) ? state : VoxelState::kUnknown);
        cut_through += is_obstacle && kept.contains(v) && !inside.contains(v);
      });
    }
    EXPECT_GT(cut_through, 0u);
  }
}

TEST(Crop, InfiniteBoundsChangeNothing) {
  const OccupancyMap map = testing::clumped_map(2);
  EXPECT_TRUE(testing::same_voxels(
      map, crop(map, {Point::Constant(-kInfinity), Point::Constant(kInfinity)})));
}

TEST(Crop, RefusesBoxesInsideOut) {
  const OccupancyMap map = testing::clumped_map(2);
  EXPECT_THROW(crop(map, {{0, 0, 0}, {1, -1, 1}}), InputError);
  EXPECT_THROW(crop(map, {{0, 0, std::nan("")}, {1, 1, 1}}), InputError);
}

TEST(NoFly, ClosesWhatSharesVolumeWithTheBox) {
  const OccupancyMap map = testing::clumped_map(4);
  const Box box = {{-1.0, -0.55, -0.3}, {0.7, 1.2, 0.95}};
  const OccupancyMap closed = add_no_fly(map, std::vector<Box>{box});
  testing::for_each_in({{-25, -25, -25}, {25, 25, 25}}, [&](const VoxelIndex& v) {
    const bool inside = v.x >= -10 && v.x <= 6 && v.y >= -6 && v.y <= 11 && v.z >= -3 && v.z <= 9;
    EXPECT_EQ(testing::state_at(closed, v),
              inside ? VoxelState::kOccupied : testing::state_at(map, v));
  });
}

TEST(NoFly, AnEndlessBoxStaysNearTheKnown) {
  OccupancyBuilder builder(0.1);
  builder.fill({{0, 0, 0}, {15, 15, 15}}, VoxelState::kFree);
  const OccupancyMap map = std::move(builder).finish();
  const std::vector<Box> boxes = {{Point::Constant(-kInfinity), Point(kInfinity, kInfinity, 0.5)}};
  const OccupancyMap closed = add_no_fly(map, boxes);
  EXPECT_EQ(closed.layout.block_count(), 4u * 4u * 2u + 4u);
  EXPECT_EQ(testing::state_at(closed, {-8, -8, -8}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(closed, {7, 7, 4}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(closed, {7, 7, 5}), VoxelState::kFree);
}

TEST(NoFly, AFlatBoxClosesALayer) {
  OccupancyBuilder builder(0.1);
  builder.fill({{0, 0, 0}, {15, 15, 15}}, VoxelState::kFree);
  const OccupancyMap closed =
      add_no_fly(std::move(builder).finish(), std::vector<Box>{{{0, 0, 0.75}, {1.6, 1.6, 0.75}}});
  EXPECT_EQ(count_voxels(closed).occupied, 256u);
  EXPECT_EQ(testing::state_at(closed, {3, 3, 7}), VoxelState::kOccupied);
}

TEST(NoFly, LeavesNoWayAroundABoxWhereUnknownSpaceIsFree) {
  OccupancyBuilder builder(0.1);
  builder.fill({{1, 1, 1}, {59, 59, 29}}, VoxelState::kFree);
  const std::vector<Box> wall = {{{-5, 2.8, -5}, {100, 3.2, 50}}};
  const EsdfMap esdf = compute_esdf(add_no_fly(std::move(builder).finish(), wall),
                                    {.unknown = UnknownPolicy::kFree});
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    const double y = (esdf.origin + esdf.layout.index_of(id)).y * 0.1 + 0.05;
    if (y > 2.8 && y < 3.2) {
      ASSERT_EQ(esdf.state[id], VoxelState::kOccupied);
    }
  }
}

TEST(NoFly, RefusesBoxesInsideOutByNumber) {
  const std::vector<Box> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{0, 2, 0}, {1, 1, 1}}};
  try {
    add_no_fly(testing::clumped_map(2), boxes);
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "no-fly box 2");
  }
}

TEST(RemoveIsolated, FreesClustersBelowTheNumberOnly) {
  OccupancyBuilder builder(0.1);
  builder.fill({{-20, -20, -20}, {20, 20, 20}}, VoxelState::kFree);
  for (int i = 0; i < 3; ++i)
    builder.set({i - 1, i - 1, i - 1}, VoxelState::kOccupied);  // diagonal
  builder.set({10, 0, 0}, VoxelState::kOccupied);
  builder.set({30, 0, 0}, VoxelState::kOccupied);  // in the unknown
  const OccupancyMap map = std::move(builder).finish();
  EXPECT_EQ(count_voxels(remove_isolated(map, 0)).occupied, 5u);
  EXPECT_EQ(count_voxels(remove_isolated(map, 1)).occupied, 5u);
  EXPECT_EQ(count_voxels(remove_isolated(map, 2)).occupied, 3u);
  EXPECT_EQ(count_voxels(remove_isolated(map, 3)).occupied, 3u);
  EXPECT_EQ(count_voxels(remove_isolated(map, 4)).occupied, 0u);
  EXPECT_EQ(count_voxels(remove_isolated(map, 4)).known(), count_voxels(map).known());
  EXPECT_THROW(remove_isolated(map, -1), InputError);
}

TEST(RemovePockets, ForgetsFreeSpaceBelowTheVolumeOnly) {
  OccupancyBuilder builder(0.1);
  builder.fill({{0, 0, 0}, {9, 9, 9}}, VoxelState::kFree);    // a cubic metre
  builder.fill({{20, 0, 0}, {21, 1, 1}}, VoxelState::kFree);  // 8 litres
  builder.set({22, 2, 2}, VoxelState::kFree);                 // touches it at a corner
  builder.fill({{12, 0, 0}, {12, 9, 9}}, VoxelState::kOccupied);
  const OccupancyMap map = std::move(builder).finish();
  EXPECT_EQ(count_voxels(remove_pockets(map, 0.0)).free, 1009u);
  EXPECT_EQ(count_voxels(remove_pockets(map, 0.0085)).free, 1009u);
  EXPECT_EQ(count_voxels(remove_pockets(map, 0.0095)).free, 1000u);
  EXPECT_EQ(count_voxels(remove_pockets(map, 0.99)).free, 1000u);
  EXPECT_EQ(count_voxels(remove_pockets(map, 1.01)).free, 0u);
  EXPECT_EQ(count_voxels(remove_pockets(map, 1.01)).occupied, 100u);
  EXPECT_THROW(remove_pockets(map, std::nan("")), InputError);
}

/// A floor of 6 x 6 columns with a hole of one, and a column apart.
OccupancyMap planar_map() {
  OccupancyBuilder builder(0.5);
  builder.fill({{0, 0, 0}, {5, 5, 0}}, VoxelState::kFree);
  builder.fill({{2, 2, 0}, {2, 2, 0}}, VoxelState::kOccupied);
  builder.fill({{9, 9, 0}, {9, 9, 0}}, VoxelState::kFree);
  return flatten(std::move(builder).finish(), 0.0, 0.5);
}

TEST(PlanarMap, ColumnsCountAsVoxels) {
  EXPECT_EQ(count_voxels(remove_isolated(planar_map(), 1)).occupied, 1u);
  EXPECT_EQ(count_voxels(remove_isolated(planar_map(), 2)).occupied, 0u);
  const double one = 0.125;
  EXPECT_EQ(count_voxels(remove_pockets(planar_map(), one)).free, 36u);
  EXPECT_EQ(count_voxels(remove_pockets(planar_map(), 1.5 * one)).free, 35u);
}

/// Boxes far above close and cut columns just as those beside the layer do, and no block comes
/// above or below the one that a planar map has.
TEST(PlanarMap, BoxesHaveNoHeights) {
  const auto expect_columns = [](const OccupancyMap& map, std::size_t free, std::size_t occupied) {
    EXPECT_TRUE(map.planar);
    EXPECT_EQ(count_voxels(map).free, free);
    EXPECT_EQ(count_voxels(map).occupied, occupied);
    for (const BlockIndex& block : map.layout.blocks()) EXPECT_EQ(block.z, 0);
    for (VoxelId id = 0; id < map.state.size(); ++id)
      EXPECT_EQ(map.state[id], map.state[(id & ~VoxelId{kBlockVoxels - 1}) | (id & 63)]);
  };
  for (const double height : {0.0, 0.25, 1e6}) {
    const Box box = {Point(0.5, 0.5, height), Point(1.5, 1.5, height + 0.5)};
    expect_columns(crop(planar_map(), box), 3, 1);
    const std::vector<Box> boxes{box, {Point(-1.0, 0.0, height), Point(-0.5, 0.25, height)}};
    expect_columns(add_no_fly(planar_map(), boxes), 33, 5);
  }
}

TEST(PlanarMap, IsNotTakenApart) {
  EXPECT_THROW(resample(planar_map(), 1.0), InputError);
  EXPECT_THROW(flatten(planar_map(), 0.0, 0.5), InputError);
  EXPECT_THROW(transform_map(planar_map(), Eigen::Isometry3d::Identity(), 0.5), InputError);
  EXPECT_TRUE(add_no_fly(planar_map(), {}).planar);
  EXPECT_TRUE(resample(planar_map(), 0.5).planar);
}

}  // namespace
}  // namespace ridgeway
