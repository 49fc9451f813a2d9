// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>

#include "ridgeway/trajectory/spline_objective.hpp"

namespace ridgeway::detail {

/// Position and its derivatives where a stretch begins; at rest without velocity and acceleration.
struct StartState {
  Point velocity = Point::Zero();
  Point acceleration = Point::Zero();
  bool is_rest() const { return velocity.isZero(0.0) && acceleration.isZero(0.0); }
};

/// A spline along a path of straight segments (at least two points, no two after one another the
/// same), at rest at its goal: knots at the corners and in between, no farther apart than
/// `spacing`; corners closer than a quarter of that to a knot are passed over. Durations are those
/// of a trapezoidal speed profile that slows down at corners.
SpaceSpline initial_spline(std::span<const Point> path, const StartState& start, double spacing,
                           const SplineCostConfig& config);

}  // namespace ridgeway::detail
