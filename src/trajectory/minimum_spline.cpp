// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "minimum_spline.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
/// Derivatives at both ends of a piece; a square matrix that acts on them. No heap.
using EndRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 10, 4>;
using EndForm = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 10, 10>;

/// Both forms are worked out with more digits than they are kept with: they cancel a few.
using Precise = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// k (k - 1) ... (k - order + 1): what t^k gives when differentiated.
long double falling(int k, int order) {
  long double product = 1.0L;
  for (int i = 0; i < order; ++i) product *= k - i;
  return product;
}

/// Inverse of the map from the coefficients to the derivatives at times 0 and 1.
Precise invert_end_conditions(Smoothness smoothness) {
  const int rows = knot_size(smoothness), n = 2 * rows;
  Precise ends = Precise::Zero(n, n);
  for (int order = 0; order < rows; ++order) {
    ends(order, order) = falling(order, order);
    for (int k = order; k < n; ++k) ends(rows + order, k) = falling(k, order);
  }
  return ends.fullPivLu().inverse();
}

/// Cost of a piece of unit duration as a quadratic form of the derivatives at its ends.
EndForm make_unit_cost(Smoothness smoothness) {
  const int n = 2 * knot_size(smoothness), order = static_cast<int>(smoothness);
  Precise cost = Precise::Zero(n, n);
  for (int i = order; i < n; ++i)
    for (int k = order; k < n; ++k)
      cost(i, k) = falling(i, order) * falling(k, order) / (i + k - 2 * order + 1);
  const Precise inverse = invert_end_conditions(smoothness);
  const Precise form = inverse.transpose() * cost * inverse;
  return (0.5L * (form + form.transpose())).cast<double>();
}

const EndForm& unit_cost(Smoothness smoothness) {
  static const EndForm jerk = make_unit_cost(Smoothness::kJerk);
  static const EndForm snap = make_unit_cost(Smoothness::kSnap);
  return smoothness == Smoothness::kJerk ? jerk : snap;
}

/// Derivatives at both ends of a piece, times the powers of its duration that make it last one
/// unit. Positions from its beginning: where the world's zero is plays no part, and their digits
/// are not lost in what short pieces are far from it.
EndRows to_unit_duration(const MatrixXd& derivatives, Index first, int rows, double duration) {
  EndRows unit = derivatives.middleRows(first, 2 * static_cast<Index>(rows));
  unit.row(rows) -= unit.row(0);
  unit.row(0).setZero();
  double power = 1.0;
  for (int order = 0; order < rows; ++order, power *= duration) {
    unit.row(order) *= power;
    unit.row(rows + order) *= power;
  }
  return unit;
}

/// T^(1 - 2 m): how the cost of a piece of unit duration scales to duration T.
double cost_scale(Smoothness smoothness, double duration) {
  return std::pow(duration, 1 - 2 * static_cast<int>(smoothness));
}

}  // namespace

const EndForm& unit_coefficients(Smoothness smoothness) {
  static const EndForm jerk = invert_end_conditions(Smoothness::kJerk).cast<double>();
  static const EndForm snap = invert_end_conditions(Smoothness::kSnap).cast<double>();
  return smoothness == Smoothness::kJerk ? jerk : snap;
}

MinimumSpline::MinimumSpline(Smoothness smoothness, std::span<const double> durations,
                             std::span<const DerivativeMask> fixed)
    : smoothness_(smoothness),
      rows_(knot_size(smoothness)),
      durations_(durations.begin(), durations.end()),
      fixed_(fixed.begin(), fixed.end()) {
  if (durations_.empty() || fixed_.size() != durations_.size() + 1)
    throw InputError("spline",
                     "has " + std::to_string(fixed_.size()) + " knots for " +
                         std::to_string(durations_.size()) + " segments",
                     "give at least one segment, and a knot more than segments");
  for (std::size_t i = 0; i < durations_.size(); ++i)
    if (!(durations_[i] > 0.0 && std::isfinite(durations_[i])))
      throw InputError("spline segment " + std::to_string(i),
                       "has a duration of " + number_text(durations_[i]) + " s",
                       "give durations above 0");
  factor();
}

bool MinimumSpline::is_fixed(Index row) const {
  return (fixed_[static_cast<std::size_t>(row / rows_)] >> (row % rows_) & 1) != 0;
}

/// Block Cholesky, knot by knot: H = L L^T where L has blocks on and below its diagonal. Rows of
/// given derivatives are those of the identity.
void MinimumSpline::factor() {
  constexpr double kSmallestPivot = 1e-13;  // of the diagonal: below it the minimum is not unique
  const EndForm& unit = unit_cost(smoothness_);
  const std::size_t knots = fixed_.size();
  diagonal_.assign(knots, Block::Zero(rows_, rows_));
  below_.assign(knots - 1, Block::Zero(rows_, rows_));
  for (std::size_t s = 0; s + 1 < knots; ++s) {
    const double scale = cost_scale(smoothness_, durations_[s]);
    std::array<double, 5> power{1.0};
    for (std::size_t k = 1; k < power.size(); ++k) power[k] = power[k - 1] * durations_[s];
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < rows_; ++c) {
        const double factor =
            scale * power[static_cast<std::size_t>(r)] * power[static_cast<std::size_t>(c)];
        const bool row_free = (fixed_[s] >> r & 1) == 0, column_free = (fixed_[s] >> c & 1) == 0;
        const bool row_free_next = (fixed_[s + 1] >> r & 1) == 0;
        const bool column_free_next = (fixed_[s + 1] >> c & 1) == 0;
        if (row_free && column_free) diagonal_[s](r, c) += factor * unit(r, c);
        if (row_free_next && column_free_next)
          diagonal_[s + 1](r, c) += factor * unit(rows_ + r, rows_ + c);
        if (row_free && column_free_next) below_[s](r, c) = factor * unit(r, rows_ + c);
      }
  }
  for (std::size_t i = 0; i < knots; ++i) {
    Block& block = diagonal_[i];
    for (int r = 0; r < rows_; ++r)
      if ((fixed_[i] >> r & 1) != 0) block(r, r) = 1.0;
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 5, 1> before = block.diagonal();
    if (i > 0) block -= below_[i - 1].transpose() * below_[i - 1];
    const Eigen::LLT<Block> cholesky(block);
    const Block lower = cholesky.matrixL();
    if (cholesky.info() != Eigen::Success ||
        (lower.diagonal().array().square() < kSmallestPivot * before.array()).any())
      throw InputError("spline knot " + std::to_string(i), "leaves the spline free to move",
                       "fix positions, and derivatives at the ends, so that one minimum is left");
    block = lower;
    if (i + 1 < knots) lower.triangularView<Eigen::Lower>().solveInPlace(below_[i]);
  }
}

void MinimumSpline::solve_factored(MatrixXd& right_side) const {
  const auto rows = [&](std::size_t knot) {
    return right_side.middleRows(static_cast<Index>(knot) * rows_, rows_);
  };
  for (std::size_t i = 0; i < fixed_.size(); ++i) {
    if (i > 0) rows(i) -= below_[i - 1].transpose() * rows(i - 1);
    auto part = rows(i);
    diagonal_[i].triangularView<Eigen::Lower>().solveInPlace(part);
  }
  for (std::size_t i = fixed_.size(); i-- > 0;) {
    if (i + 1 < fixed_.size()) rows(i) -= below_[i] * rows(i + 1);
    auto part = rows(i);
    diagonal_[i].transpose().triangularView<Eigen::Upper>().solveInPlace(part);
  }
}

MatrixXd MinimumSpline::times_hessian(const MatrixXd& derivatives) const {
  const EndForm& unit = unit_cost(smoothness_);
  MatrixXd product = MatrixXd::Zero(derivatives.rows(), derivatives.cols());
  for (std::size_t s = 0; s < durations_.size(); ++s) {
    const Index first = static_cast<Index>(s) * rows_;
    const double T = durations_[s];
    const EndRows part = unit * to_unit_duration(derivatives, first, rows_, T);
    double factor = cost_scale(smoothness_, T);
    for (int order = 0; order < rows_; ++order, factor *= T) {
      product.row(first + order) += factor * part.row(order);
      product.row(first + rows_ + order) += factor * part.row(rows_ + order);
    }
  }
  return product;
}

void MinimumSpline::solve(MatrixXd& derivatives) const {
  for (Index row = 0; row < derivatives.rows(); ++row)
    if (!is_fixed(row)) derivatives.row(row).setZero();
  MatrixXd unknown = -times_hessian(derivatives);
  for (Index row = 0; row < unknown.rows(); ++row)
    if (is_fixed(row)) unknown.row(row).setZero();
  solve_factored(unknown);
  derivatives += unknown;
}

double MinimumSpline::cost(const MatrixXd& derivatives) const {
  double sum = 0.0;
  for (std::size_t s = 0; s < durations_.size(); ++s) {
    const EndRows d =
        to_unit_duration(derivatives, static_cast<Index>(s) * rows_, rows_, durations_[s]);
    sum +=
        cost_scale(smoothness_, durations_[s]) * d.cwiseProduct(unit_cost(smoothness_) * d).sum();
  }
  return sum;
}

void MinimumSpline::add_cost_gradient(const MatrixXd& derivatives, double weight,
                                      MatrixXd& by_derivatives,
                                      std::span<double> by_durations) const {
  const MatrixXd product = times_hessian(derivatives);
  by_derivatives += 2.0 * weight * product;
  // d/dT of T^(1 - 2m + j + k), entry by entry.
  for (std::size_t s = 0; s < durations_.size(); ++s) {
    const double T = durations_[s];
    const EndRows d = to_unit_duration(derivatives, static_cast<Index>(s) * rows_, rows_, T);
    const EndRows q = unit_cost(smoothness_) * d;
    double sum = 0.0;
    for (Index row = 0; row < d.rows(); ++row)
      sum += (1.0 - 2.0 * static_cast<int>(smoothness_) + 2.0 * static_cast<double>(row % rows_)) *
             d.row(row).dot(q.row(row));
    by_durations[s] += weight * cost_scale(smoothness_, T) / T * sum;
  }
}

void MinimumSpline::pull_back(const MatrixXd& derivatives, MatrixXd& by_derivatives,
                              std::span<double> by_durations) const {
  // With multipliers L of the free rows: H_ff L = gradient_f; the given rows then lose H_cf L, and
  // each duration L^T (dH/dT d)_f.
  MatrixXd multipliers = by_derivatives;
  for (Index row = 0; row < multipliers.rows(); ++row)
    if (is_fixed(row)) multipliers.row(row).setZero();
  solve_factored(multipliers);
  by_derivatives -= times_hessian(multipliers);
  for (Index row = 0; row < by_derivatives.rows(); ++row)
    if (!is_fixed(row)) by_derivatives.row(row).setZero();
  const EndForm& unit = unit_cost(smoothness_);
  for (std::size_t s = 0; s < durations_.size(); ++s) {
    const Index first = static_cast<Index>(s) * rows_;
    const double T = durations_[s];
    const EndRows d = to_unit_duration(derivatives, first, rows_, T);
    const EndRows l = to_unit_duration(multipliers, first, rows_, T);
    double sum = 0.0;
    const EndRows qd = unit * d, ql = unit * l;
    for (Index row = 0; row < d.rows(); ++row) {
      const auto order = static_cast<double>(row % rows_);
      sum += (1.0 - 2.0 * static_cast<int>(smoothness_) + order) * l.row(row).dot(qd.row(row)) +
             order * d.row(row).dot(ql.row(row));
    }
    by_durations[s] -= cost_scale(smoothness_, T) / T * sum;
  }
}

Trajectory make_trajectory(Smoothness smoothness, std::span<const double> durations,
                           const MatrixXd& derivatives) {
  const int rows = knot_size(smoothness);
  Trajectory trajectory;
  for (std::size_t s = 0; s < durations.size(); ++s) {
    const EndRows unit =
        unit_coefficients(smoothness) *
        to_unit_duration(derivatives, static_cast<Index>(s) * rows, rows, durations[s]);
    TrajectorySegment segment;
    segment.duration = durations[s];
    double power = 1.0;
    for (Index k = 0; k < unit.rows(); ++k, power *= durations[s])
      for (Index d = 0; d < unit.cols(); ++d) segment.coefficients(d, k) = unit(k, d) / power;
    segment.coefficients.col(0).head(unit.cols()) =
        derivatives.row(static_cast<Index>(s) * rows).transpose();
    trajectory.segments.push_back(segment);
  }
  return trajectory;
}

}  // namespace ridgeway
