// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway {

/// A plan as a JSON object: answered_by, status, length, clearance, unknown {policy}, waypoints (a
/// list of [x, y, z]), seconds {attach, search, shorten, total}. Metres and seconds; numbers
/// read back as they were; an infinite clearance is null. Where the first or last segment is an
/// escape also escape_start or escape_goal {length, clearance}; where start or goal was moved also
/// moved_start or moved_goal {distance, place}.
std::string plan_json(const PlanResult& result);

/// Throws InputError where a file's extension is neither .csv nor .json.
void require_path_format(const std::filesystem::path& path);

/// Writes a plan to a file, whole or not at all: as plan_json to .json; as a header line "x,y,z"
/// and a line for each waypoint to .csv. Throws InputError for another extension, and where the
/// file cannot be written.
void write_plan(const PlanResult& result, const std::filesystem::path& path);

/// Waypoints of a file that write_plan wrote, or of a JSON list of [x, y, z], or of a CSV file
/// with or without a header line; columns named x, y and z are found in any order. Throws
/// InputError, with the line, for anything else.
std::vector<Point> read_path(const std::filesystem::path& path);

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
std::string trajectory_yaml(const Trajectory& trajectory);

/// Writes a trajectory to a file, whole or not at all, in the format of its extension. Throws
/// InputError for another extension, and where the file cannot be written.
void write_trajectory(const PlanResult& path, const TrajectoryResult& result,
                      const std::filesystem::path& file, double step);

}  // namespace ridgeway
