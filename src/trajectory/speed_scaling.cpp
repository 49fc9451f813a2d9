// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "speed_scaling.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeway::detail {
namespace {

constexpr double kABitSlower = 1.0 + 1e-5;  // so that peaks, certified to 1e-6, keep the limits
constexpr double kStretch = 1.08;
constexpr int kMostStretches = 25;  // to seven times the durations

}  // namespace

void scale_to_limits(Trajectory& trajectory, const MotionLimits& limits) {
  const MotionPeaks peaks = find_peaks(trajectory);
  const double factor =
      kABitSlower * std::max({peaks.speed / limits.max_speed,
                              std::sqrt(peaks.acceleration / limits.max_acceleration),
                              std::cbrt(peaks.jerk / limits.max_jerk)});
  if (!(factor > 0.0)) return;  // it stands
  for (TrajectorySegment& segment : trajectory.segments) {
    segment.duration *= factor;
    double power = 1.0;
    for (int k = 0; k < kCoefficients; ++k, power *= factor) segment.coefficients.col(k) /= power;
  }
}

Trajectory stretch_to_limits(Smoothness smoothness, std::vector<double> durations,
                             std::span<const DerivativeMask> fixed, Eigen::MatrixXd derivatives,
                             const MotionLimits& limits) {
  for (int tries = 0;; ++tries) {
    MinimumSpline(smoothness, durations, fixed).solve(derivatives);
    Trajectory trajectory = make_trajectory(smoothness, durations, derivatives);
    if (tries == kMostStretches || keeps_limits(trajectory, limits)) return trajectory;
    for (double& duration : durations) duration *= kStretch;
  }
}

bool keeps_limits(const Trajectory& trajectory, const MotionLimits& limits) {
  const MotionPeaks peaks = find_peaks(trajectory);
  return peaks.speed <= limits.max_speed && peaks.acceleration <= limits.max_acceleration &&
         peaks.jerk <= limits.max_jerk;
}

}  // namespace ridgeway::detail
