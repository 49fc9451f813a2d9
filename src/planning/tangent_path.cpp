// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tangent_path.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "common/rounding.hpp"
#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"
#include "roadmap/graph_search.hpp"
#include "roadmap/tangent_search.hpp"

namespace ridgeway::detail {
namespace {

double clearance_over(const SparseGraph& graph, std::span<const VertexId> corners) {
  double clearance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const EdgeId edge = edge_between(graph, corners[i - 1], corners[i]);
    clearance = std::min(clearance, graph.edges[number(edge)].clearance);
  }
  return clearance;
}

/// The first run of waypoints that are those corners still.
KnownStretch known_part(const SparseGraph& graph, const Route& path,
                        const std::vector<VertexId>& corners) {
  const auto is_at = [&](std::size_t waypoint, std::size_t corner) {
    return path[waypoint] == graph.vertices[number(corners[corner])].position;
  };
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    for (std::size_t first = 0; first < corners.size(); ++first) {
      if (!is_at(i, first)) continue;
      std::size_t count = 1;
      while (i + count + 1 < path.size() && first + count < corners.size() &&
             is_at(i + count, first + count))
        ++count;
      return {i, i + count - 1, clearance_over(graph, std::span(corners).subspan(first, count))};
    }
  return {};
}

}  // namespace

TangentPath plan_tangents(const TangentGraph& tangents, const FreeSpace& space,
                          const RouteQuery& query, bool as_it_is, const Deadline& deadline) {
  const SparseGraph& graph = tangents.graph;
  if (tangents.empty() || !is_as_wide(graph.min_clearance, query.radius)) return {};
  const double began = seconds_now();
  const std::vector<VertexId> corners =
      search_tangents(graph, tangents.hubs, space,
                      {query.start, query.goal, query.radius, tangents.seen_from(query.from),
                       tangents.seen_from(query.to)});
  const double found = seconds_now();
  TangentPath path;
  path.search_seconds = found - began;
  if (corners.empty()) return path;
  path.waypoints.push_back(query.start);
  for (const VertexId v : corners) path.waypoints.push_back(graph.vertices[number(v)].position);
  path.waypoints.push_back(query.goal);
  if (!as_it_is) {
    // Between corners it is as tight as the paths that they were learnt from.
    path.waypoints = draw_corners_in(space, path.waypoints, query.radius, deadline, {},
                                     {kPlanning.corner_gain, 1, corners.size()});
  }
  path.known = known_part(graph, path.waypoints, corners);
  path.shorten_seconds = seconds_now() - found;
  return path;
}

}  // namespace ridgeway::detail
