// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tangent_path.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "detour.hpp"
#include "paths/shorten.hpp"
#include "roadmap/graph_search.hpp"
#include "roadmap/tangent_search.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kWorthwhile = 1e-2;      // of a route's length: what a corner's move must gain,
constexpr double kWorthGoing = 2e-3;      // and going without it
constexpr double kHardly = 1.1;           // shorter by less: tight but for its ends
constexpr double kHardlyShort = 1.03;     // the same for a short route
constexpr double kNearlyStraight = 1.03;  // longer than the straight line by less
constexpr double kWinding = 1.5;          // by more: there is no way straight past what blocks it
constexpr double kDoubtful = 1.1;         // by more: a short route may have missed a corner
constexpr int kDetourCorners = 2;
constexpr double kShort = 50.0;  // radii: of a route that is little else than its ends

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

/// Goes straight past what blocks the straight line where that is shorter.
void look_past_what_blocks(const EsdfMap& esdf, const FreeSpace& space, const RouteQuery& query,
                           const Deadline& deadline, Route& path) {
  const double length = length_of(path), straight = (query.goal - query.start).norm();
  if (length <= kNearlyStraight * straight || length >= kWinding * straight) return;
  const Detour past =
      find_detour(esdf, space, query.start, query.goal, query.radius, length, kDetourCorners);
  if (!past.found()) return;
  path.assign({query.start});
  path.insert(path.end(), past.corners.begin(), past.corners.end());
  path.push_back(query.goal);
  path = draw_corners_in(space, path, query.radius, deadline);
}

}  // namespace

TangentPath plan_tangents(const TangentGraph& tangents, const EsdfMap& esdf, const FreeSpace& space,
                          const RouteQuery& query, bool as_it_is, const Deadline& deadline) {
  const double began = seconds_now();
  const std::vector<VertexId> corners =
      search_tangents(tangents.graph, tangents.hubs, space,
                      {query.start, query.goal, query.radius, tangents.seen_from(query.from),
                       tangents.seen_from(query.to)});
  const double found = seconds_now();
  TangentPath path;
  path.search_seconds = found - began;
  if (corners.empty()) return path;
  path.waypoints.push_back(query.start);
  for (const VertexId v : corners)
    path.waypoints.push_back(tangents.graph.vertices[number(v)].position);
  path.waypoints.push_back(query.goal);
  path.will_do = as_it_is;
  if (!as_it_is) {
    const double as_found = length_of(path.waypoints);
    const bool is_short = as_found <= kShort * query.radius;
    // Between corners it is as tight as the paths that they were learnt from.
    path.waypoints =
        draw_corners_in(space, path.waypoints, query.radius, deadline, {},
                        {kWorthwhile, is_short ? 0.0 : kWorthGoing, 1, corners.size()});
    if (is_short) look_past_what_blocks(esdf, space, query, deadline, path.waypoints);
    const double straight = (query.goal - query.start).norm(), tight = length_of(path.waypoints);
    const bool is_tight = as_found <= (is_short ? kHardlyShort : kHardly) * tight;
    path.will_do = (is_tight && !(is_short && tight > kDoubtful * straight)) ||
                   tight <= kNearlyStraight * straight;
  }
  path.known = known_part(tangents.graph, path.waypoints, corners);
  path.shorten_seconds = seconds_now() - found;
  return path;
}

}  // namespace ridgeway::detail
