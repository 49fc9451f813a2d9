// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "spline_objective.hpp"

#include <array>
#include <cmath>

namespace ridgeway {
namespace {

using Eigen::Index;

/// Keeps |v| smooth where a robot stands still, m/s.
constexpr double kSmallSpeed = 1e-3;

/// (x / limit^2 - 1)^2 above the limit, of a squared magnitude x; adds its gradient by the vector.
template <typename Row>
double excess(const Eigen::Vector3d& vector, double limit, double weight, Row&& gradient) {
  const double over = vector.squaredNorm() / (limit * limit) - 1.0;
  if (over <= 0.0) return 0.0;
  gradient += weight * 4.0 * over / (limit * limit) * vector.transpose();
  return weight * over * over;
}

SplineObjective::Basis make_basis(Smoothness smoothness) {
  const auto& from_ends = unit_coefficients(smoothness);
  const int n = static_cast<int>(from_ends.rows());
  SplineObjective::Basis basis;
  for (int i = 0; i <= SplineObjective::kSamples; ++i) {
    const double u = static_cast<double>(i) / SplineObjective::kSamples;
    Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 10> powers(4, n);
    for (int order = 0; order < 4; ++order)
      for (int k = 0; k < n; ++k) {
        double factor = k < order ? 0.0 : std::pow(u, k - order);
        for (int j = 0; j < order; ++j) factor *= k - j;
        powers(order, k) = factor;
      }
    basis.emplace_back(powers * from_ends);
  }
  return basis;
}

const SplineObjective::Basis& sample_basis(Smoothness smoothness) {
  static const SplineObjective::Basis jerk = make_basis(Smoothness::kJerk);
  static const SplineObjective::Basis snap = make_basis(Smoothness::kSnap);
  return smoothness == Smoothness::kJerk ? jerk : snap;
}

}  // namespace

Potential obstacle_potential(double distance, double radius, double margin) {
  const double depth = (radius + margin - distance) / margin;
  if (depth <= 0.0) return {};
  if (depth <= 1.0) return {0.5 * depth * depth, -depth / margin};
  return {depth - 0.5, -1.0 / margin};
}

SplineObjective::SplineObjective(SpaceSpline spline, const SplineCostConfig& config,
                                 const DistanceField& field)
    : spline_(std::move(spline)),
      config_(config),
      field_(field),
      time_unit_(config.motion.max_speed / config.motion.max_acceleration),
      length_unit_(config.motion.max_speed * time_unit_),
      basis_(sample_basis(config.smoothness)) {}

std::size_t SplineObjective::variable_count() const {
  std::size_t count = spline_.durations.size();
  for (const bool movable : spline_.movable) count += movable ? 3 : 0;
  return count;
}

std::vector<double> SplineObjective::variables() const {
  const int rows = knot_size(config_.smoothness);
  std::vector<double> variables;
  for (std::size_t i = 0; i < spline_.movable.size(); ++i)
    for (int axis = 0; spline_.movable[i] && axis < 3; ++axis)
      variables.push_back(spline_.derivatives(static_cast<Index>(i) * rows, axis) / length_unit_);
  for (const double duration : spline_.durations)
    variables.push_back(std::log(duration / time_unit_));
  return variables;
}

void SplineObjective::set(std::span<const double> variables) {
  const int rows = knot_size(config_.smoothness);
  std::size_t next = 0;
  for (std::size_t i = 0; i < spline_.movable.size(); ++i)
    for (int axis = 0; spline_.movable[i] && axis < 3; ++axis)
      spline_.derivatives(static_cast<Index>(i) * rows, axis) = variables[next++] * length_unit_;
  for (double& duration : spline_.durations) duration = std::exp(variables[next++]) * time_unit_;
}

/// Terms that depend on one instant, per second, and the gradient of their sum.
SplineObjective::Density SplineObjective::density(const Sample& at, Sample& gradient) const {
  gradient.setZero();
  const MotionLimits& limits = config_.motion;
  const double per_second = config_.limit_weight / time_unit_;
  Density cost;
  cost.limits = excess(at.row(1), limits.max_speed, per_second, gradient.row(1)) +
                excess(at.row(2), limits.max_acceleration, per_second, gradient.row(2));
  if (std::isfinite(limits.max_jerk))
    cost.limits += excess(at.row(3), limits.max_jerk, per_second, gradient.row(3));
  if (config_.collision_weight == 0.0) return cost;

  const DistanceAndGradient here = field_(at.row(0).transpose());
  const Potential potential = obstacle_potential(here.distance, config_.radius, config_.margin);
  if (potential.value == 0.0) return cost;
  const double weight = config_.collision_weight / length_unit_;
  const double speed = std::sqrt(at.row(1).squaredNorm() + kSmallSpeed * kSmallSpeed);
  gradient.row(0) += weight * speed * potential.slope * here.gradient.transpose();
  gradient.row(1) += weight * potential.value / speed * at.row(1);
  cost.collision = weight * potential.value * speed;
  return cost;
}

void SplineObjective::add_segment(std::size_t segment) {
  using Ends = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 10, 3>;
  const int rows = knot_size(config_.smoothness);
  const Index first = static_cast<Index>(segment) * rows;
  const double T = spline_.durations[segment];
  Ends ends = spline_.derivatives.middleRows(first, 2 * static_cast<Index>(rows));
  double power = 1.0;
  for (int order = 0; order < rows; ++order, power *= T) {
    ends.row(order) *= power;
    ends.row(rows + order) *= power;
  }
  std::array<double, 5> powers{};  // of the duration
  for (int order = 0; order < rows; ++order)
    powers[static_cast<std::size_t>(order)] = std::pow(T, order);
  Ends by_ends = Ends::Zero(2 * rows, 3);
  for (int i = 0; i <= kSamples; ++i) {
    const auto& basis = basis_[static_cast<std::size_t>(i)];
    Sample at = basis * ends, gradient;
    for (int order = 1; order < 4; ++order)
      at.row(order) /= powers[static_cast<std::size_t>(order)];
    const double share = (i == 0 || i == kSamples ? 0.5 : 1.0) / kSamples;
    const Density cost = density(at, gradient);
    terms_.collision += share * T * cost.collision;
    terms_.limits += share * T * cost.limits;
    double by_duration = cost.collision + cost.limits;
    for (int order = 1; order < 4; ++order) {
      by_duration -= order * gradient.row(order).dot(at.row(order));
      gradient.row(order) /= powers[static_cast<std::size_t>(order)];
    }
    by_durations_[segment] += share * by_duration;
    by_ends += share * T * basis.transpose() * gradient;
  }
  power = 1.0;
  for (int order = 0; order < rows; ++order, power *= T) {
    by_durations_[segment] += order / T *
                              (ends.row(order).dot(by_ends.row(order)) +
                               ends.row(rows + order).dot(by_ends.row(rows + order)));
    by_derivatives_.row(first + order) += power * by_ends.row(order);
    by_derivatives_.row(first + rows + order) += power * by_ends.row(rows + order);
  }
}

double SplineObjective::operator()(std::span<const double> variables, std::span<double> gradient) {
  set(variables);
  const MinimumSpline minimum(config_.smoothness, spline_.durations, spline_.fixed);
  minimum.solve(spline_.derivatives);
  by_derivatives_.setZero(spline_.derivatives.rows(), 3);
  by_durations_.assign(spline_.durations.size(), 0.0);
  terms_ = {};
  for (std::size_t s = 0; s < spline_.durations.size(); ++s) {
    terms_.time += spline_.durations[s] / time_unit_;
    by_durations_[s] += 1.0 / time_unit_;
    add_segment(s);
  }
  const int order = static_cast<int>(config_.smoothness);
  const double weight = config_.smoothness_weight * std::pow(time_unit_, 2 * order - 1) /
                        (length_unit_ * length_unit_);
  terms_.smoothness = weight * minimum.cost(spline_.derivatives);
  if (gradient.empty()) return terms_.total();

  minimum.add_cost_gradient(spline_.derivatives, weight, by_derivatives_, by_durations_);
  minimum.pull_back(spline_.derivatives, by_derivatives_, by_durations_);
  const int rows = knot_size(config_.smoothness);
  std::size_t next = 0;
  for (std::size_t i = 0; i < spline_.movable.size(); ++i)
    for (int axis = 0; spline_.movable[i] && axis < 3; ++axis)
      gradient[next++] = by_derivatives_(static_cast<Index>(i) * rows, axis) * length_unit_;
  for (std::size_t s = 0; s < spline_.durations.size(); ++s)
    gradient[next++] = by_durations_[s] * spline_.durations[s];
  return terms_.total();
}

}  // namespace ridgeway
