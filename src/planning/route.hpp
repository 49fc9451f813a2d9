// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "deadline.hpp"
#include "lattice_search.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::detail {

/// A polyline, metres; every segment free at the query's radius.
using Route = std::vector<Point>;

struct RouteQuery {
  VoxelId from, to;      ///< traversable voxels that start and goal join
  Point start, goal;
  double radius;
  bool want_several;     ///< look for distinct routes, since the shortest may not stay it
};

struct RouteResult {
  SearchStatus status = SearchStatus::kNoRoute;
  Planner answered_by = Planner::kGraph;
  std::vector<Route> routes;  ///< as searched; the first is the shortest of them
  double attach_seconds = 0.0;
  double search_seconds = 0.0;
};

/// Searches with the asked planner, and where that structure is too coarse for the radius with
/// the next finer one: graph, diagram, ESDF. Exact: no route means that there is none.
RouteResult find_routes(const Roadmap& roadmap, const RouteQuery& query, Planner planner,
                        const Deadline& deadline);

/// Shortens the routes, most promising first, and returns the shortest result.
Route shortest_of(const EsdfMap& esdf, const FreeSpace& space, const std::vector<Route>& routes,
                  double radius, const Deadline& deadline);

}  // namespace ridgeway::detail
