// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// The terms of the cost, weighted. All are pure numbers: seconds are measured in v / a and metres
/// in v^2 / a (v, a the limits of speed and acceleration), so weights do not depend on the robot.
struct CostTerms {
  double time = 0.0;        ///< duration
  double smoothness = 0.0;  ///< integral of squared snap or jerk
  double collision = 0.0;   ///< CHOMP's potential, integrated over arc length
  double limits = 0.0;      ///< squared excess of squared speed, acceleration, jerk over time
  /// Their sum: what is made least.
  double total() const { return time + smoothness + collision + limits; }
};

/// Whether there is a trajectory, or why there is none.
enum class TrajectoryStatus : std::uint8_t {
  kOk,
  kPathNotFree,       ///< a segment of the path is not free at the radius
  kCannotStopInTime,  ///< from a motion neither the path can be followed nor braking is free
};

/// How a trajectory came about, each step taken where those before did not hold.
enum class TrajectoryStep : std::uint8_t {
  kSmooth,     ///< a single straight leg; or optimised, and verified at once
  kPushed,     ///< optimised again, pushed harder out of collision
  kInserted,   ///< with more knots on the straight path
  kWithStops,  ///< smooth stretches between stops at corners
  kStopAndGo,  ///< straight from stop to stop, all the way: the last resort, or faster
};

/// Names as in the JSON output: "ok", "path_not_free", "cannot_stop_in_time"; "smooth", "pushed",
/// "inserted", "with_stops", "stop_and_go".
std::string_view name_of(TrajectoryStatus status);
std::string_view name_of(TrajectoryStep step);  ///< The same of a step.

/// The robot, its limits of motion, and how it starts.
struct TrajectoryConfig {
  double radius = 0.0;       ///< of the robot, metres; 0: as the path was planned for (fly_plan)
  MotionLimits motion = {};  ///< of the robot
  Smoothness smoothness = Smoothness::kSnap;  ///< what is made least along the way
  Point start_velocity = Point::Zero();       ///< m/s
  Point start_acceleration = Point::Zero();   ///< m/s^2
  /// Radians; not given: the direction of travel at first.
  std::optional<double> start_yaw = std::nullopt;
  /// Yaw follows the direction of travel, as fast as its limit lets it; otherwise it stays.
  bool follow_yaw = true;
  FlightLimits limits = {};    ///< as in PlanConfig
  double robot_height = 0.0;   ///< as in PlanConfig
  bool stop_and_go = false;    ///< no smoothing: the last resort at once
  int most_evaluations = 120;  ///< of the cost, each time that a stretch is optimised
  /// Points of the path, digit for digit, that are passed as they are; other corners are rounded,
  /// and may be missed by far where there is room. Of two that all but touch (1e-7 of the distance
  /// between knots) one is passed.
  std::vector<Point> via = {};

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Seconds that the parts of planning a trajectory took.
struct TrajectorySeconds {
  double optimise = 0.0;  ///< to optimise splines
  double verify = 0.0;    ///< to verify them in continuous time
  double total = 0.0;     ///< of all
};

/// A verified trajectory, or the one reason why there is none.
struct TrajectoryResult {
  TrajectoryStatus status = TrajectoryStatus::kPathNotFree;  ///< kOk, or why there is none
  TrajectoryStep step = TrajectoryStep::kSmooth;             ///< what it took to get it
  Trajectory trajectory;                                     ///< empty unless ok
  double duration = 0.0;                                     ///< seconds
  double stop_and_go_duration = 0.0;  ///< seconds; from rest `duration` is never longer
  double clearance = 0.0;             ///< metres: D is nowhere smaller
  MotionPeaks peaks;                  ///< certified
  int stops = 0;                      ///< between start and goal
  bool braked = false;                ///< a moving start came to rest first
  CostTerms cost;                     ///< where the last optimisation ended
  int optimisations = 0;              ///< that were run, of all stretches and steps
  int converged = 0;                  ///< optimisations that did
  int evaluations = 0;                ///< of the cost, by all optimisations
  TrajectorySeconds seconds;          ///< what it took

  /// Whether there is a trajectory.
  bool ok() const { return status == TrajectoryStatus::kOk; }
};

/// A dynamically feasible trajectory along a path of straight segments (metres, world frame), from
/// rest or a given motion at its first point to rest at its last. Verified in continuous time: D >=
/// radius all along (FreeSpace, never the interpolated distance), known-free voxels only where
/// unknown space is no obstacle, limits certified by find_peaks.
///
/// A minimum-snap or -jerk spline is optimised in the ESDF; where it does not hold, it is pushed
/// harder, gets more knots on the path, and at last stops at corners: straight motion from stop to
/// stop always holds, so every free path from rest yields a trajectory. None lasts longer than stop
/// and go at the same limits, whose profile is as smooth: a leg of length L takes L / v + 1.1 v /
/// a, where the trapezoidal profile, with its jumps of acceleration, would take L / v + v / a.
/// Without a limit on jerk straight legs reach a jerk of 18.75 a^2 / v, short ones more.
///
/// From a motion that cannot go on along the path the robot brakes first, wherever it comes to
/// rest, and goes on from there. In a planar map motion has no height, as places have none there.
/// Where the map lies far from the world's zero, the path's coordinates have been rounded: the
/// radius counts as smaller by at most 5e-16 of the largest of them (in UTM, 3 nanometres), so that
/// paths of plan() that just fit are flown.
///
/// Thread-safe on one map, deterministic. Throws InputError for a path without points, a point that
/// is not finite, a start faster than the limits, a radius larger than the map knows distances for,
/// a place to be passed that is none of the path's points, or a bad configuration.
TrajectoryResult plan_trajectory(const EsdfMap& esdf, std::span<const Point> path,
                                 const TrajectoryConfig& config);

/// The same along a path of plan() with its escapes, each flown straight from rest to rest at the
/// clearance that it has; `clearance` of the result is without them. From a motion only where the
/// path begins without one: else InputError. For the robot and the flight limits that the path was
/// planned for (PlanResult::planned_for), as far as the configuration has none of its own: to fly
/// without those limits, take them out of the path.
TrajectoryResult fly_plan(const EsdfMap& esdf, const PlanResult& path,
                          const TrajectoryConfig& config);

/// For comparison, what plan_trajectory does without the distance field: the smoothest spline from
/// rest to rest through knots on the path, as fast as its limits allow. Nothing says that it is
/// free. Throws InputError for the same paths and configurations.
Trajectory plain_spline(std::span<const Point> path, const TrajectoryConfig& config);

/// Whether the rest of a trajectory (world) from a time on, seconds, is free on a map, as
/// plan_trajectory verifies it: what is being flown, held against a newer map. `config`: as it was
/// planned for, with its radius (not 0); motion plays no part. Escapes do not keep the radius: of
/// fly_plan's trajectories those hold that have none, and the others while they are on neither.
/// Throws InputError for an empty trajectory, a time that is no number, and as plan_trajectory does
/// for the configuration.
bool still_safe(const Trajectory& trajectory, const TrajectoryConfig& config, const EsdfMap& now,
                double from = 0.0);

/// A trajectory of the world in the map's local frame, in which the following take them.
Trajectory to_local(const EsdfMap& esdf, Trajectory trajectory);

/// Times, seconds from the start, from which on it cannot be shown that a sphere of the radius
/// fits: the first in each segment that has one. Empty: the robot fits for certain, all along. Each
/// curve lies in the hull of its Bezier points, so where it departs from its chord by at most e it
/// is free if the chord is free at radius + e (D is 1-Lipschitz); curves are halved until that
/// holds, or one begins where it is not free, or is shorter than a thousandth of a voxel. Under
/// UnknownPolicy::kIgnore the box around the hull, or the chord where the curve is straight, must
/// lie in known-free voxels too. Where flights are limited the hull must be within the box that
/// limits keep in, and the chord as far from each of those that they keep out as the curve departs.
/// `space` may be an EsdfMap.
std::vector<double> find_doubts(const FreeSpace& space, const Trajectory& trajectory,
                                double radius);

/// Lower bound of the smallest D along a trajectory, metres, at most a millimetre too small.
double clearance_of(const EsdfMap& esdf, const Trajectory& trajectory);

}  // namespace ridgeway
