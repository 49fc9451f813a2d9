// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/trajectory/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

TrajectorySegment random_segment(std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  TrajectorySegment segment;
  segment.duration = std::pow(10.0, value(random));
  const int degree = 1 + static_cast<int>(random() % 9);
  for (int k = 0; k <= degree; ++k)
    for (int d = 0; d < kFlatOutputs; ++d)
      segment.coefficients(d, k) = 5.0 * value(random) / std::pow(segment.duration, k);
  return segment;
}

TEST(Trajectory, PeaksAreNeverBelowDenseSamplesAndHardlyAbove) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const TrajectorySegment segment = random_segment(random);
    const MotionPeaks peaks = find_peaks(segment);
    MotionPeaks seen;
    constexpr int kSamples = 20000;
    for (int k = 0; k <= kSamples; ++k) {
      const double t = segment.duration * k / kSamples;
      const auto rate = segment.derivative(1, t);
      seen.speed = std::max(seen.speed, rate.head<3>().norm());
      seen.acceleration = std::max(seen.acceleration, segment.derivative(2, t).head<3>().norm());
      seen.jerk = std::max(seen.jerk, segment.derivative(3, t).head<3>().norm());
      seen.yaw_rate = std::max(seen.yaw_rate, std::abs(rate.w()));
    }
    const auto check = [](double certified, double sampled) {
      ASSERT_GE(certified, sampled * (1.0 - 1e-12));
      ASSERT_LE(certified, sampled * (1.0 + 5e-6) + 1e-8);
    };
    check(peaks.speed, seen.speed);
    check(peaks.acceleration, seen.acceleration);
    check(peaks.jerk, seen.jerk);
    check(peaks.yaw_rate, seen.yaw_rate);
  }
}

TEST(Trajectory, PeaksAreThoseOfAParabola) {
  // v = 1 - 8 (t - 1/2)^2: fastest in the middle and, backwards, at both ends.
  TrajectorySegment segment;
  segment.duration = 1.0;
  segment.coefficients(0, 1) = 1.0 - 0.25 * 8.0;
  segment.coefficients(0, 2) = 0.5 * 8.0;
  segment.coefficients(0, 3) = -8.0 / 3.0;
  EXPECT_NEAR(find_peaks(segment).speed, 1.0, 1e-6);
  EXPECT_GE(find_peaks(segment).speed, 1.0 - 1e-15);
}

TEST(Trajectory, SamplesAreThoseOfSingleTimesAndEndExactly) {
  std::mt19937 random(2);
  Trajectory trajectory;
  for (int i = 0; i < 5; ++i) trajectory.segments.push_back(random_segment(random));
  const auto states = trajectory.sample(0.037);
  ASSERT_GT(states.size(), 2u);
  EXPECT_EQ(states.front().time, 0.0);
  EXPECT_DOUBLE_EQ(states.back().time, trajectory.duration());
  for (const TrajectoryState& state : states) {
    const TrajectoryState single = trajectory.at(state.time);
    EXPECT_LE((single.position - state.position).norm(), 1e-9);
    EXPECT_LE((single.acceleration - state.acceleration).norm(), 1e-9);
    EXPECT_NEAR(single.yaw, state.yaw, 1e-9);
  }
  EXPECT_EQ(trajectory.at(-1.0).position, trajectory.at(0.0).position);
  EXPECT_LE((trajectory.at(1e9).position - states.back().position).norm(), 1e-9);
  EXPECT_TRUE(Trajectory{}.sample(0.1).empty());
}

TEST(Trajectory, WithoutSegmentsHasNoStates) {
  EXPECT_THROW(Trajectory{}.at(0.0), InputError);
  EXPECT_TRUE(Trajectory{}.sample(0.1).empty());
}

TEST(Trajectory, RefusesStepsThatNeverReachTheEnd) {
  std::mt19937 random(3);
  Trajectory trajectory;
  trajectory.segments.push_back(random_segment(random));
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double step : {0.0, -0.0, -0.1, std::nan(""), kInfinite, -kInfinite, 1e-300, 1e-9,
                            std::numeric_limits<double>::denorm_min()})
    EXPECT_THROW(trajectory.sample(step), InputError) << step;
  EXPECT_EQ(trajectory.sample(1e300).size(), 2u);
  EXPECT_EQ(Trajectory{{TrajectorySegment{}}}.sample(1e-300).size(), 1u);  // takes no time
}

}  // namespace
}  // namespace ridgeway
