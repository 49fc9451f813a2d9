// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <vector>

#include "roadmap/cell_guide.hpp"
#include "roadmap/cell_search.hpp"
#include "route.hpp"

namespace ridgeway::detail {

/// Between ends that space connects: a route over the cell graph, pulled tight; empty where that
/// graph has none. `known`: length of a path that it has to be shorter than, metres, 0 for none.
CellRoute path_over_cells(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                          const AttachWay& from, const AttachWay& to, double known,
                          const Deadline& deadline);

/// A route pulled tight; empty where it becomes clear that it will not be shorter than `longest`,
/// metres.
Route shorten_below(const FreeSpace& space, Route route, double radius, double longest,
                    const Deadline& deadline);

/// A tight path, or one over ways past what blocks stretches of it, pulled tight.
Route past_what_blocks(const EsdfMap& esdf, const FreeSpace& space, const RouteQuery& query,
                       Route path, const Deadline& deadline);

/// A path by a search over voxels, guided by cells or not (null), pulled tight, that is about as
/// long as `length` at most, metres; empty where that finds none, or takes `most_voxels` first.
Route path_over_voxels(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                       double length, const CellGuide* guide, int most_voxels,
                       const Deadline& deadline);

/// The shortest path over voxels at any angle (search_any_angle), pulled tight; empty where time is
/// up.
Route shortest_over_voxels(const EsdfMap& esdf, const FreeSpace& space, const RouteQuery& query,
                           const Deadline& deadline);

/// A route, and which of those found it was; nothing: the short path.
struct CheapestRoute {
  Route route;
  std::optional<std::size_t> found;
};

/// Where clearance is preferred: the cheapest of a short path and of routes as found, pulled tight
/// only as far as they get no costlier.
CheapestRoute cheapest(const FreeSpace& space, const RouteQuery& query, std::vector<Route> as_found,
                       Route short_path, const Deadline& deadline);

}  // namespace ridgeway::detail
