// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>
#include <vector>

#include "spline_objective.hpp"

namespace ridgeway::detail {

/// Position and its derivatives where a stretch begins; at rest without velocity and acceleration.
struct StartState {
  Point velocity = Point::Zero();
  Point acceleration = Point::Zero();
  bool is_rest() const { return velocity.isZero(0.0) && acceleration.isZero(0.0); }
};

/// The limits with no more speed than is reached along a path of straight segments (at least two
/// points, no two after one another the same) that is slowed down for at its corners: how far apart
/// knots are to be, and what is fast, follows from that.
MotionLimits limits_along(std::span<const Point> path, double start_speed,
                          const MotionLimits& limits);

/// Knots along a path of straight segments (at least two points, no two after one another the
/// same): at its ends, its corners and in between, no farther apart than `spacing`. Corners closer
/// than a quarter of that to a knot are passed over, but for those among `kept`.
std::vector<Point> place_knots(std::span<const Point> path, double spacing,
                               std::span<const Point> kept);

/// One more close to the goal, and to a start at rest. There all derivatives are 0, so that on a
/// long piece the robot can but creep; on a short one its acceleration rises at once.
void add_knots_near_rest(bool starts_at_rest, double spacing, std::vector<Point>& knots);

/// A spline through knots (at least two, no two after one another the same), at rest at the last.
/// Durations are those of a trapezoidal speed profile that slows down at corners. Knots among
/// `kept`, and both ends, are not to move.
SpaceSpline initial_spline(const std::vector<Point>& knots, const StartState& start,
                           const SplineCostConfig& config, std::span<const Point> kept);

}  // namespace ridgeway::detail
