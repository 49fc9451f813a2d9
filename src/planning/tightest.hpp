// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "route.hpp"

namespace ridgeway::detail {

/// The route pulled tight; where that stays longer than the straight line, alternatives are tried
/// as well, and ways past what blocks the line. Returns the shortest of them and of a path known
/// before, which may be empty. Where clearance is preferred it is pulled only as far as it gets no
/// costlier, and the cheapest returned.
Route tightest(const Roadmap& roadmap, const FreeSpace& space, RouteResult& found,
               const RouteQuery& query, Route known, const Deadline& deadline);

}  // namespace ridgeway::detail
