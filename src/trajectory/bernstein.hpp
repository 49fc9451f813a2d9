// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// Points whose Bernstein polynomials make up a polynomial curve on [0, 1]: it lies in their convex
/// hull, starts at the first and ends at the last. A column each.
using BezierPoints = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 10>;

/// Of a derivative of the outputs [first, first + count) of a piece.
BezierPoints bezier_points(const TrajectorySegment& segment, int derivative, int first, int count);

/// Cuts a curve at its middle by de Casteljau's corners.
template <typename Points>
void halve(const Points& whole, Points& left, Points& right) {
  left = right = whole;
  const Eigen::Index n = whole.cols();
  for (Eigen::Index level = 1; level < n; ++level) {
    for (Eigen::Index i = 0; i + level < n; ++i)
      right.col(i) = 0.5 * (right.col(i) + right.col(i + 1));
    left.col(level) = right.col(0);
  }
}

/// Upper bound of the largest norm of a curve, at most a share of 1e-6 (1e-9 near zero) above it.
double largest_norm(const BezierPoints& curve);

}  // namespace ridgeway::detail
