// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include "ridgeway/planning/plan.hpp"
#include "trajectory/pillar_room.hpp"

namespace ridgeway {
namespace {

using testing::esdf;

/// A path from a place 0.2 m off the wall at x = 0.1 to one 0.25 m off it, by way of others.
PlanResult between_escapes(const std::vector<Point>& middle) {
  PlanResult path;
  path.status = PlanStatus::kOk;
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
  const PlanResult path = between_escapes({{0.5, 5, 2}, {4, 7, 2}, {0.5, 9, 2}});
  expect_joined(fly_plan(esdf(), path, {}), path, 2);
  TrajectoryConfig config;
  config.via = path.waypoints;
  expect_joined(fly_plan(esdf(), path, config), path, 2);
}

TEST(FlyPlan, StopsOnceWhereBothEscapesEndAtOnePlace) {
  const PlanResult path = between_escapes({{0.5, 5, 2}});
  expect_joined(fly_plan(esdf(), path, {}), path, 1);
}

TEST(FlyPlan, AYawThatStaysIsKeptFromLegToLeg) {
  TrajectoryConfig config;
  config.follow_yaw = false;
  const PlanResult path = between_escapes({{0.5, 5, 2}, {4, 7, 2}, {0.5, 9, 2}});
  const TrajectoryResult flown = fly_plan(esdf(), path, config);
  expect_joined(flown, path, 2);
  const double yaw = flown.trajectory.at(0.0).yaw;
  for (const TrajectoryState& state : flown.trajectory.sample(0.05)) ASSERT_EQ(state.yaw, yaw);
}

}  // namespace
}  // namespace ridgeway
