// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "minimum_spline.hpp"
#include "ridgeway/esdf/distance_field.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// Distance to the nearest obstacle, metres, and its gradient, at a point. Continuous; where it is
/// larger than anybody asks for, any large value with a gradient of 0 will do. Called from one
/// thread at a time for each optimisation.
using DistanceField = std::function<DistanceAndGradient(const Point&)>;

/// A spline in space to be optimised: the positions of movable knots and all durations may change;
/// the derivatives that are not fixed follow as the smoothest (MinimumSpline).
struct SpaceSpline {
  std::vector<double> durations;      ///< seconds, one a segment
  std::vector<DerivativeMask> fixed;  ///< one a knot; the position is fixed everywhere
  std::vector<bool> movable;          ///< one a knot
  Eigen::MatrixXd derivatives;        ///< knot_size rows a knot; columns x, y, z

  Trajectory trajectory(Smoothness smoothness) const {
    return make_trajectory(smoothness, durations, derivatives);
  }
};

struct SplineCostConfig {
  Smoothness smoothness = Smoothness::kSnap;
  MotionLimits motion;
  double radius = 0.0;  ///< of the robot, metres
  double margin = 0.1;  ///< metres beyond the radius within which the collision cost pushes
  double smoothness_weight = 1e-5;
  double collision_weight = 10.0;
  double limit_weight = 100.0;
};

/// CHOMP's obstacle potential (Ratliff et al. 2009) and its slope by the distance: linear where
/// the robot collides, quadratic within the margin, 0 beyond. In units of the margin.
struct Potential {
  double value = 0.0, slope = 0.0;
};
Potential obstacle_potential(double distance, double radius, double margin);

/// Cost of a SpaceSpline as a smooth function of its variables, for any optimiser: positions of
/// movable knots (knot by knot, x, y, z, in units of max_speed times the unit of time), then the
/// logarithm of each duration. Integrals are sums over `kSamples` intervals a segment; the gradient
/// is exact for these sums.
class SplineObjective {
 public:
  static constexpr int kSamples = 10;
  /// For each sample: unit-time position and derivatives from the derivatives at the ends.
  using Basis = std::vector<Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 10>>;

  /// References must outlive it. Throws as MinimumSpline does.
  SplineObjective(SpaceSpline spline, const SplineCostConfig& config, const DistanceField& field);

  std::size_t variable_count() const;
  std::vector<double> variables() const;

  /// The cost; its gradient too unless `gradient` is empty.
  double operator()(std::span<const double> variables, std::span<double> gradient);

  const CostTerms& terms() const { return terms_; }      ///< of the last call
  const SpaceSpline& spline() const { return spline_; }  ///< of the last call, solved

 private:
  using Sample =
      Eigen::Matrix<double, 4, 3>;  ///< position, velocity, acceleration, jerk; gradients
  void set(std::span<const double> variables);
  struct Density {
    double collision = 0.0, limits = 0.0;
  };
  Density density(const Sample& at, Sample& gradient) const;
  void add_segment(std::size_t segment);

  SpaceSpline spline_;
  const SplineCostConfig config_;
  const DistanceField& field_;
  double time_unit_, length_unit_;
  CostTerms terms_;
  Eigen::MatrixXd by_derivatives_;
  std::vector<double> by_durations_;
  const Basis& basis_;
};

}  // namespace ridgeway
