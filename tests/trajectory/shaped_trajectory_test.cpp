// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "trajectory/shaped_trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace ridgeway {
namespace {

Trajectory some_trajectory() {
  Random random(5);
  Trajectory trajectory;
  for (const double duration : {0.7, 1.3, 0.4}) {
    TrajectorySegment segment;
    segment.duration = duration;
    for (int d = 0; d < kFlatOutputs; ++d)
      for (int k = 0; k < kCoefficients; ++k)
        segment.coefficients(d, k) = random.uniform(-1.0, 1.0);
    trajectory.segments.push_back(segment);
  }
  return trajectory;
}

TEST(ShapedTrajectory, TailIsTheRest) {
  const Trajectory whole = some_trajectory();
  for (const double from : {0.0, 0.3, 0.7, 1.9, 2.3, 2.4, 9.0}) {
    const Trajectory tail = detail::tail_of(whole, from);
    EXPECT_NEAR(tail.duration(), std::max(whole.duration() - from, 0.0), 1e-12);
    for (double t = 0.01; t < tail.duration(); t += 0.05)
      EXPECT_LT((tail.at(t).position - whole.at(from + t).position).norm(), 1e-9);
  }
}

TEST(ShapedTrajectory, HeadAndTailAreTheWhole) {
  const Trajectory whole = some_trajectory();
  for (const double until : {0.3, 0.7, 1.9, 2.4}) {
    const Trajectory head = detail::head_of(whole, until);
    EXPECT_NEAR(head.duration(), std::min(until, whole.duration()), 1e-12);
    for (double t = 0.01; t < head.duration(); t += 0.05)
      EXPECT_LT((head.at(t).position - whole.at(t).position).norm(), 1e-9);
    EXPECT_NEAR(head.duration() + detail::tail_of(whole, until).duration(), whole.duration(),
                1e-12);
  }
}

TEST(ShapedTrajectory, TurnsAtTheLimitAndLeavesPlacesAlone) {
  for (const double goal : {0.5, -2.0, 3.0, 6.0}) {
    const Trajectory before = some_trajectory();
    Trajectory turned = before;
    detail::turn_to(turned, 1.0, goal, 0.8);
    const double turn = detail::turn_between(1.0, goal);
    EXPECT_NEAR(turned.duration(), std::max(before.duration(), std::abs(turn) / 0.8), 1e-12);
    for (double t = 0.01; t < turned.duration(); t += 0.05) {
      const TrajectoryState state = turned.at(t);
      if (t < before.duration()) EXPECT_LT((state.position - before.at(t).position).norm(), 1e-9);
      EXPECT_LE(std::abs(state.yaw_rate), 0.8 + 1e-12);
      EXPECT_NEAR(state.yaw, 1.0 + std::copysign(std::min(0.8 * t, std::abs(turn)), turn), 1e-9);
    }
  }
}

TEST(ShapedTrajectory, TurnsByWayOfAnotherYawAndIsBackInTime) {
  constexpr double kRate = 8.0, kUntil = 1.6;
  for (const double between : {-2.5, 0.3, 2.0, 3.1}) {
    Trajectory before = some_trajectory();
    detail::turn_to(before, 1.0, -2.9, kRate);
    Trajectory turned = before;
    detail::turn_by_way_of(turned, between, kUntil, kRate);
    EXPECT_NEAR(turned.duration(), before.duration(), 1e-12);
    const double there = std::abs(detail::turn_between(1.0, between)) / kRate;
    const double back = std::abs(detail::turn_between(between, -2.9)) / kRate;
    double last = 1.0;
    for (double t = 0.01; t < turned.duration(); t += 0.01) {
      const TrajectoryState state = turned.at(t);
      EXPECT_LT((state.position - before.at(t).position).norm(), 1e-9);
      EXPECT_LE(std::abs(state.yaw - last), 0.01 * kRate + 1e-9) << "a jump at " << t;
      last = state.yaw;
      if (t > there && t < kUntil - back)
        EXPECT_NEAR(detail::turn_between(state.yaw, between), 0.0, 1e-9);
      if (t >= kUntil) EXPECT_NEAR(detail::turn_between(state.yaw, before.at(t).yaw), 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace ridgeway
