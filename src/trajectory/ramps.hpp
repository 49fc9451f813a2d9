// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "initial_spline.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// Largest slope of the ramp 10 x^3 - 15 x^4 + 6 x^5: jerk over change of acceleration over time.
inline constexpr double kSteepestRamp = 1.875;
/// Of a limit: what motions of ramps go up to, so that peaks that are certified hold it.
inline constexpr double kWithinLimit = 1.0 - 1e-5;

/// A motion of pieces in which acceleration goes smoothly from one value to the next: as 10 x^3 -
/// 15 x^4 + 6 x^5, so that all derivatives up to the fourth are continuous where pieces meet.
class Ramps {
 public:
  Ramps(const Point& from, const StartState& start)
      : position_(from), velocity_(start.velocity), acceleration_(start.acceleration) {}

  /// A piece in which acceleration goes from what it is to another; the same: it is held.
  void add(double duration, const Eigen::Vector3d& acceleration);

  const Point& position() const { return position_; }  ///< where the motion has come to
  const Eigen::Vector3d& velocity() const { return velocity_; }

  std::vector<TrajectorySegment> segments;

 private:
  Point position_;
  Eigen::Vector3d velocity_, acceleration_;
};

}  // namespace ridgeway::detail
