// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "initial_spline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway::detail {

/// Metres between the knots of the first try along a path, at most.
double knot_spacing(std::span<const Point> path, const MotionLimits& limits, double radius);

/// The steps from a free path to a trajectory (without yaw) that holds; reports what it took into
/// the result as it goes.
class SmoothPath {
 public:
  SmoothPath(const FreeSpace& space, const TrajectoryConfig& config, TrajectoryResult& result);

  /// Along a path that is free at the radius, no two points after one another the same. Nothing
  /// where a moving start can neither follow it nor brake.
  std::optional<Trajectory> run(std::span<const Point> path, const StartState& start);

  /// Straight from stop to stop.
  Trajectory stop_and_go(std::span<const Point> path) const;

  /// Whether a trajectory is free all along, and within the limits on speed, acceleration and jerk.
  bool holds(const Trajectory& trajectory) const;

 private:
  struct Attempt {
    Trajectory trajectory;
    std::vector<Point> doubts;  ///< where it does not hold; empty if it does
    bool holds() const { return doubts.empty(); }
  };

  std::optional<Trajectory> smooth_or_stop(std::span<const Point> path, const StartState& start);
  SplineCostConfig cost_along(std::span<const Point> path, const StartState& start,
                              double share) const;
  Attempt smooth(std::span<const Point> path, const StartState& start, double share);
  Attempt optimise(SpaceSpline& spline, const SplineCostConfig& cost);
  void quicken(std::span<const Point> path, const StartState& start, const SplineCostConfig& cost,
               SpaceSpline& spline, Attempt& attempt);
  bool is_slow(const Trajectory& trajectory, std::span<const Point> path,
               const StartState& start) const;
  Attempt verify(Trajectory trajectory);
  std::optional<Trajectory> brake_first(std::span<const Point> path, const StartState& start);
  Trajectory brake_if_quicker(const Trajectory& found, std::span<const Point> path,
                              const StartState& start);
  std::optional<Trajectory> come_to_rest(const Point& from, const StartState& start,
                                         DerivativeMask fixed_at_start) const;
  std::optional<Trajectory> brake(const Point& from, const StartState& start) const;
  void note(TrajectoryStep step);

  const FreeSpace space_;
  const TrajectoryConfig& config_;
  TrajectoryResult& result_;
  SplineCostConfig cost_;
  DistanceField field_;
};

}  // namespace ridgeway::detail
