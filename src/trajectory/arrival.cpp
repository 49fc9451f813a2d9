// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "arrival.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ramps.hpp"

namespace ridgeway::detail {
namespace {

// Of a limit. Less than straight motions leave: where one ends at full braking, there is no room
// for anything else.
constexpr double kWithin = 1.0 - 3e-6;

/// A motion to rest: a ramp to the first acceleration, which is held, one to the second, which is
/// held as long, and one to none.
struct Stages {
  double ramp = 0.0, hold = 0.0;  ///< seconds, of each
  Eigen::Vector3d first = Point::Zero(), second = Point::Zero();

  double seconds() const { return 3.0 * ramp + 2.0 * hold; }
};

/// `Motion`: Ramps or MotionState.
template <typename Motion>
Motion moved_by(const Stages& stages, Motion motion) {
  motion.ramp(stages.ramp, stages.first);
  motion.ramp(stages.hold, stages.first);
  motion.ramp(stages.ramp, stages.second);
  motion.ramp(stages.hold, stages.second);
  motion.ramp(stages.ramp, Point::Zero());
  return motion;
}

/// The accelerations that end at rest at the offset `way` from the start. Where the motion ends is
/// linear in both, the same along each axis.
Stages stages_to(const Point& way, const StartState& start, double ramp, double hold) {
  const auto end_of = [&](double first, double second) {
    const MotionState end =
        moved_by({ramp, hold, first * Point::UnitX(), second * Point::UnitX()}, MotionState{});
    return Eigen::Vector2d(end.position.x(), end.velocity.x());
  };
  Eigen::Matrix2d gains;
  gains << end_of(1.0, 0.0), end_of(0.0, 1.0);
  const MotionState without =
      moved_by({ramp, hold}, MotionState{Point::Zero(), start.velocity, start.acceleration});
  Eigen::Matrix<double, 2, 3> wanted;
  wanted.row(0) = (way - without.position).transpose();
  wanted.row(1) = -without.velocity.transpose();
  const Eigen::Matrix<double, 2, 3> found = gains.inverse() * wanted;
  return {ramp, hold, found.row(0).transpose(), found.row(1).transpose()};
}

/// The largest share of its limit that acceleration or jerk takes.
double share_of_limits(const Stages& stages, const StartState& start, const MotionLimits& limits) {
  const double change = std::max({(stages.first - start.acceleration).norm(),
                                  (stages.second - stages.first).norm(), stages.second.norm()});
  return std::max({stages.first.norm() / limits.max_acceleration,
                   stages.second.norm() / limits.max_acceleration,
                   kSteepestRamp * change / (stages.ramp * limits.max_jerk)});
}

/// The quickest motion with ramps of a length that keeps the limits; nothing up to a duration.
std::optional<Stages> quickest(const Point& way, const StartState& start,
                               const MotionLimits& limits, double ramp, double longest) {
  constexpr double kStep = 1.05;  // from one duration to the next
  constexpr int kCuts = 30;       // of a third of the range around a least share
  const auto at = [&](double seconds) {
    return stages_to(way, start, ramp, 0.5 * (seconds - 3.0 * ramp));
  };
  const auto share = [&](double seconds) { return share_of_limits(at(seconds), start, limits); };
  double before = 3.01 * ramp, seconds = kStep * before;
  double share_before = share(before), now = share(seconds);
  for (; seconds < longest; before = seconds, seconds *= kStep) {
    if (share_before <= kWithin) return at(before);
    const double next = share(kStep * seconds);
    if (now <= share_before && now <= next && now > kWithin) {
      // Full braking all the way ends at one place only: durations that do may be few.
      double low = before, high = kStep * seconds;
      for (int i = 0; i < kCuts; ++i) {
        const double third = (high - low) / 3.0;
        if (share(low + third) <= share(high - third))
          high -= third;
        else
          low += third;
      }
      if (share(low) <= kWithin) return at(low);
    }
    share_before = std::exchange(now, next);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Trajectory> arrive(const Point& from, const StartState& start, const Point& to,
                                 const MotionLimits& limits,
                                 const std::function<bool(const Trajectory&)>& holds) {
  const double v = limits.max_speed, a = limits.max_acceleration, unit = v / a;
  // Those of straight motions, and shorter; and such as jerk allows for a change by `a`, or by
  // twice as much from one stage to the next.
  constexpr double kShortest = 1e-4;
  const double tightest =
      std::max(kSteepestRamp * a / (kWithin * limits.max_jerk), kShortest * unit);
  std::array ramps = {0.1 * unit, 0.05 * unit,    0.025 * unit,
                      tightest,   1.5 * tightest, 2.0 * tightest};
  for (double& ramp : ramps) ramp = std::max(ramp, tightest);
  std::sort(ramps.begin(), ramps.end());
  const double longest = 4.0 * ((to - from).norm() / v + unit);
  std::optional<Trajectory> best;
  for (std::size_t i = 0; i < ramps.size(); ++i) {
    if (i > 0 && ramps[i] == ramps[i - 1]) continue;
    const auto stages = quickest(to - from, start, limits, ramps[i], longest);
    if (!stages || (best && best->duration() <= stages->seconds())) continue;
    Trajectory trajectory{moved_by(*stages, Ramps(from, start)).segments};
    if (holds(trajectory)) best = std::move(trajectory);
  }
  return best;
}

}  // namespace ridgeway::detail
