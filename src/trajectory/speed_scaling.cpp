// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "speed_scaling.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeway::detail {
namespace {

constexpr double kABitSlower = 1.0 + 1e-5;  // so that peaks, certified to 1e-6, keep the limits
constexpr double kStretch = 1.08, kLeastStretch = 1.01;
constexpr int kMostStretches = 25;  // to seven times the durations

/// How many times longer a motion from rest to rest must take to keep the limits.
double excess_of(const MotionPeaks& peaks, const MotionLimits& limits) {
  return std::max({peaks.speed / limits.max_speed,
                   std::sqrt(peaks.acceleration / limits.max_acceleration),
                   std::cbrt(peaks.jerk / limits.max_jerk)});
}

/// Makes the pieces longer that are beyond the limits, and a little those beside them. Whether
/// there were any.
bool stretch_pieces(const Trajectory& trajectory, const MotionLimits& limits,
                    std::vector<double>& durations) {
  std::vector<double> factors(durations.size(), 1.0);
  const auto raise = [&](std::size_t i, double factor) {
    if (i < factors.size()) factors[i] = std::max(factors[i], factor);
  };
  bool is_beyond = false;
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const double excess = excess_of(find_peaks(trajectory.segments[i]), limits);
    if (excess <= 1.0) continue;
    is_beyond = true;
    const double factor = std::clamp(excess, kLeastStretch, kStretch);
    raise(i, factor);
    raise(i - 1, 0.5 * (1.0 + factor));  // before the first: a number that no piece has
    raise(i + 1, 0.5 * (1.0 + factor));
  }
  for (std::size_t i = 0; i < durations.size(); ++i) durations[i] *= factors[i];
  return is_beyond;
}

}  // namespace

void scale_to_limits(Trajectory& trajectory, const MotionLimits& limits) {
  const MotionPeaks peaks = find_peaks(trajectory);
  const double factor = kABitSlower * excess_of(peaks, limits);
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
  std::vector<double> pieces = durations;
  for (int tries = 0; tries < kMostStretches; ++tries) {
    MinimumSpline(smoothness, pieces, fixed).solve(derivatives);
    Trajectory trajectory = make_trajectory(smoothness, pieces, derivatives);
    if (stretch_pieces(trajectory, limits, pieces)) continue;
    if (keeps_limits(trajectory, limits)) return trajectory;
    break;
  }
  for (int tries = 0;; ++tries) {
    MinimumSpline(smoothness, durations, fixed).solve(derivatives);
    Trajectory trajectory = make_trajectory(smoothness, durations, derivatives);
    if (tries == kMostStretches || keeps_limits(trajectory, limits)) return trajectory;
    for (double& duration : durations) duration *= kStretch;
  }
}

bool keeps_limits(const Trajectory& trajectory, const MotionLimits& limits) {
  return limits.hold(find_peaks(trajectory));
}

}  // namespace ridgeway::detail
