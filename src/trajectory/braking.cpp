// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// From a motion to rest.
#include <algorithm>
#include <array>
#include <utility>

#include "ramps.hpp"
#include "smooth_path.hpp"
#include "speed_scaling.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kShortestStop = 1e-3;  // of v / a: what a stop from next to no motion takes

/// The acceleration of a motion falls smoothly to 0: within a twentieth of v / a, sooner where the
/// speed would pass its limit, but no faster than jerk allows.
Ramps stop_accelerating(const Point& from, const StartState& start, const MotionLimits& limits) {
  constexpr double kUsual = 0.05, kShortest = 1e-4;  // of v / a
  const double acceleration = start.acceleration.norm(), speed = start.velocity.norm();
  const double unit = limits.max_speed / limits.max_acceleration;
  double t =
      std::min(kUsual * unit, kWithinLimit * 2.0 * (limits.max_speed - speed) / acceleration);
  t = std::max(
      {t, kShortest * unit, kSteepestRamp * acceleration / (kWithinLimit * limits.max_jerk)});
  Ramps ramps(from, start);
  ramps.ramp(t, Point::Zero());
  return ramps;
}

}  // namespace

/// Where the path cannot be followed from a motion: to rest, and from there to the path.
std::optional<Trajectory> SmoothPath::brake_first(std::span<const Point> path,
                                                  const StartState& start) {
  auto braking = brake(path.front(), start);
  if (!braking) return std::nullopt;
  const Point stop = braking->at(braking->duration()).position;
  std::vector<Point> rest{stop};
  const bool skips_start = path.size() > 1 && space_.is_free(stop, path[1], config_.radius);
  rest.insert(rest.end(), path.begin() + (skips_start ? 1 : 0), path.end());
  if (!space_.is_free(rest[0], rest[1], config_.radius)) return std::nullopt;
  result_.braked = true;
  note(config_.stop_and_go ? TrajectoryStep::kStopAndGo : TrajectoryStep::kWithStops);
  ++result_.stops;
  if (config_.stop_and_go) result_.stops += static_cast<int>(rest.size()) - 2;
  const Trajectory onward =
      config_.stop_and_go ? stop_and_go(rest) : smooth_or_stop(rest, {}).value();
  braking->segments.insert(braking->segments.end(), onward.segments.begin(), onward.segments.end());
  return braking;
}

/// Braking and starting anew, where that takes less time than a trajectory without a halt.
Trajectory SmoothPath::brake_if_quicker(const Trajectory& found, std::span<const Point> path,
                                        const StartState& start) {
  const TrajectoryStep step = std::exchange(result_.step, TrajectoryStep::kSmooth);
  const int stops = std::exchange(result_.stops, 0);
  auto braking = brake_first(path, start);
  if (braking && braking->duration() < found.duration() && holds(*braking)) return *braking;
  result_.step = step;
  result_.stops = stops;
  result_.braked = false;
  return found;
}

/// The smoothest curve from a motion to rest, wherever that is, in as short a time as the limits
/// allow; nothing where it does not hold.
std::optional<Trajectory> SmoothPath::come_to_rest(const Point& from, const StartState& start,
                                                   DerivativeMask fixed_at_start) const {
  const MotionLimits& limits = config_.motion;
  constexpr DerivativeMask kStopped = kAllFixed & ~kPositionFixed;
  const auto rows = static_cast<Eigen::Index>(knot_size(config_.smoothness));
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(2 * rows, 3);
  derivatives.row(0) = from.transpose();
  derivatives.row(1) = start.velocity.transpose();
  derivatives.row(2) = start.acceleration.transpose();
  const double unit = limits.max_speed / limits.max_acceleration;
  const double speed = start.velocity.norm() + start.acceleration.norm() * unit;
  // Where hardly any motion is left, coordinates are too coarse for what would stop it at once.
  const double duration = std::max(speed / limits.max_acceleration, kShortestStop * unit);
  Trajectory trajectory =
      stretch_to_limits(config_.smoothness, {duration}, std::array{fixed_at_start, kStopped},
                        std::move(derivatives), limits);
  return holds(trajectory) ? std::optional(std::move(trajectory)) : std::nullopt;
}

/// The smoothest way to rest, wherever that is. What still gains speed and must not gain more than
/// a curve in one piece would, stops gaining first.
std::optional<Trajectory> SmoothPath::brake(const Point& from, const StartState& start) const {
  auto braking = come_to_rest(from, start, kStateFixed);
  if (braking || start.acceleration.isZero(0.0)) return braking;
  const Ramps ease = stop_accelerating(from, start, config_.motion);
  braking = come_to_rest(ease.state().position, {.velocity = ease.state().velocity}, kAllFixed);
  if (!braking) return std::nullopt;
  braking->segments.insert(braking->segments.begin(), ease.segments.front());
  return holds(*braking) ? braking : std::nullopt;
}

}  // namespace ridgeway::detail
