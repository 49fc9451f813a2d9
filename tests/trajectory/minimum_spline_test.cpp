// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "trajectory/minimum_spline.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kBoth{Smoothness::kJerk, Smoothness::kSnap};

/// A spline problem with one output.
struct Problem {
  Smoothness smoothness = Smoothness::kSnap;
  std::vector<double> durations;
  std::vector<DerivativeMask> fixed;
  MatrixXd derivatives;  ///< given where fixed

  bool is_fixed(int knot, int order) const {
    return (fixed[static_cast<std::size_t>(knot)] >> order & 1) != 0;
  }
  MatrixXd solved() const {
    MatrixXd result = derivatives;
    MinimumSpline(smoothness, durations, fixed).solve(result);
    return result;
  }
};

/// Derivatives of 1, t, t^2, ... at a time.
VectorXd monomials(int count, int order, double t) {
  VectorXd row = VectorXd::Zero(count);
  for (int k = order; k < count; ++k) {
    double factor = std::pow(t, k - order);
    for (int j = 0; j < order; ++j) factor *= k - j;
    row(k) = factor;
  }
  return row;
}

/// Minimum of the integral over all coefficients subject to the given derivatives and continuity,
/// by the dense Karush-Kuhn-Tucker system, in more digits than ours; derivatives at the knots.
MatrixXd solve_densely(const Problem& p) {
  const int rows = knot_size(p.smoothness), n = 2 * rows, m = static_cast<int>(p.smoothness);
  const int segments = static_cast<int>(p.durations.size()), unknowns = n * segments;
  MatrixXd cost = MatrixXd::Zero(unknowns, unknowns);
  std::vector<VectorXd> constraints;
  std::vector<double> values;
  const auto at = [&](int segment, int order, double t) {
    VectorXd row = VectorXd::Zero(unknowns);
    row.segment(segment * n, n) = monomials(n, order, t);
    return row;
  };
  for (int s = 0; s < segments; ++s) {
    const double T = p.durations[static_cast<std::size_t>(s)];
    for (int i = m; i < n; ++i)
      for (int k = m; k < n; ++k) {
        double factor = 2.0 * std::pow(T, i + k - 2 * m + 1) / (i + k - 2 * m + 1);
        for (int j = 0; j < m; ++j) factor *= (i - j) * (k - j);
        cost(s * n + i, s * n + k) = factor;
      }
    for (int order = 0; order < rows; ++order) {
      if (p.is_fixed(s, order)) {
        constraints.push_back(at(s, order, 0.0));
        values.push_back(p.derivatives(s * rows + order, 0));
      }
      if (s > 0) {
        const double before = p.durations[static_cast<std::size_t>(s - 1)];
        constraints.emplace_back(at(s - 1, order, before) - at(s, order, 0.0));
        values.push_back(0.0);
      }
      if (s + 1 == segments && p.is_fixed(s + 1, order)) {
        constraints.push_back(at(s, order, T));
        values.push_back(p.derivatives((s + 1) * rows + order, 0));
      }
    }
  }
  const auto count = static_cast<Index>(constraints.size());
  MatrixXd system = MatrixXd::Zero(unknowns + count, unknowns + count);
  VectorXd right = VectorXd::Zero(unknowns + count);
  system.topLeftCorner(unknowns, unknowns) = cost;
  for (Index i = 0; i < count; ++i) {
    system.row(unknowns + i).head(unknowns) = constraints[static_cast<std::size_t>(i)].transpose();
    system.col(unknowns + i).head(unknowns) = constraints[static_cast<std::size_t>(i)];
    right(unknowns + i) = values[static_cast<std::size_t>(i)];
  }
  using Precise = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Precise precise = system.cast<long double>(), wanted = right.cast<long double>();
  const VectorXd solution = precise.partialPivLu().solve(wanted).cast<double>();
  MatrixXd derivatives((segments + 1) * rows, 1);
  for (int knot = 0; knot <= segments; ++knot)
    for (int order = 0; order < rows; ++order) {
      const int s = std::min(knot, segments - 1);
      const double t = knot == segments ? p.durations.back() : 0.0;
      derivatives(knot * rows + order, 0) =
          at(s, order, t).head(unknowns).dot(solution.head(unknowns));
    }
  return derivatives;
}

Problem random_problem(unsigned seed, Smoothness smoothness) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-2.0, 2.0), duration(0.5, 2.0), coin(0.0, 1.0);
  Problem p;
  p.smoothness = smoothness;
  const int rows = knot_size(smoothness), segments = 1 + static_cast<int>(random() % 5);
  for (int s = 0; s < segments; ++s) p.durations.push_back(duration(random));
  for (int knot = 0; knot <= segments; ++knot) {
    const bool is_end = knot == 0 || knot == segments;
    DerivativeMask mask = 0;
    for (int order = 0; order < rows; ++order)
      if (coin(random) < (is_end ? (order < rows - 1 ? 1.0 : 0.5) : order == 0 ? 0.8 : 0.2))
        mask |= static_cast<DerivativeMask>(1 << order);
    p.fixed.push_back(mask);
  }
  p.derivatives = MatrixXd::Zero((segments + 1) * rows, 1);
  for (Index row = 0; row < p.derivatives.rows(); ++row) p.derivatives(row, 0) = value(random);
  return p;
}

TEST(MinimumSpline, EqualsADenseQuadraticProgramme) {
  for (const Smoothness smoothness : kBoth)
    for (unsigned seed = 0; seed < 100; ++seed) {
      SCOPED_TRACE(seed);
      const Problem p = random_problem(seed, smoothness);
      const MatrixXd ours = p.solved(), theirs = solve_densely(p);
      ASSERT_LE((ours - theirs).cwiseAbs().maxCoeff(),
                1e-8 * std::max(1.0, theirs.cwiseAbs().maxCoeff()));
    }
}

TEST(MinimumSpline, FromRestToRestIsTheTextbooksPolynomial) {
  const std::array<std::vector<double>, 2> textbook = {
      std::vector<double>{0, 0, 0, 10, -15, 6},            // least jerk
      std::vector<double>{0, 0, 0, 0, 35, -84, 70, -20}};  // least snap
  for (const Smoothness smoothness : kBoth) {
    const int rows = knot_size(smoothness);
    // At rest up to the derivative below the one that is minimised, which is free.
    const auto rest = static_cast<DerivativeMask>((1 << (rows - 1)) - 1);
    Problem p{smoothness, {2.0}, {rest, rest}, MatrixXd::Zero(2 * rows, 1)};
    p.derivatives(rows, 0) = 3.0;
    const Trajectory t = make_trajectory(smoothness, p.durations, p.solved());
    const std::vector<double>& expected = textbook[smoothness == Smoothness::kSnap ? 1 : 0];
    for (int k = 0; k < kCoefficients; ++k) {
      const auto place = static_cast<std::size_t>(k);
      const double unit = place < expected.size() ? expected[place] : 0.0;
      EXPECT_NEAR(t.segments[0].coefficients(0, k) * std::pow(2.0, k), 3.0 * unit, 1e-9) << k;
    }
  }
}

TEST(MinimumSpline, JoinsWithFourContinuousDerivatives) {
  for (const Smoothness smoothness : kBoth)
    for (unsigned seed = 0; seed < 30; ++seed) {
      const Problem p = random_problem(seed, smoothness);
      const Trajectory t = make_trajectory(smoothness, p.durations, p.solved());
      EXPECT_EQ(t.segments.size(), p.durations.size());
      for (std::size_t s = 1; s < t.segments.size(); ++s)
        for (int order = 0; order < knot_size(smoothness); ++order) {
          const Eigen::Vector4d before =
              t.segments[s - 1].derivative(order, t.segments[s - 1].duration);
          const Eigen::Vector4d after = t.segments[s].derivative(order, 0.0);
          ASSERT_LE((before - after).norm(), 1e-8 * std::max(1.0, after.norm())) << order;
        }
    }
}

TEST(MinimumSpline, ShortPiecesFarFromZeroJoinWithoutJumps) {
  constexpr double kFar = 1e4, kShort = 1e-3;  // metres, seconds
  const std::vector<double> durations{1.0, kShort, 1.0};
  const std::vector<DerivativeMask> fixed{kAllFixed, kPositionFixed, kPositionFixed, kAllFixed};
  for (const Smoothness smoothness : kBoth) {
    const int rows = knot_size(smoothness);
    Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(4 * rows, 3);
    const std::array<double, 4> along{0.0, 0.5, 0.5 + kShort, 1.0};
    for (int knot = 0; knot < 4; ++knot)
      derivatives.row(knot * rows).setConstant(kFar + along[static_cast<std::size_t>(knot)]);
    MinimumSpline(smoothness, durations, fixed).solve(derivatives);
    const Trajectory t = make_trajectory(smoothness, durations, derivatives);
    for (std::size_t s = 1; s < 3; ++s)
      for (int order = 0; order < 3; ++order) {
        const double jump = (t.segments[s - 1].derivative(order, durations[s - 1]) -
                             t.segments[s].derivative(order, 0.0))
                                .norm();
        EXPECT_LE(jump, 1e-11 * std::max(kFar, std::pow(kShort, -order))) << s << " " << order;
      }
  }
}

TEST(MinimumSpline, ThousandSegmentsStayAccurate) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-5.0, 5.0), exponent(-3.0, 3.0);
  for (const Smoothness smoothness : kBoth) {
    const int rows = knot_size(smoothness);
    Problem p;
    p.smoothness = smoothness;
    for (int s = 0; s < 1000; ++s) p.durations.push_back(std::pow(2.0, exponent(random)));
    p.fixed.assign(1001, kPositionFixed);
    p.fixed.front() = p.fixed.back() = kAllFixed;
    p.derivatives = MatrixXd::Zero(1001 * static_cast<Index>(rows), 3);
    for (Index knot = 0; knot <= 1000; ++knot)
      for (Index axis = 0; axis < 3; ++axis) p.derivatives(knot * rows, axis) = value(random);
    const MinimumSpline spline(smoothness, p.durations, p.fixed);
    MatrixXd solved = p.derivatives;
    spline.solve(solved);
    // At the minimum the cost does not change to first order, whatever free derivative moves. Seen
    // beside what its terms amount to.
    MatrixXd gradient = MatrixXd::Zero(solved.rows(), 3);
    std::vector<double> by_durations(1000, 0.0);
    spline.add_cost_gradient(solved, 1.0, gradient, by_durations);
    for (Index row = rows; row < solved.rows() - rows; ++row) {
      if (row % rows == 0) continue;
      const auto knot = static_cast<std::size_t>(row / rows);
      const double T = std::min(p.durations[knot - 1], p.durations[knot]);
      const double size = std::pow(T, 1 - 2 * static_cast<int>(smoothness) + row % rows) * 1e4;
      ASSERT_LE(gradient.row(row).norm(), 1e-8 * size) << row;
    }
  }
}

TEST(MinimumSpline, PullsGradientsBackThroughTheSolution) {
  // Of any function of all derivatives and durations: here a random linear one plus the cost.
  for (const Smoothness smoothness : kBoth)
    for (unsigned seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(seed);
      const Problem p = random_problem(seed, smoothness);
      std::mt19937 random(seed + 1000);
      std::uniform_real_distribution<double> value(-1.0, 1.0);
      const MatrixXd slope =
          MatrixXd::NullaryExpr(p.derivatives.rows(), 1, [&] { return value(random); });
      const auto cost = [&](const Problem& at) {
        const MatrixXd d = at.solved();
        return slope.cwiseProduct(d).sum() +
               0.1 * MinimumSpline(smoothness, at.durations, at.fixed).cost(d);
      };
      const MinimumSpline spline(smoothness, p.durations, p.fixed);
      const MatrixXd solved = p.solved();
      MatrixXd gradient = slope;
      std::vector<double> by_durations(p.durations.size(), 0.0);
      spline.add_cost_gradient(solved, 0.1, gradient, by_durations);
      spline.pull_back(solved, gradient, by_durations);
      double largest = gradient.cwiseAbs().maxCoeff();
      for (const double g : by_durations) largest = std::max(largest, std::abs(g));
      const auto check = [&](double& variable, Problem& moved, double analytic) {
        const double step = 1e-5, here = variable;
        variable = here + step;
        const double above = cost(moved);
        variable = here - step;
        const double below = cost(moved);
        variable = here;
        const double numeric = (above - below) / (2.0 * step);
        ASSERT_NEAR(analytic, numeric, 1e-5 * largest);
      };
      Problem moved = p;
      for (Index row = 0; row < gradient.rows(); ++row) {
        const int rows = knot_size(smoothness);
        if (p.is_fixed(static_cast<int>(row / rows), static_cast<int>(row % rows)))
          check(moved.derivatives(row, 0), moved, gradient(row, 0));
        else
          ASSERT_EQ(gradient(row, 0), 0.0);
      }
      for (std::size_t s = 0; s < by_durations.size(); ++s)
        check(moved.durations[s], moved, by_durations[s]);
    }
}

TEST(MinimumSpline, RefusesWhatHasNoSingleMinimum) {
  const auto make = [](std::vector<double> durations, std::vector<DerivativeMask> fixed) {
    return MinimumSpline(Smoothness::kSnap, durations, fixed);
  };
  EXPECT_NO_THROW(make({1.0}, {15, 15}));
  EXPECT_THROW(make({1.0}, {1, 1}), InputError);  // a cubic is for nothing
  EXPECT_THROW(make({1.0, 1.0}, {1, 0, 1}), InputError);
  EXPECT_THROW(make({}, {}), InputError);
  EXPECT_THROW(make({1.0}, {15}), InputError);
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(make({1.0, bad}, {15, 1, 15}), InputError) << bad;
}

}  // namespace
}  // namespace ridgeway
