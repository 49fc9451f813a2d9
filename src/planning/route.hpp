// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "lattice_search.hpp"
#include "paths/deadline.hpp"
#include "query.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "roadmap/attach_way.hpp"

namespace ridgeway::detail {

/// A polyline, metres; every segment free at the query's radius.
using Route = std::vector<Point>;

struct RouteQuery {
  VoxelId from, to;  ///< traversable voxels that start and goal join
  Point start, goal;
  double radius;
  double prefer_clearance = 0.0;  ///< see PlanConfig
};

struct RouteResult {
  SearchStatus status = SearchStatus::kNoRoute;
  Planner answered_by = Planner::kGraph;
  Route route;         ///< as searched: the shortest in the structure that answered
  KnownStretch known;  ///< of that route
};

/// What the ways of both ends into the graph show before any search.
enum class Reach : std::uint8_t {
  kJoined,     ///< the ways meet
  kConnected,  ///< both reach the graph, and space is connected between them at the radius
  kApart,      ///< space is not
  kUnclear,    ///< one of them stops before the graph
};

struct Attachment {
  AttachWay from, to;
  Reach reach = Reach::kUnclear;
};
/// By the largest sphere in the robot: what it cannot do the robot cannot either.
Attachment attach(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query);

/// Searches with the asked planner, and where that structure is too coarse for the radius with
/// the next finer one: graph, diagram, ESDF; within limits that the roadmap was not made for as
/// find_limited_route. Exact: no route means that there is none.
/// `attachment`: of the query; the planners that search voxels do without.
RouteResult find_route(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                       const Attachment& attachment, Planner planner, const Deadline& deadline);

}  // namespace ridgeway::detail
