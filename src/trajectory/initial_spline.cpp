// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "initial_spline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeway::detail {
namespace {

constexpr double kLeastPiece = 0.25;  // of the spacing: no knots closer, but for ends
constexpr double kRestPiece = 0.15;   // of the piece next to a rest, cut off
constexpr double kTouching = 1e-7;    // of the spacing: no knots closer, whatever they are

bool is_among(std::span<const Point> places, const Point& p) {
  return std::find(places.begin(), places.end(), p) != places.end();
}

/// Speed at which a corner can be rounded within half of the shorter leg: the circle that touches
/// both legs there has radius leg / 2 / tan(turn / 2).
double corner_speed(const Point& before, const Point& corner, const Point& after,
                    const MotionLimits& limits) {
  const Point in = corner - before, out = after - corner;
  const double turn = std::atan2(in.cross(out).norm(), in.dot(out));
  const double leg = 0.5 * std::min(in.norm(), out.norm());
  const double radius = leg / std::max(std::tan(0.5 * turn), 1e-9);
  return std::min(limits.max_speed, std::sqrt(limits.max_acceleration * radius));
}

std::vector<double> knot_speeds(std::span<const Point> knots, double start_speed,
                                const MotionLimits& limits) {
  std::vector<double> speeds(knots.size(), 0.0);
  for (std::size_t i = 1; i + 1 < knots.size(); ++i)
    speeds[i] = corner_speed(knots[i - 1], knots[i], knots[i + 1], limits);
  speeds.front() = start_speed;
  const auto reachable = [&](std::size_t from, std::size_t to) {
    const double length = (knots[to] - knots[from]).norm();
    return std::sqrt(speeds[from] * speeds[from] + 2.0 * limits.max_acceleration * length);
  };
  for (std::size_t i = 1; i < knots.size(); ++i)
    speeds[i] = std::min(speeds[i], reachable(i - 1, i));
  for (std::size_t i = knots.size() - 1; i-- > 1;)
    speeds[i] = std::min(speeds[i], reachable(i + 1, i));
  return speeds;
}

// Of a trapezoidal speed profile between two speeds: how fast it becomes, and how long it takes.

double profile_peak(double length, double from, double to, const MotionLimits& limits) {
  const double v = limits.max_speed, a = limits.max_acceleration;
  return std::max({std::min(std::sqrt(0.5 * (from * from + to * to) + a * length), v), from, to});
}

double profile_duration(double length, double from, double to, const MotionLimits& limits) {
  const double a = limits.max_acceleration, peak = profile_peak(length, from, to, limits);
  const double changing = (2.0 * peak * peak - from * from - to * to) / (2.0 * a);
  const double cruise = std::max(length - changing, 0.0) / peak;
  return (2.0 * peak - from - to) / a + cruise;
}

}  // namespace

MotionLimits limits_along(std::span<const Point> path, double start_speed,
                          const MotionLimits& limits) {
  const std::vector<double> speeds = knot_speeds(path, start_speed, limits);
  MotionLimits along = limits;
  along.max_speed = start_speed;
  for (std::size_t i = 1; i < path.size(); ++i)
    along.max_speed = std::max(along.max_speed, profile_peak((path[i] - path[i - 1]).norm(),
                                                             speeds[i - 1], speeds[i], limits));
  return along;
}

std::vector<Point> place_knots(std::span<const Point> path, double spacing,
                               std::span<const Point> kept) {
  std::vector<Point> knots{path.front()};
  Point farthest = path.front();  // of those that were passed over since the last knot
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool is_goal = i + 1 == path.size();
    const double passed_over = (farthest - knots.back()).norm();
    if (is_goal && (path[i] - knots.back()).norm() < passed_over) knots.push_back(farthest);
    const Point from = knots.back(), along = path[i] - from;
    const double length = along.norm();
    const double least = is_among(kept, path[i]) ? kTouching : kLeastPiece;
    if (length < least * spacing && !is_goal) {
      if (length > passed_over) farthest = path[i];
      continue;
    }
    farthest = path[i];
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / spacing)));
    for (int k = 1; k < pieces; ++k) knots.emplace_back(from + along * k / pieces);
    knots.push_back(path[i]);
  }
  const std::size_t n = knots.size();
  const auto to_goal = [&](std::size_t i) { return (knots.back() - knots[i]).norm(); };
  if (n > 2) {
    const double least = is_among(kept, knots[n - 2]) ? kTouching : kLeastPiece;
    if (to_goal(n - 2) < least * spacing && to_goal(n - 2) < to_goal(n - 3))
      knots.erase(knots.end() - 2);
  }
  return knots;
}

void add_knots_near_rest(bool starts_at_rest, double spacing, std::vector<Point>& knots) {
  const Point first = knots[1] - knots[0], last = knots[knots.size() - 2] - knots.back();
  const double shortest = kLeastPiece * spacing;
  if (last.norm() > shortest) knots.insert(knots.end() - 1, knots.back() + kRestPiece * last);
  if (starts_at_rest && first.norm() > shortest)
    knots.insert(knots.begin() + 1, knots[0] + kRestPiece * first);
}

SpaceSpline initial_spline(const std::vector<Point>& knots, const StartState& start,
                           const SplineCostConfig& config, std::span<const Point> kept) {
  const std::vector<double> speeds =
      knot_speeds(knots, std::min(start.velocity.norm(), config.motion.max_speed), config.motion);
  const int rows = knot_size(config.smoothness);
  SpaceSpline spline;
  spline.derivatives.setZero(static_cast<Eigen::Index>(knots.size()) * rows, 3);
  for (std::size_t i = 0; i < knots.size(); ++i)
    spline.derivatives.row(static_cast<Eigen::Index>(i) * rows) = knots[i].transpose();
  spline.derivatives.row(1) = start.velocity.transpose();
  spline.derivatives.row(2) = start.acceleration.transpose();
  for (std::size_t i = 1; i < knots.size(); ++i)
    spline.durations.push_back(profile_duration((knots[i] - knots[i - 1]).norm(), speeds[i - 1],
                                                speeds[i], config.motion));
  spline.fixed.assign(knots.size(), kPositionFixed);
  spline.fixed.front() = start.is_rest() ? kAllFixed : kStateFixed;
  spline.fixed.back() = kAllFixed;
  for (const Point& knot : knots) spline.movable.push_back(!is_among(kept, knot));
  spline.movable.front() = spline.movable.back() = false;
  return spline;
}

}  // namespace ridgeway::detail
