// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// Derivatives, the position among them, that a knot holds: half the coefficients of a piece.
constexpr int knot_size(Smoothness smoothness) { return static_cast<int>(smoothness) + 1; }

/// Which derivatives of a knot are given: bit k for the k-th.
using DerivativeMask = std::uint8_t;
inline constexpr DerivativeMask kPositionFixed = 1;
inline constexpr DerivativeMask kStateFixed = 7;  ///< position, velocity, acceleration
inline constexpr DerivativeMask kAllFixed = 31;   ///< as at rest

/// The piecewise polynomial through knots that minimises the squared integral of jerk or snap over
/// all derivatives that are not given (Richter, Bry, Roy 2013; Burri et al. 2015).
///
/// Pieces are written by the derivatives at their ends, so neighbours share them and continuity
/// (four derivatives for snap, three for jerk) holds by construction. The cost is then
/// d^T H d with a block tridiagonal H, factored once in time linear in the number of segments by a
/// block Cholesky decomposition; each block comes from one for unit duration, so no power of a
/// duration is ever inverted.
///
/// Derivatives are matrices with knot_size rows a knot (position, velocity, ...) and a column for
/// each output. Thread-safe once made.
class MinimumSpline {
 public:
  /// Throws InputError unless durations are finite and above 0, there is a mask for each of their
  /// ends, and the masks leave one minimum only (a cubic for snap, or a parabola for jerk, could
  /// otherwise be added for nothing).
  MinimumSpline(Smoothness smoothness, std::span<const double> durations,
                std::span<const DerivativeMask> fixed);

  Smoothness smoothness() const { return smoothness_; }
  std::span<const double> durations() const { return durations_; }

  /// Fills in the derivatives that are not given.
  void solve(Eigen::MatrixXd& derivatives) const;

  /// The integral of the squared jerk or snap, summed over the outputs; not solved-for derivatives
  /// will do.
  double cost(const Eigen::MatrixXd& derivatives) const;

  /// Adds the gradient of `cost` by the derivatives and by the durations, each seen alone.
  void add_cost_gradient(const Eigen::MatrixXd& derivatives, double weight,
                         Eigen::MatrixXd& by_derivatives, std::span<double> by_durations) const;

  /// From the gradient of any function by all derivatives and by the durations, each seen alone, to
  /// that by the given derivatives and the durations, the others following by `solve`. Rows that
  /// are not given become 0. `derivatives` must be solved.
  void pull_back(const Eigen::MatrixXd& derivatives, Eigen::MatrixXd& by_derivatives,
                 std::span<double> by_durations) const;

 private:
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 5, 5>;

  bool is_fixed(Eigen::Index row) const;
  Eigen::MatrixXd times_hessian(const Eigen::MatrixXd& derivatives) const;
  void factor();
  void solve_factored(Eigen::MatrixXd& right_side) const;

  Smoothness smoothness_;
  int rows_;
  std::vector<double> durations_;
  std::vector<DerivativeMask> fixed_;
  std::vector<Block> diagonal_;  ///< lower Cholesky factors
  std::vector<Block> below_;     ///< L^-1 H(i, i + 1)
};

/// For unit duration: coefficients of a piece (one row each) from the derivatives at its ends,
/// those of the first before those of the second. A square matrix of 8 (jerk) or 10 (snap) rows.
const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 10, 10>& unit_coefficients(
    Smoothness smoothness);

/// The pieces that derivatives at the knots stand for; up to four columns, missing ones are 0.
Trajectory make_trajectory(Smoothness smoothness, std::span<const double> durations,
                           const Eigen::MatrixXd& derivatives);

}  // namespace ridgeway
