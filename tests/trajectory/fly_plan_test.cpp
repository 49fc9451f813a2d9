// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "trajectory/pillar_room.hpp"

namespace ridgeway {
namespace {

using testing::esdf;

/// A path from a place 0.2 m off the wall at x = 0.1 to one 0.25 m off it, by way of others.
PlanResult between_escapes(const std::vector<Point>& middle) {
  PlanResult path;
  path.status = PlanStatus::kOk;
  path.planned_for.radius = 0.3;
  path.waypoints = {{0.3, 5, 2}};
  path.waypoints.insert(path.waypoints.end(), middle.begin(), middle.end());
  path.waypoints.emplace_back(0.35, middle.back().y(), 2);
  path.escape_start = {.length = (middle.front() - path.waypoints.front()).norm(),
                       .clearance = 0.2};
  path.escape_goal = {.length = (middle.back() - path.waypoints.back()).norm(), .clearance = 0.25};
  return path;
}

void expect_joined(const TrajectoryResult& flown, const PlanResult& path, int stops) {
  ASSERT_TRUE(flown.ok()) << name_of(flown.status);
  EXPECT_EQ(flown.stops, stops);
  EXPECT_GE(flown.clearance, 0.3 * (1 - 1e-9));
  EXPECT_TRUE(find_doubts(esdf(), flown.trajectory, 0.2 * (1 - 1e-9)).empty());
  EXPECT_EQ(flown.trajectory.at(0.0).position, path.waypoints.front());
  EXPECT_LT((flown.trajectory.at(flown.duration).position - path.waypoints.back()).norm(), 1e-9);
  EXPECT_NEAR(flown.trajectory.duration(), flown.duration, 1e-9);
  for (const TrajectorySegment& segment : flown.trajectory.segments)
    EXPECT_GT(segment.duration, 0.0);
}

TEST(FlyPlan, StopsWhereAnEscapeEnds) {
  const PlanResult path = between_escapes({{0.5, 5, 2}, {4, 7.1, 2}, {0.5, 9, 2}});
  expect_joined(fly_plan(esdf(), path, {}), path, 2);
  TrajectoryConfig config{.radius = 0.3};
  config.via = path.waypoints;
  expect_joined(fly_plan(esdf(), path, config), path, 2);
}

TEST(FlyPlan, StopsOnceWhereBothEscapesEndAtOnePlace) {
  const PlanResult path = between_escapes({{0.5, 5, 2}});
  expect_joined(fly_plan(esdf(), path, {}), path, 1);
}

TEST(FlyPlan, TellsNothingOfLegsWhereOneCannotBeFlown) {
  PlanResult path = between_escapes({{0.5, 5, 2}, {4, 7, 2}, {0.5, 9, 2}});
  path.escape_goal.clearance = 0.3;  // it has less
  const TrajectoryResult none = fly_plan(esdf(), path, {});
  EXPECT_EQ(none.status, TrajectoryStatus::kPathNotFree);
  EXPECT_TRUE(none.trajectory.segments.empty());
  EXPECT_EQ(none.duration, 0.0);
  EXPECT_EQ(none.clearance, 0.0);
  EXPECT_EQ(none.stops, 0);
}

TEST(FlyPlan, RefusesTwoEscapesOfTwoPoints) {
  PlanResult path = between_escapes({{0.5, 5, 2}});
  path.waypoints.erase(path.waypoints.begin() + 1);
  EXPECT_THROW(fly_plan(esdf(), path, {}), InputError);
}

TEST(FlyPlan, AYawThatStaysIsKeptFromLegToLeg) {
  TrajectoryConfig config{.radius = 0.3};
  config.follow_yaw = false;
  const PlanResult path = between_escapes({{0.5, 5, 2}, {4, 7, 2}, {0.5, 9, 2}});
  const TrajectoryResult flown = fly_plan(esdf(), path, config);
  expect_joined(flown, path, 2);
  const double yaw = flown.trajectory.at(0.0).yaw;
  for (const TrajectoryState& state : flown.trajectory.sample(0.05)) ASSERT_EQ(state.yaw, yaw);
}

/// A plan is flown by the robot, and within the limits, that it was asked for.
TEST(FlyPlan, TheRobotIsThatOfThePlan) {
  const Roadmap roadmap = build_roadmap(testing::pillar_room(), {.min_clearance = 0.3}).roadmap;
  const PlanConfig asked = {.radius = 0.5,
                            .limits = {.keep_out = {{Point(4.0, 3.0, 0.0), Point(6.0, 7.0, 4.0)}}},
                            .robot_height = 1.4};
  const PlanResult path = plan(roadmap, {2, 5, 2}, {17, 5, 2}, asked);
  ASSERT_TRUE(path.ok());
  const TrajectoryResult flown = fly_plan(roadmap.esdf, path, {});
  ASSERT_TRUE(flown.ok()) << name_of(flown.status);
  const FreeSpace space(roadmap.esdf, asked.limits, 0.5, 1.4);
  for (const TrajectoryState& state : flown.trajectory.sample(0.01))
    ASSERT_TRUE(space.is_free(to_local(roadmap.esdf, state.position), 0.5 * (1 - 1e-9)));
  const TrajectoryResult wide = fly_plan(roadmap.esdf, path, {.radius = 2.5});
  EXPECT_EQ(wide.status, TrajectoryStatus::kPathNotFree);  // what is said counts

  PlanResult own = given_plan(roadmap.esdf, {{2, 5, 2}, {3, 5, 2}});
  EXPECT_THROW(fly_plan(roadmap.esdf, own, {}), InputError);
  EXPECT_THROW(plan_trajectory(roadmap.esdf, own.waypoints, {}), InputError);
}

TEST(FlyPlan, WhatIsFlownIsHeldAgainstANewerMap) {
  const TrajectoryConfig config{.radius = 0.3};
  const std::vector<Point> path{{2, 4, 2}, {9, 3, 2}, {17, 4, 2}};
  const Trajectory flown = plan_trajectory(esdf(), path, config).trajectory;
  EXPECT_TRUE(still_safe(flown, config, esdf()));
  OccupancyMap closed = testing::pillar_room();
  closed.state[closed.layout.find({60, 34, 20})] = VoxelState::kOccupied;
  const EsdfMap now = compute_esdf(closed);
  EXPECT_FALSE(still_safe(flown, config, now));
  double passed = 0.0;
  while (flown.at(passed).position.x() < 6.6) passed += 0.01;
  EXPECT_TRUE(still_safe(flown, config, now, passed));
  EXPECT_TRUE(still_safe(flown, config, now, 1e9));
  EXPECT_THROW(still_safe(flown, config, now, std::nan("")), InputError);
  EXPECT_THROW(still_safe({}, config, now), InputError);
  EXPECT_THROW(still_safe(flown, {}, now), InputError);
}

}  // namespace
}  // namespace ridgeway
