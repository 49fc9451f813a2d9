// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "trajectory/pillar_room.hpp"

namespace ridgeway {
namespace {

using testing::esdf;
using testing::expect_flown;

TEST(PlanTrajectory, StaysWithinTheLimitsOfTheFlight) {
  int smooth = 0;
  for (const double width : {0.05, 0.4, 2.0}) {
    SCOPED_TRACE(width);
    TrajectoryConfig config{.radius = 0.3};
    config.limits.keep_in.min.z() = 1.0;
    config.limits.keep_in.max.z() = 1.0 + width;
    config.limits.keep_out = {{Point(4, 4, 0), Point(7, 7, 4)}};
    // Along both faces of the band, and close around corners of the box.
    const std::vector<Point> path{{2, 2, 1.0},   {2, 7, 1.0 + width}, {7, 7, 1.0 + width},
                                  {7, 2, 1.0},   {14, 2, 1.0},        {16, 8, 1.0 + 0.5 * width},
                                  {12, 16, 1.0}, {2, 16, 1.0 + width}};
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    smooth += result.step != TrajectoryStep::kStopAndGo;
    for (const TrajectoryState& state : result.trajectory.sample(0.002)) {
      ASSERT_GE(state.position.z(), 1.0 - 2e-8);
      ASSERT_LE(state.position.z(), 1.0 + width + 2e-8);
      const Point p = state.position;
      ASSERT_FALSE(p.x() > 4 + 2e-8 && p.x() < 7 - 2e-8 && p.y() > 4 + 2e-8 && p.y() < 7 - 2e-8);
    }
    const std::vector<Point> out{{2, 2, 1.0}, {2, 7, 1.0 + width + 1e-6}};
    EXPECT_EQ(plan_trajectory(esdf(), out, config).status, TrajectoryStatus::kPathNotFree);
    const std::vector<Point> through{{2, 5, 1.0}, {9, 5, 1.0}};
    EXPECT_EQ(plan_trajectory(esdf(), through, config).status, TrajectoryStatus::kPathNotFree);
  }
  EXPECT_EQ(smooth, 3);
}

TEST(PlanTrajectory, LimitsHoldForAnyLimits) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0), place(1.0, 6.0);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TrajectoryConfig config{.radius = 0.3};
    config.motion.max_speed = 2.0 * std::pow(10.0, exponent(random));
    config.motion.max_acceleration = 2.0 * std::pow(10.0, exponent(random));
    if (i % 2 == 0) config.motion.max_jerk = 10.0 * std::pow(10.0, exponent(random));
    config.motion.max_yaw_rate = std::pow(10.0, exponent(random));
    config.smoothness = i % 4 < 2 ? Smoothness::kSnap : Smoothness::kJerk;
    std::vector<Point> path;
    path.reserve(7);
    for (int k = 0; k < 2 + i % 5; ++k) path.emplace_back(place(random), place(random), 2.0);
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    EXPECT_LE(result.duration, result.stop_and_go_duration * (1 + 1e-12));
  }
}

TEST(PlanTrajectory, ExtremeLimitsGetATrajectory) {
  const std::vector<Point> path{{3, 3, 2}, {5, 3, 2}, {5, 6, 1}};
  for (const double speed : {1e-9, 1e-3, 1.0, 1e3, 1e9})
    for (const double acceleration : {1e-9, 1e-3, 1.0, 1e3, 1e9})
      for (const double jerk : {1e-9, 1.0, 1e9}) {
        SCOPED_TRACE(::testing::Message() << speed << " " << acceleration << " " << jerk);
        TrajectoryConfig config{.radius = 0.3};
        config.motion.max_speed = speed;
        config.motion.max_acceleration = acceleration;
        config.motion.max_jerk = jerk;
        const TrajectoryResult result = plan_trajectory(esdf(), path, config);
        ASSERT_TRUE(result.ok()) << name_of(result.status);
        EXPECT_TRUE(config.motion.hold(result.peaks));
        EXPECT_LE(result.duration, result.stop_and_go_duration * (1 + 1e-12));
        EXPECT_GE(result.clearance, config.radius * (1 - 1e-9));
      }
}

TEST(PlanTrajectory, LongPathsOfTinyRobotsGetNoMoreKnotsThanAreOfUse) {
  TrajectoryConfig config{.radius = 1e-5};
  config.motion.max_speed = 1e-3;
  const std::vector<Point> path{{2, 2, 2}, {2, 7, 2}, {7, 7, 2}, {7, 2, 2}};
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  ASSERT_TRUE(result.ok());
  EXPECT_LT(result.trajectory.segments.size(), 2100u);
  EXPECT_LE(result.duration, result.stop_and_go_duration * (1 + 1e-12));
}

/// Knots are as far apart as speeds that are reached ask for, not those that are allowed.
TEST(PlanTrajectory, MoreSpeedThanCanBeReachedCostsNothing) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(1.0, 8.0);
  double slow = 0.0, fast = 0.0;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    std::vector<Point> path;
    for (int k = 0; k < 6; ++k) {
      const double x = place(random), y = place(random);
      path.emplace_back(x, y, 2.0);
    }
    TrajectoryConfig config{.radius = 0.3};
    std::vector<double> seconds;
    for (const double speed : {3.0, 10.0, 15.0, 1000.0}) {
      config.motion.max_speed = speed;
      const TrajectoryResult result = plan_trajectory(esdf(), path, config);
      expect_flown(result, path, config);
      seconds.push_back(result.duration);
    }
    EXPECT_LE(seconds[1], 1.25 * seconds[0]);
    EXPECT_NEAR(seconds[2], seconds[1], 1e-9);  // neither is reached
    EXPECT_NEAR(seconds[3], seconds[1], 1e-9);
    slow += seconds[0];
    fast += seconds[1];
  }
  EXPECT_LE(fast, slow);
}

}  // namespace
}  // namespace ridgeway
