// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

/// A plan as a JSON object: answered_by, status, length, clearance, unknown {policy}, waypoints (a
/// list of [x, y, z]), seconds {attach, search, shorten, total}. Metres and seconds; numbers
/// read back as they were; an infinite clearance is null. Where the first or last segment is an
/// escape also escape_start or escape_goal {length, clearance}.
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

}  // namespace ridgeway
