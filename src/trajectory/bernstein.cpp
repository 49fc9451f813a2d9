// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bernstein.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeway::detail {
namespace {

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

using Squares = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 19>;

/// Bernstein coefficients of the squared norm: the product of two such forms has such a form.
Squares squared_norm(const BezierPoints& curve) {
  const int n = static_cast<int>(curve.cols()) - 1;
  Squares squares = Squares::Zero(2 * n + 1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      squares(i + j) += binomial(n, i) * binomial(n, j) * curve.col(i).dot(curve.col(j));
  for (int k = 0; k <= 2 * n; ++k) squares(k) /= binomial(2 * n, k);
  return squares;
}

}  // namespace

BezierPoints bezier_points(const TrajectorySegment& segment, int derivative, int first, int count) {
  const int n = kCoefficients - 1 - derivative;
  // Power form on [0, 1], then t^k = sum over i >= k of C(i, k) / C(n, k) times the i-th Bernstein
  // polynomial: sums of few terms, no inverse.
  BezierPoints power(count, n + 1);
  double scale = 1.0;
  for (int k = 0; k <= n; ++k, scale *= segment.duration) {
    double factor = scale;
    for (int i = 0; i < derivative; ++i) factor *= k + derivative - i;
    power.col(k) = factor * segment.coefficients.col(k + derivative).segment(first, count);
  }
  BezierPoints points = BezierPoints::Zero(count, n + 1);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= i; ++k) points.col(i) += binomial(i, k) / binomial(n, k) * power.col(k);
  return points;
}

double largest_norm(const BezierPoints& curve) {
  if (!curve.allFinite()) return std::numeric_limits<double>::infinity();
  constexpr double kShare = 2e-6;  // of squares
  constexpr double kLeast = 1e-18;
  constexpr int kDeepest = 40;
  struct Part {
    Squares squares;
    int depth;
  };
  std::vector<Part> parts{{squared_norm(curve), 0}};
  double reached = std::max(parts[0].squares(0), parts[0].squares(parts[0].squares.size() - 1));
  double bound = reached;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const double high = part.squares.maxCoeff();
    if (high <= reached * (1.0 + kShare) + kLeast || part.depth == kDeepest) {
      bound = std::max(bound, high);
      continue;
    }
    Part left{{}, part.depth + 1}, right{{}, part.depth + 1};
    halve(part.squares, left.squares, right.squares);
    reached = std::max(reached, right.squares(0));
    const bool left_first = left.squares.maxCoeff() > right.squares.maxCoeff();
    parts.push_back(left_first ? right : left);  // the higher one is on top: it raises `reached`
    parts.push_back(left_first ? left : right);
  }
  return std::sqrt(bound);
}

}  // namespace ridgeway::detail

namespace ridgeway {

MotionPeaks find_peaks(const TrajectorySegment& segment) {
  const auto peak = [&](int derivative, int first, int count) {
    return detail::largest_norm(detail::bezier_points(segment, derivative, first, count));
  };
  return {peak(1, 0, 3), peak(2, 0, 3), peak(3, 0, 3), peak(1, 3, 1)};
}

MotionPeaks find_peaks(const Trajectory& trajectory) {
  MotionPeaks peaks;
  for (const TrajectorySegment& segment : trajectory.segments) {
    const MotionPeaks own = find_peaks(segment);
    peaks.speed = std::max(peaks.speed, own.speed);
    peaks.acceleration = std::max(peaks.acceleration, own.acceleration);
    peaks.jerk = std::max(peaks.jerk, own.jerk);
    peaks.yaw_rate = std::max(peaks.yaw_rate, own.yaw_rate);
  }
  return peaks;
}

}  // namespace ridgeway
