// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "smooth_path.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "ridgeway/trajectory/verify_trajectory.hpp"
#include "straight_motion.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kPushHarder = 10.0;       // times the collision weight
constexpr double kSpacingOfStop = 0.75;    // times v^2 / a: knots' distance along the path
constexpr double kWithin = 1.0 + 1e-5;     // slower by this, so that certified peaks hold limits
constexpr double kSlowerEachTry = 1.15;

class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

/// Interpolated distances; where a voxel is so far from everything that nobody asks for more, its
/// own, without a gradient.
DistanceField field_of(const EsdfMap& esdf, double enough) {
  return [&esdf, enough](const Point& p) -> DistanceAndGradient {
    const VoxelId id = esdf.layout.find(voxel_at(p, esdf.voxel_size));
    if (id != kNoVoxel && !esdf.is_obstacle(id)) {
      const double d = esdf.distance(id);
      if (d > enough + 2.0 * esdf.voxel_size) return {d, Point::Zero()};
    }
    return interpolate_distance(esdf, p);
  };
}

/// How many times slower a trajectory must be flown to keep the limits; less than 1: it could be
/// faster.
double slowdown(const MotionPeaks& peaks, const MotionLimits& limits) {
  return std::max({peaks.speed / limits.max_speed,
                   std::sqrt(peaks.acceleration / limits.max_acceleration),
                   std::cbrt(peaks.jerk / limits.max_jerk)});
}

void slow_down(Trajectory& trajectory, double factor) {
  for (TrajectorySegment& segment : trajectory.segments) {
    segment.duration *= factor;
    double power = 1.0;
    for (int k = 0; k < kCoefficients; ++k, power *= factor) segment.coefficients.col(k) /= power;
  }
}

void append(Trajectory& to, const Trajectory& from) {
  to.segments.insert(to.segments.end(), from.segments.begin(), from.segments.end());
}

/// The corner, neither first nor last, nearest to a place.
std::size_t nearest_corner(std::span<const Point> path, const Point& place) {
  std::size_t best = 1;
  for (std::size_t i = 2; i + 1 < path.size(); ++i)
    if ((path[i] - place).squaredNorm() < (path[best] - place).squaredNorm()) best = i;
  return best;
}

}  // namespace

SmoothPath::SmoothPath(const EsdfMap& esdf, const TrajectoryConfig& config,
                       TrajectoryResult& result)
    : esdf_(esdf), space_(esdf), config_(config), result_(result) {
  cost_.smoothness = config.smoothness;
  cost_.limits = config.limits;
  cost_.radius = config.radius;
  cost_.margin = std::max(2.0 * esdf.voxel_size, config.radius / 3.0);
  field_ = field_of(esdf, cost_.radius + cost_.margin);
}

void SmoothPath::note(TrajectoryStep step) { result_.step = std::max(result_.step, step); }

Trajectory SmoothPath::stop_and_go(std::span<const Point> path) const {
  Trajectory trajectory;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto straight = straight_motion(path[i - 1], path[i], config_.limits);
    trajectory.segments.insert(trajectory.segments.end(), straight.begin(), straight.end());
  }
  return trajectory;
}

SmoothPath::Attempt SmoothPath::verify(Trajectory trajectory, bool from_rest) {
  const Stopwatch watch(result_.seconds.verify);
  Attempt attempt;
  attempt.trajectory = std::move(trajectory);
  if (from_rest)
    slow_down(attempt.trajectory,
              slowdown(find_peaks(attempt.trajectory), config_.limits) * kWithin);
  attempt.within_limits = config_.limits.hold(find_peaks(attempt.trajectory));
  if (const auto time = first_doubt(space_, esdf_, attempt.trajectory, config_.radius))
    attempt.doubt = attempt.trajectory.at(*time).position;
  return attempt;
}

SmoothPath::Attempt SmoothPath::optimise(SpaceSpline& spline, const SplineCostConfig& cost) {
  const bool from_rest = spline.fixed.front() == kAllFixed;
  {
    const Stopwatch watch(result_.seconds.optimise);
    OptimisationResult found =
        optimise_spline(std::move(spline), cost, field_, config_.most_evaluations);
    spline = std::move(found.spline);
    result_.evaluations += found.report.evaluations;
    ++result_.optimisations;
    result_.converged += found.report.converged;
    result_.cost = found.report.after;
  }
  return verify(spline.trajectory(cost.smoothness), from_rest);
}

/// One trajectory without stops along the path, or nothing.
std::optional<Trajectory> SmoothPath::smooth(std::span<const Point> path,
                                             const StartState& start) {
  const MotionLimits& limits = config_.limits;
  const double stop = limits.max_speed * limits.max_speed / limits.max_acceleration;
  const double spacing = std::max(kSpacingOfStop * stop, 2.0 * config_.radius);
  SplineCostConfig cost = cost_;
  SpaceSpline spline = initial_spline(path, start, spacing, cost);
  Attempt attempt = optimise(spline, cost);
  if (attempt.holds()) return attempt.trajectory;
  cost.collision_weight *= kPushHarder;
  attempt = optimise(spline, cost);
  if (attempt.holds()) {
    note(TrajectoryStep::kPushed);
    return attempt.trajectory;
  }
  spline = initial_spline(path, start, 0.5 * spacing, cost);
  attempt = optimise(spline, cost);
  if (attempt.holds()) {
    note(TrajectoryStep::kInserted);
    return attempt.trajectory;
  }
  return std::nullopt;
}

std::optional<Trajectory> SmoothPath::smooth_or_stop(std::span<const Point> path,
                                                     const StartState& start) {
  if (path.size() < 2) return Trajectory{};
  const Trajectory halting = stop_and_go(path);
  if (start.is_rest() && path.size() == 2) return halting;
  if (auto found = smooth(path, start)) {
    if (start.is_rest() && found->duration() > halting.duration()) return halting;
    return found;
  }
  if (path.size() == 2) return std::nullopt;
  const std::size_t corner = path.size() / 2;
  note(TrajectoryStep::kWithStops);
  ++result_.stops;
  auto before = smooth_or_stop(path.first(corner + 1), start);
  if (!before) return std::nullopt;
  append(*before, *smooth_or_stop(path.subspan(corner), {}));
  return before;
}

bool SmoothPath::run(const std::vector<Point>& path, const StartState& start) {
  const Trajectory halting = stop_and_go(path);
  result_.stop_and_go_duration = halting.duration();
  if (auto found = smooth_or_stop(path, start)) {
    result_.trajectory = std::move(*found);
    return true;
  }
  return false;
}

}  // namespace ridgeway::detail
