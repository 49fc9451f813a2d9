// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "yaw.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bernstein.hpp"
#include "minimum_spline.hpp"
#include "shaped_trajectory.hpp"

namespace ridgeway::detail {
namespace {

/// From rest to rest, a piece's peak rate is 2.46 (degree 9) or 2.19 (degree 7) of its mean rate.
constexpr double kPeakOverMean = 2.5;
constexpr double kLeastTime = 1e-3;  // seconds: a shorter piece is none
constexpr double kSmallTurn = 0.05;  // radians: still straight on
constexpr double kStanding = 1e-3;   // of a metre or metre a second: no direction of travel

std::optional<double> heading(const Point& direction) {
  if (std::hypot(direction.x(), direction.y()) < kStanding) return std::nullopt;
  return std::atan2(direction.y(), direction.x());
}

/// Direction of travel where a piece begins: of the velocity, or where the robot stands that in
/// which it goes on.
std::optional<double> heading_at_start(const TrajectorySegment& s) {
  const auto now = heading(s.derivative(1, 0.0).head<3>());
  return now ? now : heading((s.derivative(0, s.duration) - s.derivative(0, 0.0)).head<3>());
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
  ends(1) = rate_from * segment.duration;
  ends(rows) = to - from;
  ends(rows + 1) = rate_to * segment.duration;
  const auto smoothness = static_cast<Smoothness>(rows - 1);
  const Eigen::VectorXd unit = unit_coefficients(smoothness) * ends;
  segment.coefficients.row(3).setZero();
  segment.coefficients(3, 0) = from;
  double power = segment.duration;
  for (Eigen::Index k = 1; k < unit.size() && from != to; ++k, power *= segment.duration)
    segment.coefficients(3, k) = unit(k) / power;
}

/// Cuts a piece in two at a time, the curve staying the same.
void cut(std::vector<TrajectorySegment>& segments, std::size_t i, double t) {
  const TrajectorySegment rest = tail_of(segments[i], t);
  segments[i].duration = t;
  segments.insert(segments.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest);
}

/// Yaw at the joints: after each piece as near to the direction of travel as the limit allows.
/// Where the robot goes straight on after a turn that the yaw has not followed, the long piece is
/// cut so that the yaw need not take all of it.
std::vector<double> joint_yaws(std::vector<TrajectorySegment>& segments, double max_rate,
                               double start_yaw) {
  std::vector<double> yaw{start_yaw};
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const bool is_last = i + 1 == segments.size();
    const auto here = heading_at_start(segments[i]);
    const auto next = is_last ? here : heading_at_start(segments[i + 1]);
    const double target = next ? nearest_turn(*next, yaw[i]) : yaw[i];
    const double time = std::abs(target - yaw[i]) * kPeakOverMean / max_rate;
    const bool straight = here && std::abs(nearest_turn(*here, target) - target) < kSmallTurn;
    if (straight && std::abs(target - yaw[i]) > kSmallTurn && time > kLeastTime &&
        time < 0.5 * segments[i].duration)
      cut(segments, i, time);
    const double most = max_rate * segments[i].duration / kPeakOverMean;
    yaw.push_back(std::clamp(target, yaw[i] - most, yaw[i] + most));
  }
  return yaw;
}

double first_heading(const std::vector<TrajectorySegment>& segments) {
  for (const TrajectorySegment& segment : segments)
    if (const auto found = heading_at_start(segment)) return *found;
  return 0.0;
}

}  // namespace

void assign_yaw(Trajectory& trajectory, int rows, double max_rate, std::optional<double> start_yaw,
                bool follow) {
  std::vector<TrajectorySegment>& segments = trajectory.segments;
  const double start = start_yaw ? *start_yaw : first_heading(segments);
  const std::vector<double> yaw = follow ? joint_yaws(segments, max_rate, start)
                                         : std::vector<double>(segments.size() + 1, start);
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
