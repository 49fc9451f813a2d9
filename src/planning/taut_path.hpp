// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "query.hpp"
#include "route.hpp"

namespace ridgeway::detail {

/// The taut graph's route, pulled tight.
struct TautPath {
  Route waypoints;        ///< empty where there is none
  KnownStretch known;     ///< of it
  bool is_tight = false;  ///< it hardly became shorter, or is nearly straight: the graph knows the
                          ///< place, and a search is not likely to find anything shorter
  double search_seconds = 0.0, shorten_seconds = 0.0;
};
TautPath plan_taut(const TautGraph& taut, const FreeSpace& space, const RouteQuery& query,
                   const Deadline& deadline);

}  // namespace ridgeway::detail
