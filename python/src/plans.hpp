// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "faces.hpp"

namespace ridgeway::python {

/// The waypoints of a PlanResult, or points (N, 3).
std::vector<Point> path_points_from(py::handle path, const char* name);

/// Adds pictures to Roadmap.
void add_pictures(py::class_<RoadmapFace>& type);
/// The queries of a roadmap as methods of its class.
void add_queries(py::class_<RoadmapFace>& type);
/// Likewise its trajectories.
void add_trajectories(py::class_<RoadmapFace>& type);

}  // namespace ridgeway::python
