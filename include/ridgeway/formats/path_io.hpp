// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway {

/// A plan as a JSON object: answered_by, status, length, within (where there is a path), clearance,
/// unknown {policy}, waypoints (a list of [x, y, z]), seconds {attach, search, shorten, total}.
/// Metres and seconds, world frame; numbers read back as they were; an infinite clearance is null.
/// Where the first or last segment is an
/// escape also escape_start or escape_goal {length, clearance}; where start or goal was moved also
/// moved_start or moved_goal {distance, place}.
std::string plan_json(const PlanResult& result);

/// Throws InputError where a file's extension is neither .csv nor .json.
void require_path_format(const std::filesystem::path& path);

/// Writes a plan to a file, whole or not at all: as plan_json to .json; as a header line "x,y,z"
/// and a line for each waypoint to .csv. Throws InputError for another extension, for a plan
/// without a path to .csv, and where the file cannot be written.
void write_plan(const PlanResult& result, const std::filesystem::path& path);

/// Waypoints of a file that write_plan wrote, or of a JSON list of [x, y, z], or of a CSV file
/// with or without a header line; columns named x, y and z are found in any order. Throws
/// InputError, with the line, for anything else.
std::vector<Point> read_path(const std::filesystem::path& path);

/// The escapes that the first and the last segment of a path are; length 0 where one is none.
struct PathEscapes {
  Escape start;  ///< of the first segment
  Escape goal;   ///< of the last
};

/// Those of a .json file that write_plan wrote; files of other kinds tell of none. Throws
/// InputError as read_path does.
PathEscapes read_escapes(const std::filesystem::path& path);

/// Where the world's frame lies on the Earth.
struct Datum {
  double latitude = 0.0;    ///< of the origin, degrees, WGS 84
  double longitude = 0.0;   ///< of the origin, degrees, WGS 84
  double altitude = 0.0;    ///< of z = 0, metres above mean sea level
  double x_heading = 90.0;  ///< of the x axis, degrees clockwise from north; 90: x east, y north

  /// Throws InputError for an angle out of range, and for what is not finite.
  void validate() const;
};

/// Degrees (WGS 84), and metres above mean sea level.
struct GeoPoint {
  double latitude = 0.0;   ///< degrees, north
  double longitude = 0.0;  ///< degrees, east
  double altitude = 0.0;   ///< metres above mean sea level
};

/// Where a point of the world is on the Earth. Throws InputError for a bad datum, and for a point
/// farther than 200 km from it: the coordinates of a grid such as UTM, not metres from a place. The
/// world's plane z = 0 touches the ellipsoid at the datum, so 1 km from there a point of that plane
/// is 0.08 m higher.
GeoPoint geodetic(const Point& point, const Datum& datum);

/// A path as a mission of QGroundControl for PX4: a waypoint a corner, at which the vehicle holds
/// for a second, as the legs between corners are what was verified: within 0.2 m, or within what
/// the path has of clearance beyond the radius that it was planned for, down to 0.05 m. No take-off
/// and no landing. MAVLink rounds angles to 1e-7 degrees, a centimetre.
std::string mission_json(const PlanResult& path, const Datum& datum);

/// Writes a mission to a .plan file, whole or not at all. Throws InputError for another extension,
/// a bad datum, a plan without a path, and where the file cannot be written.
void write_mission(const PlanResult& path, const Datum& datum, const std::filesystem::path& file);

/// Throws InputError where a file's extension is neither .csv nor .json nor .yaml.
void require_trajectory_format(const std::filesystem::path& path);

/// A path and the trajectory along it as a JSON object: the keys of plan_json, and step, duration,
/// stop_and_go_duration, max_speed, max_acceleration, max_jerk, max_yaw_rate (certified), stops,
/// optimisations, converged, evaluations, cost {time, smoothness, collision, limits} of the last,
/// and samples every `step` seconds: a list of {t, position, velocity, acceleration, yaw}. `status`
/// and `clearance` are the trajectory's, `path_clearance` the path's; `seconds` has optimise and
/// verify too, its total is of all. SI units, radians; numbers read back as they were; an infinite
/// clearance is null.
std::string trajectory_json(const PlanResult& path, const TrajectoryResult& result, double step);

/// A line every `step` seconds under the header t,x,y,z,vx,vy,vz,ax,ay,az,yaw.
std::string trajectory_csv(const Trajectory& trajectory, double step);

/// The pieces as mav_trajectory_generation reads them: `segments`, each with N (coefficients), D
/// (4: x, y, z, yaw), time (nanoseconds) and D lists of N coefficients, of 1, t, t^2, ... in
/// seconds. Times are rounded to nanoseconds, so joints move by up to half of that times the speed.
/// Throws InputError for a piece of less than half a nanosecond, or of more than 285 years.
std::string trajectory_yaml(const Trajectory& trajectory);

/// Writes a trajectory to a file, whole or not at all, in the format of its extension. Throws
/// InputError for another extension, as trajectory_yaml does, and where the file cannot be written.
void write_trajectory(const PlanResult& path, const TrajectoryResult& result,
                      const std::filesystem::path& file, double step);

}  // namespace ridgeway
