// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "taut_path.hpp"

#include <algorithm>

#include "../paths/shorten.hpp"
#include "../roadmap/graph_search.hpp"
#include "../roadmap/taut_search.hpp"
#include "detour.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kHardly = 1.03;          // shorter by less
constexpr double kNearlyStraight = 1.03;  // longer than the straight line by less
constexpr int kDetourCorners = 2;
constexpr double kWinding = 1.5;  // by more: there is no way straight past what blocks it

/// Waypoints of a route over corners, and what is known of it.
TautPath path_over(const SparseGraph& graph, const RouteQuery& query,
                   const std::vector<VertexId>& corners) {
  TautPath path;
  path.waypoints.push_back(query.start);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    path.waypoints.push_back(graph.vertices[number(corners[i])].position);
    if (i == 0) continue;
    const EdgeId edge = edge_between(graph, corners[i - 1], corners[i]);
    path.known.clearance = std::min(path.known.clearance, graph.edges[number(edge)].clearance);
  }
  path.waypoints.push_back(query.goal);
  path.known.first = 1;
  path.known.last = corners.size();
  return path;
}

/// Moves its corners, and looks past what blocks the straight line where it is not much longer.
void pull_tight(const EsdfMap& esdf, const FreeSpace& space, const RouteQuery& query,
                const Deadline& deadline, TautPath& path) {
  const double as_found = length_of(path.waypoints);
  const double straight = (query.goal - query.start).norm();
  Route tight = draw_corners_in(space, path.waypoints, query.radius, deadline);
  path.will_do = as_found <= kHardly * length_of(tight);
  if (const double length = length_of(tight);
      length > kNearlyStraight * straight && length < kWinding * straight) {
    const Detour past =
        find_detour(esdf, space, query.start, query.goal, query.radius, length, kDetourCorners);
    if (past.found()) {
      tight.assign({query.start});
      tight.insert(tight.end(), past.corners.begin(), past.corners.end());
      tight.push_back(query.goal);
      tight = draw_corners_in(space, tight, query.radius, deadline);
    }
    tight = redirect(esdf, space, std::move(tight), query.radius, deadline);
  }
  path.will_do |= length_of(tight) <= kNearlyStraight * straight;
  if (tight != path.waypoints) path.known = {};
  path.waypoints = std::move(tight);
}

}  // namespace

TautPath plan_taut(const TautGraph& taut, const EsdfMap& esdf, const FreeSpace& space,
                   const RouteQuery& query, bool as_it_is, const Deadline& deadline) {
  const double began = seconds_now();
  const std::vector<VertexId> corners =
      search_taut(taut.graph, taut.landmarks, space,
                  {query.start, query.goal, query.radius, taut.seen_from(query.from),
                   taut.seen_from(query.to)});
  const double found = seconds_now();
  TautPath path;
  if (!corners.empty()) path = path_over(taut.graph, query, corners);
  path.will_do = as_it_is && !corners.empty();
  if (!corners.empty() && !as_it_is) pull_tight(esdf, space, query, deadline, path);
  path.search_seconds = found - began;
  path.shorten_seconds = seconds_now() - found;
  return path;
}

}  // namespace ridgeway::detail
