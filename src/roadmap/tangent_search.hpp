// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/tangent_graph.hpp"

namespace ridgeway::detail {

/// From where to where, and which corners are worth a look from either.
struct TangentQuery {
  Point start, goal;
  double radius;
  std::span<const VertexId> seen_from_start, seen_from_goal;
};

/// The corners of the shortest route from start to goal over the tangent graph, every segment of it
/// free at the radius. Empty where the graph has none, which says nothing about space. Looks
/// along the segments from the start and to the goal only where a route over them would be the
/// shortest (lazily, as Bohlin and Kavraki's PRM, 2000).
std::vector<VertexId> search_tangents(const SparseGraph& graph, const HubLabels& hubs,
                                      const FreeSpace& space, const TangentQuery& query);

}  // namespace ridgeway::detail
