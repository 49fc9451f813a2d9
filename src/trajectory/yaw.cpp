// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "yaw.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bernstein.hpp"
#include "ridgeway/trajectory/minimum_spline.hpp"

namespace ridgeway::detail {
namespace {

/// From rest to rest, a piece's peak rate is 2.46 (degree 9) or 2.19 (degree 7) of its mean rate.
constexpr double kPeakOverMean = 2.5;
constexpr double kStanding = 1e-3;  // of a metre or metre a second: no direction of travel

std::optional<double> heading(const Point& direction) {
  if (std::hypot(direction.x(), direction.y()) < kStanding) return std::nullopt;
  return std::atan2(direction.y(), direction.x());
}

/// Direction of travel at each joint: of the velocity, or where the robot stands that in which it
/// goes on.
std::vector<std::optional<double>> headings(const Trajectory& trajectory) {
  std::vector<std::optional<double>> result;
  for (const TrajectorySegment& s : trajectory.segments) {
    const Point velocity = s.derivative(1, 0.0).head<3>();
    const Point onward = (s.derivative(0, s.duration) - s.derivative(0, 0.0)).head<3>();
    const auto now = heading(velocity);
    result.push_back(now ? now : heading(onward));
  }
  result.push_back(std::nullopt);  // it stops: as before
  return result;
}

double nearest_turn(double angle, double to) {
  return angle + 2.0 * std::numbers::pi * std::round((to - angle) / (2.0 * std::numbers::pi));
}

/// Rates at the joints that keep each piece monotone: none where the turn changes its sense,
/// otherwise between the mean rates on both sides, nearer to the smaller.
std::vector<double> joint_rates(const std::vector<double>& yaw, const Trajectory& trajectory) {
  std::vector<double> rates(yaw.size(), 0.0);
  for (std::size_t i = 1; i + 1 < yaw.size(); ++i) {
    const double before = (yaw[i] - yaw[i - 1]) / trajectory.segments[i - 1].duration;
    const double after = (yaw[i + 1] - yaw[i]) / trajectory.segments[i].duration;
    if (before * after > 0.0) rates[i] = 2.0 * before * after / (before + after);
  }
  return rates;
}

void set_yaw(TrajectorySegment& segment, int rows, double from, double to, double rate_from,
             double rate_to) {
  Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(2 * rows, 1);
  ends(0) = from;
  ends(1) = rate_from * segment.duration;
  ends(rows) = to;
  ends(rows + 1) = rate_to * segment.duration;
  const auto smoothness = static_cast<Smoothness>(rows - 1);
  const Eigen::VectorXd unit = unit_coefficients(smoothness) * ends;
  segment.coefficients.row(3).setZero();
  segment.coefficients(3, 0) = from;
  double power = segment.duration;
  for (Eigen::Index k = 1; k < unit.size() && from != to; ++k, power *= segment.duration)
    segment.coefficients(3, k) = unit(k) / power;
}

}  // namespace

void assign_yaw(Trajectory& trajectory, int rows, double max_rate, std::optional<double> start_yaw,
                bool follow) {
  std::vector<TrajectorySegment>& segments = trajectory.segments;
  const std::vector<std::optional<double>> travel = headings(trajectory);
  std::vector<double> yaw(travel.size());
  const auto first = std::find_if(travel.begin(), travel.end(), [](const auto& h) { return !!h; });
  yaw[0] = start_yaw.value_or(first != travel.end() ? **first : 0.0);
  for (std::size_t i = 1; i < yaw.size(); ++i) {
    const double most = max_rate * segments[i - 1].duration / kPeakOverMean;
    const double target = follow && travel[i] ? nearest_turn(*travel[i], yaw[i - 1]) : yaw[i - 1];
    yaw[i] = std::clamp(target, yaw[i - 1] - most, yaw[i - 1] + most);
  }
  std::vector<double> rates = joint_rates(yaw, trajectory);
  const auto set = [&](std::size_t i) {
    set_yaw(segments[i], rows, yaw[i], yaw[i + 1], rates[i], rates[i + 1]);
  };
  // Where rates at the joints make a piece too fast, it goes from rest to rest; so do neighbours,
  // whose rates change by that and are set again.
  for (std::size_t i = 0; i < segments.size(); ++i) {
    set(i);
    if (find_peaks(segments[i]).yaw_rate <= max_rate) continue;
    rates[i] = rates[i + 1] = 0.0;
    set(i);
    for (std::size_t k = i; k-- > 0;) {
      set(k);
      if (find_peaks(segments[k]).yaw_rate <= max_rate) break;
      rates[k] = 0.0;
      set(k);
    }
  }
}

}  // namespace ridgeway::detail
