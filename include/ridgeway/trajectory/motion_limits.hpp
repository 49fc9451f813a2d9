// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <numbers>

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// What a trajectory may ask of the robot: magnitudes of the vectors, not of single axes.
struct MotionLimits {
  double max_speed = 2.0;                                     ///< m/s
  double max_acceleration = 2.0;                              ///< m/s^2
  double max_jerk = std::numeric_limits<double>::infinity();  ///< m/s^3
  double max_yaw_rate = 0.5 * std::numbers::pi;               ///< rad/s

  /// Throws InputError naming the field that is not above 0 (only the last two may be infinite).
  void validate() const;

  bool hold(const MotionPeaks& peaks) const {
    return peaks.speed <= max_speed && peaks.acceleration <= max_acceleration &&
           peaks.jerk <= max_jerk && peaks.yaw_rate <= max_yaw_rate;
  }
};

}  // namespace ridgeway
