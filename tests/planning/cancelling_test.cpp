// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "support/cancelling.hpp"

#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

TEST(Cancelling, StopsBuildsAndChecksAtEveryStage) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {15, 15, 15},
                                             [](const VoxelIndex&) { return VoxelState::kFree; });
  const auto building = [&](const Progress& progress) {
    build_roadmap(map, {.min_clearance = 0.2}, progress);
  };
  EXPECT_EQ(testing::stages_to_stop(building), 9);  // before each of eight stages, and at the end
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.2}).roadmap;
  const auto checking = [&](const Progress& progress) {
    check_roadmap(roadmap, {.queries = 200}, progress);
  };
  EXPECT_EQ(testing::places_to_stop(checking), 5);  // before the edges and each 64 queries
}

/// A query that is part of cancelled work ends like its loops do, whatever it is searching.
TEST(Cancelling, StopsQueries) {
  std::vector<Eigen::Vector2d> axes;
  const Roadmap roadmap =
      build_roadmap(testing::pillars(0, axes), {.min_clearance = testing::kPillarClearance})
          .roadmap;
  const Point start(0.5, 2.9, 0.4), goal(7.4, 3.1, 0.4);
  for (const PlanConfig& config :
       {PlanConfig{.planner = Planner::kEsdf}, PlanConfig{.planner = Planner::kThetaStar},
        PlanConfig{.within = 1.0}, PlanConfig{.prefer_clearance = 3.0}}) {
    SCOPED_TRACE(name_of(config.planner));
    ASSERT_GT(plan(roadmap, start, goal, config).waypoints.size(), 2u);
    int asked = 0;
    const Progress twice = [&](std::string_view, double) { return ++asked < 2; };
    EXPECT_THROW(with_progress(twice, "plan",
                               [&](const Progress&) {
                                 for (;;) plan(roadmap, start, goal, config);
                                 return true;
                               }),
                 Cancelled);
  }
}

}  // namespace
}  // namespace ridgeway
