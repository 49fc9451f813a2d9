// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ramps.hpp"

namespace ridgeway::detail {

void Ramps::add(double duration, const Eigen::Vector3d& acceleration) {
  const Eigen::Vector3d change = acceleration - acceleration_;
  const double t = duration;
  TrajectorySegment segment;
  segment.duration = t;
  const auto set = [&](int power, const Eigen::Vector3d& value) {
    segment.coefficients.col(power).head<3>() = value;
  };
  set(0, position_);
  set(1, velocity_);
  set(2, 0.5 * acceleration_);
  set(5, 0.5 * change / (t * t * t));
  set(6, -0.5 * change / (t * t * t * t));
  set(7, change / (7.0 * t * t * t * t * t));
  segments.push_back(segment);
  position_ += t * velocity_ + t * t * (0.5 * acceleration_ + change / 7.0);
  velocity_ += t * (acceleration_ + 0.5 * change);
  acceleration_ = acceleration;
}

}  // namespace ridgeway::detail
