// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "query.hpp"
#include "route.hpp"

namespace ridgeway::detail {

struct TautRoute {
  Route waypoints;
  KnownStretch known;
};

/// The shortest route from start over corners of the taut graph to the goal, every segment free at
/// the query's radius. Nothing where the graph has none, which says nothing about space. A* that
/// looks along the segments from the start and to the goal only when they would be next (lazy PRM,
/// Bohlin and Kavraki 2000).
std::optional<TautRoute> search_taut(const TautGraph& taut, const FreeSpace& space,
                                     const RouteQuery& query);

/// That route pulled tight.
struct TautPath {
  Route waypoints;       ///< empty where there is none
  KnownStretch known;    ///< of it
  bool is_tight = false; ///< it hardly became shorter, or is nearly straight: the graph knows the
                         ///< place, and no search is likely to find anything shorter
  double search_seconds = 0.0, shorten_seconds = 0.0;
};
TautPath plan_taut(const TautGraph& taut, const FreeSpace& space, const RouteQuery& query,
                   const Deadline& deadline);

}  // namespace ridgeway::detail
