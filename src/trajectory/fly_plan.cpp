// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway {
namespace {

/// Flights one after the other, each from rest where the one before came to rest.
class Flights {
 public:
  Flights(const EsdfMap& esdf, const TrajectoryConfig& config) : esdf_(esdf), config_(config) {}

  /// Whether it can be flown. `counts`: its clearance is that of the whole.
  bool add(std::span<const Point> path, double radius, bool counts) {
    TrajectoryConfig config = config_;
    config.radius = radius;
    if (!counts) config.via.clear();  // an escape is straight
    if (!whole_.trajectory.segments.empty()) {
      config.start_velocity = config.start_acceleration = Point::Zero();
      config.start_yaw = whole_.trajectory.at(whole_.duration).yaw;
    }
    const TrajectoryResult leg = plan_trajectory(esdf_, path, config);
    if (!leg.ok()) {
      whole_ = {};  // nothing of legs that would have held
      whole_.status = leg.status;
      return false;
    }
    whole_.status = leg.status;
    append(leg, counts);
    return true;
  }

  TrajectoryResult result() && { return std::move(whole_); }

 private:
  void append(const TrajectoryResult& leg, bool counts) {
    auto& segments = whole_.trajectory.segments;
    if (leg.duration > 0.0) {  // else both escapes end at one place
      whole_.stops += leg.stops + (segments.empty() ? 0 : 1);
      segments.insert(segments.end(), leg.trajectory.segments.begin(),
                      leg.trajectory.segments.end());
    }
    whole_.duration += leg.duration;
    whole_.stop_and_go_duration += leg.stop_and_go_duration;
    whole_.step = std::max(whole_.step, leg.step);
    if (counts) {
      whole_.clearance = leg.clearance;
      whole_.cost = leg.cost;
    }
    whole_.braked |= leg.braked;
    whole_.peaks = find_peaks(whole_.trajectory);
    whole_.optimisations += leg.optimisations;
    whole_.converged += leg.converged;
    whole_.evaluations += leg.evaluations;
    whole_.seconds.optimise += leg.seconds.optimise;
    whole_.seconds.verify += leg.seconds.verify;
    whole_.seconds.total += leg.seconds.total;
  }

  const EsdfMap& esdf_;
  const TrajectoryConfig& config_;
  TrajectoryResult whole_;
};

/// With the robot and the limits of the plan where it has none of its own.
TrajectoryConfig for_robot_of(const PlannedFor& planned_for, TrajectoryConfig config) {
  if (config.radius == 0.0) config.radius = planned_for.radius;
  if (config.robot_height == 0.0) config.robot_height = planned_for.robot_height;
  if (!config.limits.any()) config.limits = planned_for.limits;
  return config;
}

}  // namespace

TrajectoryResult fly_plan(const EsdfMap& esdf, const PlanResult& path,
                          const TrajectoryConfig& config) {
  const TrajectoryConfig own = for_robot_of(path.planned_for, config);
  const std::span<const Point> points = path.waypoints;
  const bool leaves = path.escape_start.length > 0.0, enters = path.escape_goal.length > 0.0;
  if (points.size() < 2 || (!leaves && !enters)) return plan_trajectory(esdf, points, own);
  if (leaves && !(own.start_velocity.isZero(0.0) && own.start_acceleration.isZero(0.0)))
    throw InputError("start_velocity", "is that of a robot in flight, which has nothing to escape",
                     "leave it out");
  if (leaves && enters && points.size() == 2)
    throw InputError("path", "has two escapes, and no place between them",
                     "give a path of plan as it is");
  TrajectoryConfig between = own;  // the flight ends at the ends anyway
  std::erase_if(between.via,
                [&](const Point& p) { return p == points.front() || p == points.back(); });
  Flights flights(esdf, between);
  const std::size_t first = leaves ? 1 : 0, last = points.size() - (enters ? 2 : 1);
  bool holds = true;
  if (leaves) holds = flights.add(points.first(2), path.escape_start.clearance, false);
  if (holds) holds = flights.add(points.subspan(first, last - first + 1), own.radius, true);
  if (holds && enters) flights.add(points.last(2), path.escape_goal.clearance, false);
  return std::move(flights).result();
}

}  // namespace ridgeway
