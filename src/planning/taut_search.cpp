// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "taut_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "../paths/shorten.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kHardly = 1.03;          // shorter by less
constexpr double kNearlyStraight = 1.05;  // longer than the straight line by less
constexpr double kFar = std::numeric_limits<double>::infinity();

/// What an entry of the queue says of its corner.
enum class Step : std::uint8_t {
  kFromStart,  ///< seen from the start, if that segment is free
  kAlong,      ///< reached over edges
  kToGoal,     ///< sees the goal, if that segment is free
};

struct OpenEntry {
  double estimate;
  double cost;
  VertexId corner;
  Step step;
  bool operator<(const OpenEntry& other) const {  // the queue's top is the best
    return estimate != other.estimate ? estimate > other.estimate : corner > other.corner;
  }
};

struct CornerState {
  double cost = kFar;
  double to_goal = kFar;  ///< length of the segment to the goal, where that is worth a look
  VertexId from = kNoVertex;
  bool closed = false;
};

class TautSearch {
 public:
  TautSearch(const TautGraph& taut, const FreeSpace& space, const RouteQuery& query)
      : taut_(taut), space_(space), query_(query), states_(taut.graph.vertices.size()) {
    goal_lengths_.fill(kFar);
    for (const VertexId v : taut.seen_from(query.to)) {
      const double length = (place_of(v) - query.goal).norm();
      states_[number(v)].to_goal = length;
      for (std::size_t k = 0; k < Landmarks::kCount; ++k)
        goal_lengths_[k] = std::min(goal_lengths_[k], taut.landmarks.lengths[number(v)][k] + length);
    }
    for (const VertexId v : taut.seen_from(query.from))
      push(v, (place_of(v) - query.start).norm(), Step::kFromStart);
  }

  std::optional<TautRoute> run() {
    while (!open_.empty()) {
      const OpenEntry entry = open_.top();
      open_.pop();
      CornerState& state = states_[number(entry.corner)];
      if (entry.step == Step::kToGoal) {
        if (space_.is_free(place_of(entry.corner), query_.goal, query_.radius))
          return route_to(entry.corner);
        continue;
      }
      if (state.closed || entry.cost > state.cost) continue;
      if (entry.step == Step::kFromStart) {
        if (entry.cost == state.cost ||
            !space_.is_free(query_.start, place_of(entry.corner), query_.radius))
          continue;
        state.cost = entry.cost;
        state.from = kNoVertex;
      }
      state.closed = true;
      if (state.to_goal < kFar)
        open_.push({entry.cost + state.to_goal, entry.cost, entry.corner, Step::kToGoal});
      leave(entry.corner);
    }
    return std::nullopt;
  }

 private:
  const Point& place_of(VertexId v) const { return taut_.graph.vertices[number(v)].position; }

  void leave(VertexId corner) {
    const double cost = states_[number(corner)].cost;
    for (const Link& link : taut_.graph.links_of(corner)) {
      const double next = cost + taut_.graph.edges[number(link.edge)].length;
      CornerState& state = states_[number(link.vertex)];
      if (next >= state.cost) continue;
      state.cost = next;
      state.from = corner;
      push(link.vertex, next, Step::kAlong);
    }
  }

  void push(VertexId v, double cost, Step step) {
    double rest = (place_of(v) - query_.goal).norm();
    const auto& lengths = taut_.landmarks.lengths[number(v)];
    for (std::size_t k = 0; k < Landmarks::kCount; ++k)
      if (goal_lengths_[k] < kFar) rest = std::max(rest, std::abs(goal_lengths_[k] - lengths[k]));
    if (rest < kFar) open_.push({cost + rest, cost, v, step});
  }

  TautRoute route_to(VertexId last) const {
    TautRoute found;
    found.waypoints.push_back(query_.goal);
    for (VertexId v = last; v != kNoVertex; v = states_[number(v)].from) {
      found.waypoints.push_back(place_of(v));
      const VertexId before = states_[number(v)].from;
      if (before == kNoVertex) break;
      for (const Link& link : taut_.graph.links_of(v))
        if (link.vertex == before)
          found.known.clearance =
              std::min(found.known.clearance, taut_.graph.edges[number(link.edge)].clearance);
    }
    found.waypoints.push_back(query_.start);
    std::reverse(found.waypoints.begin(), found.waypoints.end());
    found.known.first = 1;
    found.known.last = found.waypoints.size() - 2;
    return found;
  }

  const TautGraph& taut_;
  const FreeSpace& space_;
  const RouteQuery& query_;
  std::vector<CornerState> states_;
  std::array<double, Landmarks::kCount> goal_lengths_{};  ///< at least, from each landmark
  std::priority_queue<OpenEntry> open_;
};

}  // namespace

std::optional<TautRoute> search_taut(const TautGraph& taut, const FreeSpace& space,
                                     const RouteQuery& query) {
  if (taut.seen_from(query.from).empty() || taut.seen_from(query.to).empty()) return std::nullopt;
  return TautSearch(taut, space, query).run();
}

TautPath plan_taut(const TautGraph& taut, const FreeSpace& space, const RouteQuery& query,
                   const Deadline& deadline) {
  TautPath path;
  const double began = seconds_now();
  std::optional<TautRoute> route = search_taut(taut, space, query);
  const double found = seconds_now();
  path.search_seconds = found - began;
  if (!route) return path;
  const double as_found = length_of(route->waypoints);
  path.waypoints = draw_corners_in(space, route->waypoints, query.radius, deadline);
  if (path.waypoints == route->waypoints) path.known = route->known;
  const double length = length_of(path.waypoints);
  path.is_tight = as_found <= kHardly * length ||
                  length <= kNearlyStraight * (query.goal - query.start).norm();
  path.shorten_seconds = seconds_now() - found;
  return path;
}

}  // namespace ridgeway::detail
