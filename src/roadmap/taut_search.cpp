// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "taut_search.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "best_first.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// What an entry of the queue says of its corner.
enum class Step : std::uint8_t {
  kFromStart,  ///< seen from the start, if that segment is free
  kAlong,      ///< reached over edges
  kToGoal,     ///< sees the goal, if that segment is free
};

struct TautEntry : OpenEntry {
  Step step;
};

struct CornerState {
  double cost = kFar;
  double to_goal = kFar;  ///< length of the segment to the goal, where that is worth a look
  VertexId from = kNoVertex;
  bool closed = false;
};

class TautSearch {
 public:
  TautSearch(const SparseGraph& graph, const Landmarks& landmarks, const FreeSpace& space,
             const TautQuery& query)
      : graph_(graph),
        landmarks_(landmarks),
        space_(space),
        query_(query),
        states_(graph.vertices.size()) {
    goal_lengths_.fill(kFar);
    for (const VertexId v : query.seen_from_goal) {
      const double length = (place_of(v) - query.goal).norm();
      states_[number(v)].to_goal = length;
      for (std::size_t k = 0; k < Landmarks::kCount; ++k)
        goal_lengths_[k] = std::min(goal_lengths_[k], landmarks.lengths[number(v)][k] + length);
    }
    for (const VertexId v : query.seen_from_start)
      push(v, (place_of(v) - query.start).norm(), Step::kFromStart);
  }

  std::vector<VertexId> run() {
    while (!open_.empty()) {
      const TautEntry entry = open_.top();
      open_.pop();
      CornerState& state = states_[number(entry.vertex)];
      if (entry.step == Step::kToGoal) {
        if (space_.is_free(place_of(entry.vertex), query_.goal, query_.radius))
          return route_to(entry.vertex, states_);
        continue;
      }
      if (state.closed || entry.cost > state.cost) continue;
      if (entry.step == Step::kFromStart) {
        if (entry.cost == state.cost ||
            !space_.is_free(query_.start, place_of(entry.vertex), query_.radius))
          continue;
        state.cost = entry.cost;
        state.from = kNoVertex;
      }
      state.closed = true;
      if (state.to_goal < kFar)
        open_.push({{entry.cost + state.to_goal, entry.cost, entry.vertex}, Step::kToGoal});
      leave(entry.vertex);
    }
    return {};
  }

 private:
  const Point& place_of(VertexId v) const { return graph_.vertices[number(v)].position; }

  void leave(VertexId corner) {
    const double cost = states_[number(corner)].cost;
    for (const Link& link : graph_.links_of(corner)) {
      const double next = cost + graph_.edges[number(link.edge)].length;
      CornerState& state = states_[number(link.vertex)];
      if (next >= state.cost) continue;
      state.cost = next;
      state.from = corner;
      push(link.vertex, next, Step::kAlong);
    }
  }

  void push(VertexId v, double cost, Step step) {
    double rest = (place_of(v) - query_.goal).norm();
    const auto& lengths = landmarks_.lengths[number(v)];
    for (std::size_t k = 0; k < Landmarks::kCount; ++k)
      if (goal_lengths_[k] < kFar) rest = std::max(rest, goal_lengths_[k] - lengths[k]);
    if (rest < kFar) open_.push({{cost + rest, cost, v}, step});
  }

  const SparseGraph& graph_;
  const Landmarks& landmarks_;
  const FreeSpace& space_;
  const TautQuery& query_;
  std::vector<CornerState> states_;
  std::array<double, Landmarks::kCount> goal_lengths_{};  ///< at least, from each landmark
  std::priority_queue<TautEntry> open_;
};

}  // namespace

std::vector<VertexId> search_taut(const SparseGraph& graph, const Landmarks& landmarks,
                                  const FreeSpace& space, const TautQuery& query) {
  if (query.seen_from_start.empty() || query.seen_from_goal.empty()) return {};
  return TautSearch(graph, landmarks, space, query).run();
}

}  // namespace ridgeway::detail
