// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/trajectory/plan_trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "common/clock.hpp"
#include "common/name_table.hpp"
#include "common/number_text.hpp"
#include "common/require.hpp"
#include "common/rounding.hpp"
#include "esdf/known_radius.hpp"
#include "initial_spline.hpp"
#include "paths/world_rounding.hpp"
#include "planning/query.hpp"
#include "ridgeway/common/error.hpp"
#include "shaped_trajectory.hpp"
#include "smooth_path.hpp"
#include "speed_scaling.hpp"
#include "straight_motion.hpp"
#include "yaw.hpp"

namespace ridgeway {
namespace {

using detail::SmoothPath;
using detail::StartState;

/// Coincident points count once.
std::vector<Point> distinct_points(std::span<const Point> path) {
  if (path.empty()) throw InputError("path", "has no points", "give at least one");
  std::vector<Point> points;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!path[i].allFinite())
      throw InputError("path point " + std::to_string(i), "is not finite",
                       "give three finite coordinates in metres");
    if (points.empty() || path[i] != points.back()) points.push_back(path[i]);
  }
  return points;
}

bool is_free(const FreeSpace& space, const std::vector<Point>& path, double radius) {
  for (const Point& p : path)
    if (!has_voxel(p, space.map().voxel_size)) return false;
  if (path.size() == 1) return space.is_free(path.front(), radius);
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!space.is_free(path[i - 1], path[i], radius)) return false;
  return true;
}

/// Without points that are no corners, as they lie on the straight way on, but for those to keep.
std::vector<Point> corners_of(std::span<const Point> path, double radius,
                              std::span<const Point> kept) {
  constexpr double kStraight = 1e-6;  // radii
  std::vector<Point> corners;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && i + 1 < path.size() &&
        std::find(kept.begin(), kept.end(), path[i]) == kept.end()) {
      const Point in = path[i] - corners.back(), whole = path[i + 1] - corners.back();
      const double along = in.dot(whole), length = whole.norm();
      const bool is_on = along > 0.0 && along < length * length;
      if (is_on && in.cross(whole).norm() <= kStraight * radius * length) continue;
    }
    corners.push_back(path[i]);
  }
  return corners;
}

/// The corners of a free path; from rest, where the way is straight all along, the ends alone.
std::vector<Point> corners_to_fly(const FreeSpace& space, const std::vector<Point>& path,
                                  const TrajectoryConfig& config, const StartState& start) {
  std::vector<Point> corners = corners_of(path, config.radius, {});
  if (corners.size() > 2 || !start.is_rest()) corners = corners_of(path, config.radius, config.via);
  return is_free(space, corners, config.radius) ? corners : path;
}

TrajectorySegment standing_at(const Point& p) {
  TrajectorySegment segment;
  segment.coefficients.col(0).head<3>() = p;
  return segment;
}

/// Yaw, duration, peaks, clearance.
void describe(const FreeSpace& space, const std::vector<Point>& path,
              const TrajectoryConfig& config, TrajectoryResult& result) {
  Trajectory& trajectory = result.trajectory;
  if (trajectory.segments.empty()) trajectory.segments.push_back(standing_at(path.front()));
  detail::assign_yaw(trajectory, knot_size(config.smoothness), config.motion.max_yaw_rate,
                     config.start_yaw, config.follow_yaw);
  const int corners = static_cast<int>(path.size()) - 2;
  const int at_corners = result.stops - (result.braked ? 1 : 0);
  if (corners > 0 && at_corners >= corners) result.step = TrajectoryStep::kStopAndGo;
  result.duration = trajectory.duration();
  result.peaks = find_peaks(trajectory);
  result.clearance = std::max(clearance_of(space.map(), trajectory),
                              detail::least_fit(space.inner_radius(config.radius)));  // as verified
}

void require_start_within_limits(const TrajectoryConfig& config) {
  if (config.start_velocity.norm() > config.motion.max_speed)
    throw InputError("start_velocity", "is faster than max_speed", "raise the limit or slow down");
  if (config.start_acceleration.norm() > config.motion.max_acceleration)
    throw InputError("start_acceleration", "is beyond max_acceleration", "raise the limit");
}

}  // namespace

std::string_view name_of(TrajectoryStatus status) {
  constexpr std::array<std::string_view, 3> kNames{"ok", "path_not_free", "cannot_stop_in_time"};
  return name_in(kNames, status);
}

std::string_view name_of(TrajectoryStep step) {
  constexpr std::array<std::string_view, 5> kNames{"smooth", "pushed", "inserted", "with_stops",
                                                   "stop_and_go"};
  return name_in(kNames, step);
}

void MotionLimits::validate() const {
  constexpr double kLeast = 1e-9, kMost = 1e9;  // beyond, products of them are 0 or infinite
  const auto require_limit = [](double limit, const char* name, bool may_be_endless) {
    detail::require(
        limit >= kLeast && (may_be_endless || limit <= kMost), name, limit,
        may_be_endless ? "give a limit of 1e-9 or more" : "give a limit from 1e-9 to 1e9");
  };
  require_limit(max_speed, "max_speed", false);
  require_limit(max_acceleration, "max_acceleration", false);
  require_limit(max_jerk, "max_jerk", true);
  require_limit(max_yaw_rate, "max_yaw_rate", true);
}

void TrajectoryConfig::validate() const {
  motion.validate();
  limits.validate();
  detail::validate_robot_height(robot_height);
  if (!(radius >= 0.0 && std::isfinite(radius)))
    throw InputError("radius", "is " + number_text(radius), "give the robot's radius in metres");
  if (smoothness != Smoothness::kSnap && smoothness != Smoothness::kJerk)
    throw InputError("smoothness", "is no enumerator of Smoothness", "give kSnap or kJerk");
  if (!start_velocity.allFinite())
    throw InputError("start_velocity", "is not finite", "give three finite numbers");
  if (!start_acceleration.allFinite())
    throw InputError("start_acceleration", "is not finite", "give three finite numbers");
  if (start_yaw && !std::isfinite(*start_yaw))
    throw InputError("start_yaw", "is not finite", "give radians");
  if (!std::all_of(via.begin(), via.end(), [](const Point& p) { return p.allFinite(); }))
    throw InputError("via", "has a place that is not finite", "give three finite numbers each");
  if (most_evaluations < 1)
    throw InputError("most_evaluations", "is " + std::to_string(most_evaluations),
                     "give 1 or more");
  require_start_within_limits(*this);
}

namespace {

void require_radius(const TrajectoryConfig& config) {
  config.validate();
  if (config.radius == 0.0)
    throw InputError("radius", "is 0", "give the robot's radius in metres, above 0");
}

/// plan_trajectory() along a path of the local frame, with a trajectory there.
TrajectoryResult fly_locally(const EsdfMap& esdf, std::span<const Point> path,
                             const TrajectoryConfig& config) {
  require_radius(config);
  detail::require_height_counts(esdf, config.robot_height);
  detail::require_known_radius(esdf, "radius", config.radius);
  for (const Point& place : config.via)
    if (std::find(path.begin(), path.end(), place) == path.end())
      throw InputError("via", "has a place that is no point of the path",
                       "give points of it, digit for digit, or plan over the place");
  std::vector<Point> points = distinct_points(path);
  const double began = detail::seconds_now();
  TrajectoryResult result;
  const auto finish = [&](TrajectoryStatus status) {
    result.status = status;
    if (!result.ok()) result.trajectory = {};
    result.seconds.total = detail::seconds_now() - began;
    return result;
  };
  const FlightLimits limits = both_of(esdf.limits, limits_in_local(esdf, config.limits));
  const FreeSpace space(esdf, limits, config.radius, config.robot_height);
  if (!is_free(space, points, config.radius)) return finish(TrajectoryStatus::kPathNotFree);

  const StartState start{config.start_velocity, config.start_acceleration};
  if (!config.stop_and_go) points = corners_to_fly(space, points, config, start);
  SmoothPath smooth(space, config, result);
  auto found = smooth.run(points, start);
  if (!found) return finish(TrajectoryStatus::kCannotStopInTime);
  const Trajectory halting = smooth.stop_and_go(points);
  result.stop_and_go_duration = halting.duration();
  result.trajectory = std::move(*found);
  // Stretches were verified one by one; straight ones hold by the path, but nothing leaves unseen.
  if (!smooth.holds(result.trajectory)) {
    result.trajectory = halting;
    result.step = TrajectoryStep::kStopAndGo;
    result.stops = static_cast<int>(points.size()) - 2;
    if (!start.is_rest()) return finish(TrajectoryStatus::kCannotStopInTime);
    if (!smooth.holds(halting)) return finish(TrajectoryStatus::kPathNotFree);
  }
  describe(space, points, config, result);
  return finish(TrajectoryStatus::kOk);
}

}  // namespace

TrajectoryResult plan_trajectory(const EsdfMap& esdf, std::span<const Point> path,
                                 const TrajectoryConfig& config) {
  TrajectoryConfig as_rounded = config;
  as_rounded.radius = detail::radius_less_rounding(config.radius, path);
  if (esdf.origin == VoxelIndex{} && !esdf.planar) return fly_locally(esdf, path, as_rounded);
  std::vector<Point> path_local;
  for (const Point& p : path) path_local.push_back(flight_place(esdf, p));
  for (Point& p : as_rounded.via) p = flight_place(esdf, p);
  if (esdf.planar) as_rounded.start_velocity.z() = as_rounded.start_acceleration.z() = 0.0;
  TrajectoryResult result = fly_locally(esdf, path_local, as_rounded);
  for (TrajectorySegment& segment : result.trajectory.segments) {
    const Point begin = segment.coefficients.col(0).head<3>();
    segment.coefficients.col(0).head<3>() = to_world(esdf, begin);
  }
  return result;
}

Trajectory to_local(const EsdfMap& esdf, Trajectory trajectory) {
  for (TrajectorySegment& segment : trajectory.segments) {
    const Point begin = segment.coefficients.col(0).head<3>();
    segment.coefficients.col(0).head<3>() = flight_place(esdf, begin);
    if (esdf.planar) segment.coefficients.row(2).tail<kCoefficients - 1>().setZero();
  }
  return trajectory;
}

bool still_safe(const Trajectory& trajectory, const TrajectoryConfig& config, const EsdfMap& now,
                double from) {
  require_radius(config);
  detail::require_height_counts(now, config.robot_height);
  detail::require_known_radius(now, "radius", config.radius);
  if (trajectory.segments.empty())
    throw InputError("trajectory", "is empty", "give that of a result that is ok()");
  if (std::isnan(from)) throw InputError("from", "is no number", "give seconds from its start");
  const FlightLimits limits = both_of(now.limits, limits_in_local(now, config.limits));
  const FreeSpace space(now, limits, config.radius, config.robot_height);
  std::vector<Point> places;
  for (const TrajectorySegment& segment : trajectory.segments)
    places.emplace_back(segment.coefficients.col(0).head<3>());
  // The path was rounded, and so was what came of it.
  const double radius =
      detail::radius_less_rounding(detail::radius_less_rounding(config.radius, places), places);
  return find_doubts(space, to_local(now, detail::tail_of(trajectory, from)), radius).empty();
}

Trajectory plain_spline(std::span<const Point> path, const TrajectoryConfig& config) {
  require_radius(config);
  const std::vector<Point> points = distinct_points(path);
  if (points.size() == 1) return {{standing_at(points.front())}};
  const MotionLimits along = detail::limits_along(points, 0.0, config.motion);
  SpaceSpline spline = detail::initial_spline(
      detail::place_knots(points, detail::knot_spacing(points, along, config.radius), config.via),
      {}, {.smoothness = config.smoothness, .motion = along}, config.via);
  MinimumSpline(config.smoothness, spline.durations, spline.fixed).solve(spline.derivatives);
  Trajectory trajectory = spline.trajectory(config.smoothness);
  detail::scale_to_limits(trajectory, config.motion);
  detail::assign_yaw(trajectory, knot_size(config.smoothness), config.motion.max_yaw_rate,
                     config.start_yaw, config.follow_yaw);
  return trajectory;
}

}  // namespace ridgeway
