// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "smooth_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "arrival.hpp"
#include "common/clock.hpp"
#include "initial_spline.hpp"
#include "obstacle_field.hpp"
#include "optimise_spline.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "speed_scaling.hpp"
#include "straight_motion.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kSpacing = 0.75;       // of v^2 / a: between knots, at most
constexpr double kLeastSpacing = 2.0;   // radii
constexpr double kMostPieces = 2000.0;  // of a path: tiny robots would have any number on long ones
constexpr double kMarginOfRadius = 1.0 / 3;  // in which the collision cost pushes,
constexpr double kLeastMargin = 2.0;         // at least voxels

/// Of the speed that is reached: what is tried next where nothing holds at that, as the corners are
/// too sharp for it. Of 25 flights at 5 m/s around tree five stopped without, none with it.
constexpr double kSlower = 0.6;
constexpr double kSlow = 1.25;  // times the likely duration: a trajectory that is worth another try
constexpr int kMostTries = 3;   // at a quicker one

struct Try {
  TrajectoryStep step;
  double spacing;  ///< of knots, times the usual
  double push;     ///< times the usual weight of collision
  bool anew;       ///< from knots on the path, not from where the last try ended
};
constexpr std::array<Try, 4> kTries{{{TrajectoryStep::kSmooth, 1.0, 1.0, true},
                                     {TrajectoryStep::kPushed, 1.0, 10.0, false},
                                     {TrajectoryStep::kInserted, 0.5, 10.0, true},
                                     {TrajectoryStep::kInserted, 0.5, 100.0, false}}};

class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += seconds_now() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  const double start_ = seconds_now();
};

void append(Trajectory& to, const std::vector<TrajectorySegment>& segments) {
  to.segments.insert(to.segments.end(), segments.begin(), segments.end());
}

/// The corners, neither first nor last, nearest to places; ascending.
std::vector<std::size_t> nearest_corners(std::span<const Point> path,
                                         const std::vector<Point>& places) {
  std::vector<std::size_t> corners;
  for (const Point& place : places) {
    const auto nearest =
        std::min_element(path.begin() + 1, path.end() - 1, [&](const Point& a, const Point& b) {
          return (a - place).squaredNorm() < (b - place).squaredNorm();
        });
    corners.push_back(static_cast<std::size_t>(nearest - path.begin()));
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

double knot_spacing(std::span<const Point> path, const MotionLimits& limits, double radius) {
  return std::max({kSpacing * limits.max_speed * limits.max_speed / limits.max_acceleration,
                   kLeastSpacing * radius, length_of(path) / kMostPieces});
}

SmoothPath::SmoothPath(const FreeSpace& space, const TrajectoryConfig& config,
                       TrajectoryResult& result)
    : space_(space), config_(config), result_(result) {
  cost_.smoothness = config.smoothness;
  cost_.motion = config.motion;
  cost_.radius = config.radius;
  cost_.margin = std::max(kLeastMargin * space.map().voxel_size, kMarginOfRadius * config.radius);
  field_ = obstacle_field(space, cost_.radius, cost_.margin);
}

void SmoothPath::note(TrajectoryStep step) { result_.step = std::max(result_.step, step); }

Trajectory SmoothPath::stop_and_go(std::span<const Point> path) const {
  Trajectory trajectory;
  for (std::size_t i = 1; i < path.size(); ++i)
    append(trajectory, straight_motion(path[i - 1], path[i], config_.motion));
  return trajectory;
}

bool SmoothPath::holds(const Trajectory& trajectory) const {
  const Stopwatch watch(result_.seconds.verify);
  return keeps_limits(trajectory, config_.motion) &&
         find_doubts(space_, trajectory, config_.radius).empty();
}

std::optional<Trajectory> SmoothPath::run(std::span<const Point> path, const StartState& start) {
  if (start.is_rest() && config_.stop_and_go) {
    note(TrajectoryStep::kStopAndGo);
    result_.stops = std::max(0, static_cast<int>(path.size()) - 2);
    return stop_and_go(path);
  }
  if (path.size() == 1 && start.is_rest()) return Trajectory{};  // it stands
  if (config_.stop_and_go) return brake_first(path, start);
  const TrajectoryStep before = result_.step;
  auto found = path.size() > 1 ? smooth_or_stop(path, start) : std::nullopt;
  if (path.size() == 2 && !start.is_rest()) {
    const auto accepts = [&](const Trajectory& trajectory) { return holds(trajectory); };
    auto arrival = arrive(path[0], start, path[1], config_.motion, accepts);
    if (arrival && (!found || arrival->duration() < found->duration())) {
      found = std::move(arrival);
      result_.step = before;
      note(TrajectoryStep::kSmooth);
    }
  }
  if (!found) {
    result_.stops = 0;  // of stretches behind one that cannot be flown
    return brake_first(path, start);
  }
  return start.is_rest() || !is_slow(*found, path, start) ? found
                                                          : brake_if_quicker(*found, path, start);
}

/// A smooth trajectory along the path, or smooth ones between stops at corners.
std::optional<Trajectory> SmoothPath::smooth_or_stop(std::span<const Point> path,
                                                     const StartState& start) {
  const Trajectory halting = stop_and_go(path);
  if (start.is_rest() && path.size() == 2) return halting;  // straight is smooth
  Attempt attempt = smooth(path, start, 1.0);
  if (!attempt.holds()) {
    Attempt slower = smooth(path, start, kSlower);
    const bool is_quicker = !start.is_rest() || slower.trajectory.duration() <= halting.duration();
    if (slower.holds() && is_quicker) attempt = std::move(slower);
  }
  if (attempt.holds()) {
    if (!start.is_rest() || attempt.trajectory.duration() <= halting.duration())
      return std::move(attempt.trajectory);
    note(TrajectoryStep::kWithStops);
    result_.stops += static_cast<int>(path.size()) - 2;
    return halting;
  }
  if (path.size() == 2) return std::nullopt;
  note(TrajectoryStep::kWithStops);
  Trajectory whole;
  std::size_t first = 0;
  std::vector<std::size_t> stops = nearest_corners(path, attempt.doubts);
  result_.stops += static_cast<int>(stops.size());
  stops.push_back(path.size() - 1);
  for (const std::size_t last : stops) {
    const auto stretch =
        smooth_or_stop(path.subspan(first, last - first + 1), first == 0 ? start : StartState{});
    if (!stretch) return std::nullopt;  // the first, from a motion
    append(whole, stretch->segments);
    first = last;
  }
  return whole;
}

SplineCostConfig SmoothPath::cost_along(std::span<const Point> path, const StartState& start,
                                        double share) const {
  SplineCostConfig cost = cost_;
  const double start_speed = start.velocity.norm();
  cost.motion = limits_along(path, start_speed, config_.motion);
  cost.motion.max_speed = std::max(share * cost.motion.max_speed, start_speed);
  return cost;
}

/// Tries at a trajectory without stops, at a share of the speed that may be reached; the last of
/// them where none holds.
SmoothPath::Attempt SmoothPath::smooth(std::span<const Point> path, const StartState& start,
                                       double share) {
  const SplineCostConfig along = cost_along(path, start, share);
  const double spacing = knot_spacing(path, along.motion, config_.radius);
  SpaceSpline spline;
  Attempt attempt;
  for (const Try& t : kTries) {
    SplineCostConfig cost = along;
    cost.collision_weight *= t.push;
    if (t.anew) {
      std::vector<Point> knots = place_knots(path, t.spacing * spacing, config_.via);
      add_knots_near_rest(start.is_rest(), t.spacing * spacing, knots);
      spline = initial_spline(knots, start, cost, config_.via);
    }
    attempt = optimise(spline, cost);
    if (!attempt.holds()) continue;
    if (!start.is_rest()) quicken(path, start, cost, spline, attempt);
    note(t.step);
    break;
  }
  return attempt;
}

/// From a motion a curve that is not optimal yet may have to be stretched to several times its
/// duration to keep the limits: then it is optimised further.
void SmoothPath::quicken(std::span<const Point> path, const StartState& start,
                         const SplineCostConfig& cost, SpaceSpline& spline, Attempt& attempt) {
  for (int more = 0; more < kMostTries && is_slow(attempt.trajectory, path, start); ++more) {
    Attempt again = optimise(spline, cost);
    if (again.holds() && again.trajectory.duration() < attempt.trajectory.duration())
      attempt = std::move(again);
  }
}

/// Whether a trajectory from a motion takes far longer than speeds at the corners make likely.
bool SmoothPath::is_slow(const Trajectory& trajectory, std::span<const Point> path,
                         const StartState& start) const {
  const SplineCostConfig along = cost_along(path, start, 1.0);
  const double spacing = knot_spacing(path, along.motion, config_.radius);
  const SpaceSpline likely =
      initial_spline(place_knots(path, spacing, config_.via), start, along, config_.via);
  const double seconds = std::accumulate(likely.durations.begin(), likely.durations.end(), 0.0);
  return trajectory.duration() > kSlow * seconds;
}

SmoothPath::Attempt SmoothPath::optimise(SpaceSpline& spline, const SplineCostConfig& cost) {
  const bool from_rest = spline.fixed.front() == kAllFixed;
  Trajectory trajectory;
  {
    const Stopwatch watch(result_.seconds.optimise);
    OptimisationResult found =
        optimise_spline(std::move(spline), cost, field_, config_.most_evaluations);
    spline = std::move(found.spline);
    result_.evaluations += found.report.evaluations;
    ++result_.optimisations;
    result_.converged += found.report.converged;
    result_.cost = found.report.after;
    if (from_rest) {
      trajectory = spline.trajectory(cost.smoothness);
      scale_to_limits(trajectory, config_.motion);
    } else {
      trajectory = stretch_to_limits(cost.smoothness, spline.durations, spline.fixed,
                                     spline.derivatives, config_.motion);
    }
  }
  return verify(std::move(trajectory));
}

SmoothPath::Attempt SmoothPath::verify(Trajectory trajectory) {
  const Stopwatch watch(result_.seconds.verify);
  Attempt attempt{std::move(trajectory), {}};
  for (const double time : find_doubts(space_, attempt.trajectory, config_.radius))
    attempt.doubts.push_back(attempt.trajectory.at(time).position);
  if (!keeps_limits(attempt.trajectory, config_.motion))
    attempt.doubts.push_back(attempt.trajectory.at(0.0).position);
  return attempt;
}

}  // namespace ridgeway::detail
