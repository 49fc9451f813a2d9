// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "paths/deadline.hpp"
#include "roadmap/attach_way.hpp"
#include "route.hpp"

namespace ridgeway::detail {

/// A route over the graph within limits that it was not made for. Each of its vertices is moved to
/// the nearest place in the box that limits keep in, and an edge counts where the straight line
/// between its ends, so moved, is free: in a band between two heights a graph that runs in the
/// middle of rooms still tells the ways around walls. Lines are looked at when the search comes to
/// them. `from`, `to`: the ways of the query's voxels to the graph. No route says nothing about
/// space: then the voxels must be searched.
RouteResult find_limited_route(const Roadmap& roadmap, const FreeSpace& space,
                               const RouteQuery& query, const AttachWay& from, const AttachWay& to,
                               const Deadline& deadline);

}  // namespace ridgeway::detail
