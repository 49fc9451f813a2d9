// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "straight_motion.hpp"

#include <algorithm>
#include <cmath>

#include "ramps.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kRiseOfStage = 0.1;  // rise over (rise + hold)
constexpr double kRounding = 1e-12;   // of a rise: what is shorter is a difference that is none

struct Profile {
  double rise = 0.0, hold = 0.0, cruise = 0.0;  ///< seconds
  double acceleration = 0.0;
};

/// A stage gains a (rise + hold) of speed over a (rise + hold) (2 rise + hold) / 2 of length.
Profile choose_profile(double length, const MotionLimits& limits) {
  const double v = limits.max_speed * kWithinLimit, jerk = limits.max_jerk * kWithinLimit;
  Profile p;
  // Where jerk is so tight that the speed is reached before the acceleration, less of the latter.
  p.acceleration =
      std::min(limits.max_acceleration * kWithinLimit, std::sqrt(v * jerk / kSteepestRamp));
  const double tightest = kSteepestRamp * p.acceleration / jerk;
  p.rise = std::max(kRiseOfStage * v / p.acceleration, tightest);
  const double stage = v / p.acceleration;
  if (length >= v * (stage + p.rise)) {
    p.hold = stage - p.rise;
    p.cruise = length / v - stage - p.rise;
    return p;
  }
  const double ratio = 1.0 / kRiseOfStage;  // (rise + hold) / rise
  p.rise = std::max(std::sqrt(length / (p.acceleration * ratio * (ratio + 1.0))), tightest);
  const double h =
      0.5 * (std::sqrt(p.rise * p.rise + 4.0 * length / p.acceleration) - 3.0 * p.rise);
  if (h >= 0.0) {
    p.hold = h;
    return p;
  }
  p.rise = std::max(std::sqrt(0.5 * length / p.acceleration),
                    std::cbrt(0.5 * kSteepestRamp * length / jerk));
  p.acceleration = 0.5 * length / (p.rise * p.rise);
  return p;
}

}  // namespace

std::vector<TrajectorySegment> straight_motion(const Point& from, const Point& to,
                                               const MotionLimits& limits) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) return {};
  const Profile p = choose_profile(length, limits);
  const Eigen::Vector3d along = (to - from) / length;
  Ramps ramps(from, {});
  const auto add = [&](double duration, double acceleration) {
    ramps.ramp(duration, acceleration * along);
  };
  const double shortest = kRounding * p.rise;
  const auto hold = [&](double duration, double acceleration) {
    if (duration > shortest) add(duration, acceleration);
  };
  add(p.rise, p.acceleration);
  hold(p.hold, p.acceleration);
  add(p.rise, 0.0);
  hold(p.cruise, 0.0);
  add(p.rise, -p.acceleration);
  hold(p.hold, -p.acceleration);
  add(p.rise, 0.0);
  return ramps.segments;
}

}  // namespace ridgeway::detail
