// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "straight_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ridgeway::detail {
namespace {

constexpr double kSteepest = 1.875;     // largest slope of the rise 10 x^3 - 15 x^4 + 6 x^5
constexpr double kRiseOfStage = 0.1;    // rise over (rise + hold)
constexpr double kWithin = 1.0 - 1e-5;  // of a limit, so that certified peaks hold it
constexpr double kRounding = 1e-12;     // of a rise: what is shorter is a difference that is none

struct Profile {
  double rise = 0.0, hold = 0.0, cruise = 0.0;  ///< seconds
  double acceleration = 0.0;
};

/// A stage gains a (rise + hold) of speed over a (rise + hold) (2 rise + hold) / 2 of length.
Profile choose_profile(double length, const MotionLimits& limits) {
  const double v = limits.max_speed * kWithin, jerk = limits.max_jerk * kWithin;
  Profile p;
  // Where jerk is so tight that the speed is reached before the acceleration, less of the latter.
  p.acceleration = std::min(limits.max_acceleration * kWithin, std::sqrt(v * jerk / kSteepest));
  const double tightest = kSteepest * p.acceleration / jerk;
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
                    std::cbrt(0.5 * kSteepest * length / jerk));
  p.acceleration = 0.5 * length / (p.rise * p.rise);
  return p;
}

/// Appends pieces of a motion along a line, each from the state that the last one left.
class LineBuilder {
 public:
  LineBuilder(const Point& from, const Point& direction) : from_(from), direction_(direction) {}

  /// Acceleration goes smoothly from what it is to `acceleration`.
  void add(double duration, double acceleration) {
    const double change = acceleration - acceleration_, t = duration;
    std::array<double, kCoefficients> c{position_, speed_, 0.5 * acceleration_};
    c[5] = 0.5 * change / (t * t * t);
    c[6] = -0.5 * change / (t * t * t * t);
    c[7] = change / (7.0 * t * t * t * t * t);
    TrajectorySegment segment;
    segment.duration = t;
    for (int k = 0; k < kCoefficients; ++k)
      segment.coefficients.col(k).head<3>() = c[static_cast<std::size_t>(k)] * direction_;
    segment.coefficients.col(0).head<3>() += from_;
    segments.push_back(segment);
    position_ += t * speed_ + t * t * (0.5 * acceleration_ + change / 7.0);
    speed_ += t * (acceleration_ + 0.5 * change);
    acceleration_ = acceleration;
  }

  std::vector<TrajectorySegment> segments;

 private:
  Point from_, direction_;
  double position_ = 0.0, speed_ = 0.0, acceleration_ = 0.0;
};

}  // namespace

std::vector<TrajectorySegment> straight_motion(const Point& from, const Point& to,
                                               const MotionLimits& limits) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) return {};
  const Profile p = choose_profile(length, limits);
  LineBuilder line(from, (to - from) / length);
  const double shortest = kRounding * p.rise;
  const auto hold = [&](double duration, double acceleration) {
    if (duration > shortest) line.add(duration, acceleration);
  };
  line.add(p.rise, p.acceleration);
  hold(p.hold, p.acceleration);
  line.add(p.rise, 0.0);
  hold(p.cruise, 0.0);
  line.add(p.rise, -p.acceleration);
  hold(p.hold, -p.acceleration);
  line.add(p.rise, 0.0);
  return line.segments;
}

}  // namespace ridgeway::detail
