// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bernstein.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ridgeway::detail {
namespace {

constexpr int kHighest = 2 * (kCoefficients - 1);  // degree of a square

using Triangle = std::array<std::array<double, kHighest + 1>, kHighest + 1>;

constexpr Triangle pascals_triangle() {
  Triangle triangle{};
  for (std::size_t n = 0; n < triangle.size(); ++n) {
    triangle[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k)
      triangle[n][k] = triangle[n - 1][k - 1] + (k < n ? triangle[n - 1][k] : 0.0);
  }
  return triangle;
}

constexpr Triangle kBinomials = pascals_triangle();

double binomial(int n, int k) {
  return kBinomials[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)];
}

using Squares = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 19>;

/// Bernstein coefficients of the squared norm: the product of two such forms has such a form.
Squares squared_norm(const BezierPoints& curve) {
  const int n = static_cast<int>(curve.cols()) - 1;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 10, 10> products(n + 1, n + 1);
  for (int i = 0; i <= n; ++i)
    for (int j = i; j <= n; ++j) products(i, j) = products(j, i) = curve.col(i).dot(curve.col(j));
  Squares squares = Squares::Zero(2 * n + 1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) squares(i + j) += binomial(n, i) * binomial(n, j) * products(i, j);
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
    explicit Part(int deep) : depth(deep) {}
    Squares squares;
    double high = 0.0;  // the largest of them
    int depth;
  };
  std::vector<Part> parts(1, Part(0));
  parts.reserve(kDeepest + 1);
  parts[0].squares = squared_norm(curve);
  parts[0].high = parts[0].squares.maxCoeff();
  double reached = std::max(parts[0].squares(0), parts[0].squares(parts[0].squares.size() - 1));
  double bound = reached;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.high <= reached * (1.0 + kShare) + kLeast || part.depth == kDeepest) {
      bound = std::max(bound, part.high);
      continue;
    }
    Part left(part.depth + 1), right(part.depth + 1);
    halve(part.squares, left.squares, right.squares);
    left.high = left.squares.maxCoeff();
    right.high = right.squares.maxCoeff();
    reached = std::max(reached, right.squares(0));
    const bool left_first = left.high > right.high;
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
