// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "query.hpp"
#include "route.hpp"

namespace ridgeway::detail {

/// The tangent graph's route, pulled tight, or as it is where that has to do.
struct TangentPath {
  Route waypoints;     ///< empty where there is none
  KnownStretch known;  ///< of it
  double search_seconds = 0.0, shorten_seconds = 0.0;
};
TangentPath plan_tangents(const TangentGraph& tangents, const FreeSpace& space,
                          const RouteQuery& query, bool as_it_is, const Deadline& deadline);

}  // namespace ridgeway::detail
