// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/brute_force.hpp"
#include "support/flood.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// The same map with all that is unknown in the blocks around what is known made free.
OccupancyMap all_but_occupied(const OccupancyMap& map) {
  const VoxelRange known = known_range(map);
  const VoxelIndex low = voxel_of(block_of(known.min), 0);
  const VoxelIndex high = voxel_of(block_of(known.max), kBlockVoxels - 1);
  return testing::make_map(map.voxel_size, low, high, [&](const VoxelIndex& v) {
    return map.at(v) == VoxelState::kOccupied ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(UnknownIsFree, GivesTheFieldOfAMapWhoseUnknownVoxelsAreFree) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 20);
    const EsdfMap field = compute_esdf(map, {.unknown = UnknownPolicy::kFree});
    const OccupancyMap filled = all_but_occupied(map);
    const EsdfMap expected = compute_esdf(filled, {.unknown = UnknownPolicy::kIgnore});
    for (VoxelId id = 0; id < field.layout.voxel_count(); ++id) {
      const VoxelIndex v = field.layout.index_of(id);
      const VoxelId same = expected.layout.find(v);
      ASSERT_NE(same, kNoVoxel);
      ASSERT_EQ(field.squared[id], expected.squared[same]);
      ASSERT_EQ(field.is_open(id), filled.at(v) == VoxelState::kFree);
      ASSERT_EQ(field.state[id], map.at(v));  // what is known is not forgotten
    }
  }
}

TEST(UnknownIsFree, AnswersAsFloodingDoesAndKeepsItsPathsOffWhatIsOccupied) {
  int routes = 0, none = 0, through = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 20);
    const Roadmap roadmap =
        build_roadmap(map,
                      {.min_clearance = 0.1, .unknown = UnknownPolicy::kFree, .tangent_pairs = 50})
            .roadmap;
    const EsdfMap& esdf = roadmap.esdf;
    const OccupancyMap filled = all_but_occupied(map);
    const EsdfMap judge = compute_esdf(filled, {.unknown = UnknownPolicy::kIgnore});
    const testing::Regions regions = testing::regions_at(judge, 0.1);
    const auto obstacles = testing::all_obstacles(map, UnknownPolicy::kFree);
    const Surroundings around(esdf);
    std::mt19937 random(seed);
    for (int i = 0; i < 10; ++i) {
      const VoxelId from = regions.voxels[random() % regions.voxels.size()];
      const VoxelId to = regions.voxels[random() % regions.voxels.size()];
      const Point start = centre_of(judge.layout.index_of(from), esdf.voxel_size);
      const Point goal = centre_of(judge.layout.index_of(to), esdf.voxel_size);
      const PlanResult result = plan(roadmap, start, goal);
      ASSERT_EQ(result.unknown, UnknownPolicy::kFree);
      ASSERT_EQ(result.ok(), regions.label.at(from) == regions.label.at(to));
      result.ok() ? ++routes : ++none;
      double inside = 0.0, all = 0.0;  // by looking at many places
      for (std::size_t k = 1; k < result.waypoints.size(); ++k) {
        const Point a = result.waypoints[k - 1], along = result.waypoints[k] - a;
        const int pieces = 1 + static_cast<int>(along.norm() / 0.001);
        for (int j = 0; j < pieces; ++j) {
          const Point p = a + along * ((j + 0.5) / pieces);
          all += along.norm() / pieces;
          if (map.at(voxel_at(p, esdf.voxel_size)) == VoxelState::kUnknown)
            inside += along.norm() / pieces;
          if (j % 20 == 0)
            ASSERT_GE(esdf.voxel_size * std::sqrt(testing::brute_squared_distance(
                                            p / esdf.voxel_size, obstacles)),
                      0.1 * (1 - 1e-8));
        }
      }
      if (!result.ok() || all == 0.0) continue;
      const double share = around.along(result.waypoints, 0.1).unknown_inside;
      ASSERT_NEAR(share, inside / all, 0.01 + 0.002 / all);
      through += share > 0.0;
    }
    const CheckReport report = check_roadmap(roadmap, {.queries = 20});
    EXPECT_TRUE(report.is_clean());
  }
  EXPECT_GT(routes, 100);
  EXPECT_GT(through, 30);
}

// Nothing is near anything there, and no look for obstacles goes as far as numbers do.
TEST(UnknownIsFree, AMapWithoutObstaclesIsPlannedIn) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {19, 19, 19},
                                             [](const VoxelIndex&) { return VoxelState::kFree; });
  for (const double max_distance : {std::numeric_limits<double>::infinity(), 1000.0, 2.0}) {
    const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.2,
                                                .unknown = UnknownPolicy::kFree,
                                                .max_distance = max_distance})
                                .roadmap;
    const CheckReport report = check_roadmap(roadmap, {.queries = 20});
    EXPECT_TRUE(report.is_clean());
    EXPECT_EQ(report.graph_ok, 20u);
    const PlanResult result =
        plan(roadmap, Point(0.25, 0.25, 0.25), Point(1.7, 1.2, 0.3), {.shorten = false});
    ASSERT_TRUE(result.ok());
    EXPECT_GE(result.clearance, std::min(max_distance, 1000.0) - 0.01);
  }
}

}  // namespace
}  // namespace ridgeway
