// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "trajectory/optimise_spline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "ridgeway/esdf/esdf.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// A ball of radius 1 m at the origin.
DistanceAndGradient ball(const Point& p) { return {p.norm() - 1.0, p.normalized()}; }

SpaceSpline random_spline(unsigned seed, Smoothness smoothness, bool from_rest) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.5, 1.5), duration(0.3, 1.5);
  const int rows = knot_size(smoothness), segments = 1 + static_cast<int>(random() % 5);
  SpaceSpline spline;
  spline.derivatives = Eigen::MatrixXd::Zero((segments + 1) * rows, 3);
  for (int knot = 0; knot <= segments; ++knot)
    for (int axis = 0; axis < 3; ++axis) spline.derivatives(knot * rows, axis) = value(random);
  for (int s = 0; s < segments; ++s) spline.durations.push_back(duration(random));
  const auto knots = static_cast<std::size_t>(segments) + 1;
  spline.fixed.assign(knots, kPositionFixed);
  spline.fixed.front() = from_rest ? kAllFixed : kStateFixed;
  spline.fixed.back() = kAllFixed;
  if (!from_rest) spline.derivatives.middleRows(1, 2).setConstant(0.5);
  spline.movable.assign(knots, true);
  spline.movable.front() = spline.movable.back() = false;
  return spline;
}

SplineCostConfig every_term(Smoothness smoothness) {
  SplineCostConfig config;
  config.smoothness = smoothness;
  config.motion.max_jerk = 5.0;
  config.radius = 0.3;
  config.margin = 0.4;
  config.smoothness_weight = 1e-3;
  return config;
}

/// Largest difference from central differences, relative to the gradient's largest entry.
double gradient_error(SplineObjective& objective, double step) {
  std::vector<double> x = objective.variables(), gradient(x.size());
  objective(x, gradient);
  double largest = 0.0, error = 0.0;
  for (const double g : gradient) largest = std::max(largest, std::abs(g));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double here = x[i];
    x[i] = here + step;
    const double above = objective(x, {});
    x[i] = here - step;
    const double below = objective(x, {});
    x[i] = here;
    error = std::max(error, std::abs(gradient[i] - (above - below) / (2.0 * step)));
  }
  return error / largest;
}

TEST(SplineObjective, GradientsEqualFiniteDifferencesInAnAnalyticWorld) {
  const DistanceField field = ball;
  for (const Smoothness smoothness : {Smoothness::kJerk, Smoothness::kSnap})
    for (unsigned seed = 0; seed < 40; ++seed) {
      SCOPED_TRACE(seed);
      SplineObjective objective(random_spline(seed, smoothness, seed % 2 == 0),
                                every_term(smoothness), field);
      EXPECT_LE(gradient_error(objective, 1e-6), 1e-5);
    }
}

TEST(SplineObjective, GradientsEqualFiniteDifferencesThroughTheEsdf) {
  int checked = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed, 30));
    const DistanceField field = [&](const Point& p) { return interpolate_distance(esdf, p, 0.3); };
    SpaceSpline spline = random_spline(seed, Smoothness::kSnap, true);
    const Point centre = centre_of(esdf.layout.index_of(0), esdf.voxel_size);
    for (Eigen::Index row = 0; row < spline.derivatives.rows(); row += 5)
      spline.derivatives.row(row) += centre.transpose();
    // The slope of the interpolation jumps from cell to cell: the step must not cross many.
    SplineObjective objective(spline, every_term(Smoothness::kSnap), field);
    std::vector<double> x = objective.variables();
    checked += objective(x, {}) > 0.0 && objective.terms().collision > 0.0;
    EXPECT_LE(gradient_error(objective, 1e-8), 1e-5);
  }
  EXPECT_GT(checked, 10);
}

TEST(SplineObjective, PotentialIsSmoothAndVanishesBeyondTheMargin) {
  const double r = 0.3, margin = 0.2, step = 1e-6;
  EXPECT_EQ(obstacle_potential(r + margin, r, margin).value, 0.0);
  EXPECT_DOUBLE_EQ(obstacle_potential(r, r, margin).value, 0.5);
  EXPECT_DOUBLE_EQ(obstacle_potential(r - margin, r, margin).value, 1.5);
  for (double d = -1.0; d < 1.0; d += 0.0137) {
    const double numeric = (obstacle_potential(d + step, r, margin).value -
                            obstacle_potential(d - step, r, margin).value) /
                           (2.0 * step);
    EXPECT_NEAR(obstacle_potential(d, r, margin).slope, numeric, 1e-4);
  }
}

/// Straight through the ball.
SpaceSpline through_the_ball() {
  SpaceSpline spline;
  const int segments = 6;
  spline.derivatives = Eigen::MatrixXd::Zero((segments + 1) * 5, 3);
  for (int knot = 0; knot <= segments; ++knot)
    spline.derivatives.row(knot * 5) << -3.0 + knot, 0.05, 0.02;
  spline.durations.assign(segments, 1.0);
  spline.fixed.assign(segments + 1, kPositionFixed);
  spline.fixed.front() = spline.fixed.back() = kAllFixed;
  spline.movable.assign(segments + 1, true);
  spline.movable.front() = spline.movable.back() = false;
  return spline;
}

TEST(OptimiseSpline, PushesOutOfCollisionKeepsLimitsAndSaysWhatItCost) {
  SplineCostConfig config;
  config.radius = 0.3;
  config.collision_weight = 100.0;
  const OptimisationResult result = optimise_spline(through_the_ball(), config, ball, 300);
  EXPECT_TRUE(result.report.converged);
  EXPECT_LT(result.report.after.total(), result.report.before.total());
  EXPECT_GT(result.report.before.collision, 100.0);
  EXPECT_LT(result.report.after.collision, 10.0);
  const Trajectory trajectory = result.spline.trajectory(config.smoothness);
  for (const TrajectoryState& state : trajectory.sample(0.01))
    EXPECT_GE(ball(state.position).distance, config.radius);
  EXPECT_LE(find_peaks(trajectory).speed, 1.02 * config.motion.max_speed);
  EXPECT_LE(find_peaks(trajectory).acceleration, 1.05 * config.motion.max_acceleration);
  // Ends stay; the way round is hardly longer than the tangents' and the arc's.
  EXPECT_LE((trajectory.at(0.0).position - Point(-3, 0.05, 0.02)).norm(), 1e-9);
  EXPECT_LE((trajectory.at(1e9).position - Point(3, 0.05, 0.02)).norm(), 1e-6);
  EXPECT_LT(trajectory.duration(), 5.5);
}

TEST(OptimiseSpline, RespectsTheNumberOfEvaluationsAndRepeats) {
  SplineCostConfig config;
  config.radius = 0.3;
  const auto run = [&](int most) {
    return optimise_spline(through_the_ball(), config, ball, most);
  };
  const OptimisationResult few = run(5);
  EXPECT_FALSE(few.report.converged);
  EXPECT_LE(few.report.evaluations, 6);
  EXPECT_LE(few.report.after.total(), few.report.before.total());
  EXPECT_EQ(run(50).spline.durations, run(50).spline.durations);
}

TEST(OptimiseSpline, ExceptionsOfTheFieldReachTheCaller) {
  const DistanceField bad = [](const Point&) -> DistanceAndGradient {
    throw std::runtime_error("no map");
  };
  EXPECT_THROW(optimise_spline(through_the_ball(), {}, bad, 10), std::runtime_error);
}

}  // namespace
}  // namespace ridgeway
