// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/flood.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// Two rooms of 3 x 3 x 2 m beside each other, joined by a door, and a closed cell of 1 x 1 x 1 m
/// behind the second.
const Roadmap& rooms() {
  static const Roadmap roadmap = [] {
    const OccupancyMap map =
        testing::make_map(0.1, {0, 0, 0}, {79, 31, 21}, [](const VoxelIndex& v) {
          const auto within = [&](const VoxelIndex& low, const VoxelIndex& high) {
            return VoxelRange{low, high}.contains(v);
          };
          const bool free = within({1, 1, 1}, {30, 30, 20}) || within({33, 1, 1}, {62, 30, 20}) ||
                            within({31, 10, 1}, {32, 20, 20}) || within({66, 10, 1}, {76, 20, 11});
          return free ? VoxelState::kFree : VoxelState::kOccupied;
        });
    return build_roadmap(map, {.min_clearance = 0.3}).roadmap;
  }();
  return roadmap;
}

TEST(Snap, MovesAnEndInAWallToTheNearestPlaceAndSaysSo) {
  const Point start(1, 1, 1), in_wall(6.4, 1.0, 1.0);
  EXPECT_EQ(plan(rooms(), start, in_wall).status, PlanStatus::kGoalInCollision);
  const PlanResult near = plan(rooms(), start, in_wall, {.snap = 0.2});
  EXPECT_EQ(near.status, PlanStatus::kGoalInCollision);  // nothing so near
  const PlanResult result = plan(rooms(), start, in_wall, {.snap = 1.0});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.waypoints.front(), start);
  EXPECT_EQ(result.moved_start.distance, 0.0);
  EXPECT_GT(result.moved_goal.distance, 0.3);
  EXPECT_LE(result.moved_goal.distance, 0.6);
  EXPECT_EQ(result.waypoints.back(), result.moved_goal.place);
  EXPECT_NEAR((result.moved_goal.place - in_wall).norm(), result.moved_goal.distance, 1e-12);
  const PlanResult back = plan(rooms(), in_wall, start, {.snap = 1.0});
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.moved_start.place, result.moved_goal.place);
  // Outside of the map altogether, and outside of limits.
  EXPECT_TRUE(plan(rooms(), start, Point(-0.5, 1, 1), {.snap = 2.0}).ok());
  FlightLimits limits;
  limits.keep_in.max.x() = 2.0;
  const PlanResult limited =
      plan(rooms(), start, Point(2.2, 1, 1), {.limits = limits, .snap = 1.0});
  ASSERT_TRUE(limited.ok());
  EXPECT_LE(limited.moved_goal.place.x(), 2.0);
}

TEST(Snap, PassesOverNearerPlacesThatCannotBeReached) {
  // Between the cell and the second room: the cell is nearer, and shut.
  const Point start(1, 1, 1), between(6.5, 1.5, 0.6);
  const Point in_cell(7.1, 1.5, 0.6);
  ASSERT_EQ(plan(rooms(), start, in_cell).status, PlanStatus::kNoRoute);
  const PlanResult result = plan(rooms(), start, between, {.snap = 1.5});
  ASSERT_TRUE(result.ok());
  EXPECT_LT(result.moved_goal.place.x(), 6.0);
  // An end that can be used stays where it is, reached or not.
  const PlanResult shut = plan(rooms(), start, in_cell, {.snap = 5.0});
  EXPECT_EQ(shut.status, PlanStatus::kNoRoute);
  EXPECT_EQ(shut.moved_goal.distance, 0.0);
}

TEST(Snap, IsTheNearestReachablePlaceByBruteForce) {
  int moved = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    std::optional<Roadmap> roadmap;
    try {
      roadmap =
          build_roadmap(testing::random_map(seed, 20), {.min_clearance = 0.1, .tangent_pairs = 50})
              .roadmap;
    } catch (const InputError&) {
      continue;
    }
    const EsdfMap& esdf = roadmap->esdf;
    const testing::Regions regions = testing::regions_at(esdf, 0.1);
    std::mt19937 random(seed);
    for (int i = 0; i < 8; ++i) {
      const VoxelId from = regions.voxels[random() % regions.voxels.size()];
      const Point start = centre_of(esdf.layout.index_of(from), esdf.voxel_size);
      const VoxelId any = static_cast<VoxelId>(random() % esdf.layout.voxel_count());
      const Point goal = centre_of(esdf.layout.index_of(any), esdf.voxel_size) + Point(0.02, 0, 0);
      const PlanResult plain = plan(*roadmap, start, goal);
      const PlanResult result = plan(*roadmap, start, goal, {.snap = 0.7});
      if (plain.ok() || plain.status == PlanStatus::kNoRoute) {
        EXPECT_EQ(result.status, plain.status);
        continue;
      }
      double nearest = std::numeric_limits<double>::infinity();
      for (const VoxelId id : regions.voxels)
        if (regions.label.at(id) == regions.label.at(from))
          nearest = std::min(nearest,
                             (centre_of(esdf.layout.index_of(id), esdf.voxel_size) - goal).norm());
      if (nearest > 0.7 + 1e-9) {
        EXPECT_FALSE(result.ok());
        continue;
      }
      // A straight look may reach where no moves lead, which only brings it nearer.
      ASSERT_TRUE(result.ok());
      EXPECT_LE(result.moved_goal.distance, nearest + 1e-9);
      ++moved;
    }
  }
  EXPECT_GT(moved, 30);
}

TEST(Snap, GoesForAlternativesAndViaPlacesOnlyAtTheEnds) {
  const Point in_wall(6.4, 1.0, 1.0), start(1, 1, 1), via(3.15, 1.5, 1.0);
  const Alternatives routes = plan_alternatives(rooms(), start, in_wall, 2, {.snap = 1.0});
  ASSERT_TRUE(routes.ok());
  EXPECT_GT(routes.routes[0].moved_goal.distance, 0.0);
  const std::vector<Point> places{start, via, in_wall};
  const ViaPlan over = plan_via(rooms(), places, {.snap = 1.0});
  ASSERT_TRUE(over.plan.ok());
  EXPECT_NE(std::find(over.plan.waypoints.begin(), over.plan.waypoints.end(), via),
            over.plan.waypoints.end());
  EXPECT_GT(over.plan.moved_goal.distance, 0.0);
  const std::vector<Point> bad{start, in_wall, Point(2, 2, 1)};
  const ViaPlan none = plan_via(rooms(), bad, {.snap = 1.0});
  EXPECT_EQ(none.plan.status, PlanStatus::kGoalInCollision);
  EXPECT_EQ(none.leg, 0u);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plan(rooms(), start, via, {.snap = nan}), InputError);
  EXPECT_THROW(plan(rooms(), start, via, {.snap = -1.0}), InputError);
}

}  // namespace
}  // namespace ridgeway
