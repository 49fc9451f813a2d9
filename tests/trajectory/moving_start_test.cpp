// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "trajectory/pillar_room.hpp"

namespace ridgeway {
namespace {

using testing::esdf;
using testing::expect_flown;

TEST(PlanTrajectory, StartsFromAMotion) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  int braked = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TrajectoryConfig config{.radius = 0.3};
    config.start_velocity = 1.8 * Point(part(random), part(random), 0.3 * part(random)) / 1.5;
    config.start_acceleration = Point(part(random), part(random), 0.0);
    const std::vector<Point> path{{4, 6, 2}, {7, 6.5, 2}, {8, 12, 1}};
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    const TrajectoryState start = result.trajectory.at(0.0);
    EXPECT_LE((start.velocity - config.start_velocity).norm(), 1e-9);
    EXPECT_LE((start.acceleration - config.start_acceleration).norm(), 1e-9);
    braked += result.braked;
  }
  EXPECT_LT(braked, 10);
}

/// Stretching every piece of a long way for one that is beyond the limits would have the robot
/// crawl all along.
TEST(PlanTrajectory, DoesNotCrawlFromAMotion) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const std::vector<Point> path{{4, 6, 2},   {7, 6.5, 2}, {8, 12, 1}, {12, 17, 2},
                                {16, 16, 2}, {17, 10, 2}, {14, 4, 2}, {17, 2, 1}};
  TrajectoryConfig config{.radius = 0.3};
  config.most_evaluations = 30;
  const double from_rest = plan_trajectory(esdf(), path, config).duration;
  double slowest = 0.0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const double yaw = 3.14 * part(random);
    config.start_velocity = (1.6 + 0.38 * part(random)) * Point(std::cos(yaw), std::sin(yaw), 0.0);
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    slowest = std::max(slowest, result.duration / from_rest);
  }
  EXPECT_LT(slowest, 1.3);
}

TEST(PlanTrajectory, BrakesWhereItCannotFollowAndSaysWhereItCannotStop) {
  TrajectoryConfig config{.radius = 0.3};
  config.start_velocity = {2.0, 0.0, 0.0};
  config.stop_and_go = true;  // straight legs cannot be joined in motion
  const std::vector<Point> away{{3, 6, 2}, {3, 9, 2}};
  const TrajectoryResult result = plan_trajectory(esdf(), away, config);
  expect_flown(result, away, config);
  const std::vector<Point> at_the_wall{{19.3, 6, 2}, {19.3, 9, 2}};
  const TrajectoryResult too_late = plan_trajectory(esdf(), at_the_wall, config);
  EXPECT_EQ(too_late.status, TrajectoryStatus::kCannotStopInTime);
  EXPECT_TRUE(too_late.trajectory.segments.empty());
}

/// As a robot does that plans anew at every scan: what it is flying shows that it can be flown.
TEST(PlanTrajectory, GoesOnFromEveryStateOfItsOwn) {
  const Point from(2, 4, 2), to(17, 4, 2);
  for (const double jerk : {std::numeric_limits<double>::infinity(), 20.0})
    for (const bool stops : {false, true}) {
      TrajectoryConfig config{.radius = 0.3};
      config.motion.max_jerk = jerk;
      config.stop_and_go = stops;
      const std::vector<Point> path =
          stops ? std::vector<Point>{from, {9, 3, 2}, to} : std::vector<Point>{from, to};
      const Trajectory flown = plan_trajectory(esdf(), path, config).trajectory;
      TrajectoryConfig anew = config;
      anew.stop_and_go = false;
      for (double time = 0.05; time <= flown.duration(); time += 0.05) {
        SCOPED_TRACE(::testing::Message() << time << " s, jerk " << jerk << ", stops " << stops);
        const TrajectoryState state = flown.at(time);
        anew.start_velocity = state.velocity;
        anew.start_acceleration = state.acceleration;
        const std::vector<Point> rest{state.position, to};
        const TrajectoryResult result = plan_trajectory(esdf(), rest, anew);
        expect_flown(result, rest, anew);
      }
    }
}

/// Planned anew on its last metres, a flight does not end later than it would have; not even where
/// a scan has turned the path a little aside.
TEST(PlanTrajectory, ArrivesFromItsLastMetres) {
  const Point from(2, 4, 2), to(17, 4, 2);
  const TrajectoryConfig config{.radius = 0.3};
  for (const double aside : {0.0, 0.02}) {
    TrajectoryConfig first = config;
    if (aside > 0.0) first.motion.max_acceleration *= 0.9;  // full braking has no room to turn
    const Trajectory flown =
        plan_trajectory(esdf(), std::vector<Point>{from, to}, first).trajectory;
    for (double left = 0.3; left <= 2.5; left += 0.05) {
      SCOPED_TRACE(::testing::Message() << left << " s, aside " << aside);
      const TrajectoryState state = flown.at(flown.duration() - left);
      TrajectoryConfig anew = config;
      anew.start_velocity = state.velocity;
      anew.start_acceleration = state.acceleration;
      const std::vector<Point> rest{state.position, to + Point(0.0, aside * left, 0.0)};
      const TrajectoryResult result = plan_trajectory(esdf(), rest, anew);
      expect_flown(result, rest, anew);
      EXPECT_FALSE(result.braked);
      EXPECT_LE(result.duration, 1.1 * left + 0.1);
    }
  }
}

TEST(PlanTrajectory, StopsFromNextToNoMotion) {
  const std::vector<Point> here{{17, 4, 2}};
  for (const double speed : {1e-3, 1e-5, 1e-7, 1e-12, 1e-300}) {
    SCOPED_TRACE(speed);
    TrajectoryConfig config{.radius = 0.3};
    config.start_velocity = {speed, 0.0, 0.0};
    expect_flown(plan_trajectory(esdf(), here, config), here, config);
  }
}

TEST(PlanTrajectory, StopsAndGoesFromAMotionToo) {
  const std::vector<Point> path{{3, 6, 2}, {7, 6.5, 2}, {8, 12, 1}};
  TrajectoryConfig config{.radius = 0.3};
  config.start_velocity = {0.0, 0.5, 0.0};
  config.stop_and_go = true;
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  EXPECT_TRUE(result.braked);
  EXPECT_EQ(result.step, TrajectoryStep::kStopAndGo);
  EXPECT_EQ(result.optimisations, 0);
}

TEST(PlanTrajectory, PassesPlacesOnAStraightWayFromAMotionAside) {
  const std::vector<Point> path{{2, 5, 2}, {3.2, 5, 2}, {8, 5, 2}};
  TrajectoryConfig config{.radius = 0.3};
  config.via = {path[1]};
  config.start_velocity = {0.0, 1.5, 0.0};
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  double nearest = 1e9;
  for (const TrajectoryState& state : result.trajectory.sample(1e-3))
    nearest = std::min(nearest, (state.position - path[1]).norm());
  EXPECT_LT(nearest, 2e-3);
}

}  // namespace
}  // namespace ridgeway
