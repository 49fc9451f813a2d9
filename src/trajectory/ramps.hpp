// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "initial_spline.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// Largest slope of the ramp 10 x^3 - 15 x^4 + 6 x^5: jerk over change of acceleration over time.
inline constexpr double kSteepestRamp = 1.875;
/// Of a limit: what straight motions go up to, so that peaks, which are certified to a share of
/// 1e-6, hold it, and there is room to go on from them.
inline constexpr double kWithinLimit = 1.0 - 1e-5;

/// Where a motion has come to, and how it moves there.
struct MotionState {
  Point position = Point::Zero();
  Eigen::Vector3d velocity = Point::Zero(), acceleration = Point::Zero();

  /// Acceleration goes smoothly from what it is to another, as 10 x^3 - 15 x^4 + 6 x^5; to the
  /// same: it is held.
  void ramp(double duration, const Eigen::Vector3d& to) {
    const double t = duration;
    const Eigen::Vector3d change = to - acceleration;
    position += t * velocity + t * t * (0.5 * acceleration + change / 7.0);
    velocity += t * (acceleration + 0.5 * change);
    acceleration = to;
  }
};

/// A motion of such ramps, one after the other: all derivatives up to the fourth are continuous
/// where they meet.
class Ramps {
 public:
  Ramps(const Point& from, const StartState& start)
      : state_{from, start.velocity, start.acceleration} {}

  void ramp(double duration, const Eigen::Vector3d& to);

  const MotionState& state() const { return state_; }

  std::vector<TrajectorySegment> segments;

 private:
  MotionState state_;
};

}  // namespace ridgeway::detail
