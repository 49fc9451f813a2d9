// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lattice_search.hpp"
#include "paths/deadline.hpp"
#include "query.hpp"
#include "ridgeway/esdf/free_space.hpp"

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
  /// Another route each time, longer and over other edges; nothing when there are no more. Refers
  /// to the roadmap. Null where the graph did not answer.
  std::function<std::optional<Route>()> next_alternative;
  double attach_seconds = 0.0;
  double search_seconds = 0.0;
};

/// Searches with the asked planner, and where that structure is too coarse for the radius with
/// the next finer one: graph, diagram, ESDF; within limits that the roadmap was not made for as
/// find_limited_route. Exact: no route means that there is none.
RouteResult find_route(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                       Planner planner, const Deadline& deadline);

}  // namespace ridgeway::detail
