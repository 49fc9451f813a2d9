// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ramps.hpp"

namespace ridgeway::detail {

void Ramps::ramp(double duration, const Eigen::Vector3d& to) {
  const Eigen::Vector3d change = to - state_.acceleration;
  const double t = duration;
  TrajectorySegment segment;
  segment.duration = t;
  const auto set = [&](int power, const Eigen::Vector3d& value) {
    segment.coefficients.col(power).head<3>() = value;
  };
  set(0, state_.position);
  set(1, state_.velocity);
  set(2, 0.5 * state_.acceleration);
  set(5, 0.5 * change / (t * t * t));
  set(6, -0.5 * change / (t * t * t * t));
  set(7, change / (7.0 * t * t * t * t * t));
  segments.push_back(segment);
  state_.ramp(duration, to);
}

}  // namespace ridgeway::detail
