// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "trajectory/pillar_room.hpp"

namespace ridgeway {
namespace {

using testing::esdf;
using testing::expect_flown;

// Limits for which holding an acceleration, or a speed, takes no time but for rounding.
TEST(PlanTrajectory, StopAndGoHoldsTheLimitOfYawWhereAPieceWouldTakeNoTime) {
  const std::vector<Point> path{{2, 4, 2}, {4.5, 4.5, 2}, {4, 1.5, 2}};
  for (const double speed : {0.2, 0.5, 1.0, 2.0})
    for (const double acceleration : {0.3, 1.0, 3.0, 10.0})
      for (const double jerk : {0.5, 1.0, 5.0, 20.0}) {
        TrajectoryConfig config{.radius = 0.3};
        config.stop_and_go = true;
        config.motion.max_speed = speed;
        config.motion.max_acceleration = acceleration;
        config.motion.max_jerk = jerk;
        const TrajectoryResult result = plan_trajectory(esdf(), path, config);
        ASSERT_TRUE(result.ok());
        EXPECT_LE(result.peaks.yaw_rate, config.motion.max_yaw_rate * (1 + 1e-9));
        EXPECT_LE(result.peaks.speed, speed * (1 + 1e-9));
        EXPECT_LE(result.peaks.jerk, jerk * (1 + 1e-9));
        for (const TrajectorySegment& segment : result.trajectory.segments)
          EXPECT_GT(segment.duration, 1e-9);
      }
}

TEST(PlanTrajectory, YawFollowsTheDirectionOfTravelWithoutJumps) {
  // Once round the pillar and a half, over the place where atan2 jumps.
  std::vector<Point> path;
  for (int i = 0; i <= 90; ++i) {
    const double angle = 0.1 * i;
    path.emplace_back(10 + 5 * std::cos(angle), 10 + 5 * std::sin(angle), 2.0);
  }
  TrajectoryConfig config{.radius = 0.3};
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  double before = result.trajectory.at(0.0).yaw, worst = 0.0;
  EXPECT_NEAR(before, std::numbers::pi / 2, 0.2);
  for (const TrajectoryState& state : result.trajectory.sample(0.01)) {
    EXPECT_LE(std::abs(state.yaw - before), 0.02);
    before = state.yaw;
    if (state.velocity.norm() < 1.0) continue;
    const double heading = std::atan2(state.velocity.y(), state.velocity.x());
    worst = std::max(worst, std::abs(std::remainder(state.yaw - heading, 2 * std::numbers::pi)));
  }
  EXPECT_LE(worst, 0.35);
  EXPECT_GT(before, 9.0);  // unwrapped

  // From stop to stop over a right angle: it has turned a second and a half after the stop, however
  // long the leg.
  const std::vector<Point> corner{{3, 3, 2}, {6, 3, 2}, {6, 17, 2}};
  TrajectoryConfig stopping{.radius = 0.3};
  stopping.stop_and_go = true;
  const TrajectoryResult stopped = plan_trajectory(esdf(), corner, stopping);
  expect_flown(stopped, corner, stopping);
  const double stop = 0.5 * 3 + 1.1, turned = stop + 0.5 * std::numbers::pi * 2.5 / 1.5;
  EXPECT_NEAR(stopped.trajectory.at(stop - 0.5).yaw, 0.0, 0.01);
  EXPECT_NEAR(stopped.trajectory.at(turned + 0.5).yaw, std::numbers::pi / 2, 0.01);

  config.follow_yaw = false;
  config.start_yaw = 1.0;
  const TrajectoryResult fixed = plan_trajectory(esdf(), path, config);
  for (const TrajectoryState& state : fixed.trajectory.sample(0.1)) EXPECT_EQ(state.yaw, 1.0);
}

TEST(PlanTrajectory, YawWithoutALimitBeginsWhereItIs) {
  const std::vector<Point> path = {{3, 3, 1}, {7, 5, 1}, {7, 9, 1}};
  for (const double rate : {1e3, 1e9, 1e40, HUGE_VAL}) {
    TrajectoryConfig config{.radius = 0.3};
    config.motion.max_yaw_rate = rate;
    config.start_yaw = 2.5;
    const TrajectoryResult flown = plan_trajectory(esdf(), path, config);
    ASSERT_TRUE(flown.ok()) << rate;
    EXPECT_NEAR(flown.trajectory.at(0.0).yaw, 2.5, 1e-9) << rate;
    EXPECT_TRUE(std::isfinite(flown.peaks.yaw_rate)) << rate;
    for (const TrajectoryState& at : flown.trajectory.sample(0.01))
      ASSERT_TRUE(std::isfinite(at.yaw) && std::isfinite(at.yaw_rate)) << rate;
  }
}

}  // namespace
}  // namespace ridgeway
