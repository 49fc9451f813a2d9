// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "graph_search.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace ridgeway::detail {
namespace {

/// A vertex to go on from.
struct OpenEntry {
  double estimate;  ///< cost, and what is left at least
  double cost;
  VertexId vertex;
  bool operator<(const OpenEntry& other) const {  // the queue's top is the best
    return estimate != other.estimate ? estimate > other.estimate : vertex > other.vertex;
  }
};

struct VertexState {
  double cost = std::numeric_limits<double>::infinity();
  VertexId from = kNoVertex;
};

/// A* that queues junctions alone: between them it walks, since most vertices have one way on.
class GraphSearch {
 public:
  GraphSearch(const SparseGraph& graph, const Landmarks& landmarks, VertexId start, VertexId goal,
              double radius, const std::vector<float>* penalty)
      : graph_(graph),
        landmarks_(landmarks),
        goal_(goal),
        target_(graph.vertices[number(goal)].position),
        narrowest_(radius * (1.0 - 1e-9)),
        penalty_(penalty),
        states_(graph.vertices.size()) {
    states_[number(start)].cost = 0.0;
    push(start);
  }

  std::vector<VertexId> run() {
    while (!open_.empty()) {
      const auto [estimate, cost, vertex] = open_.top();
      open_.pop();
      if (cost > states_[number(vertex)].cost) continue;  // reached for less since
      if (vertex == goal_) return route();
      for (const Link& link : graph_.links_of(vertex)) walk(vertex, link);
    }
    return {};
  }

 private:
  /// Goes along a link and on over vertices with two links, up to a junction or the goal. Stops
  /// where another way came for less: all that lies beyond is cheaper by that way too.
  void walk(VertexId from, Link link) {
    for (;;) {
      const Edge& edge = graph_.edges[number(link.edge)];
      if (edge.clearance < narrowest_) return;
      const double factor =
          penalty_ != nullptr ? static_cast<double>((*penalty_)[number(link.edge)]) : 1.0;
      const double cost = states_[number(from)].cost + edge.length * factor;
      VertexState& next = states_[number(link.vertex)];
      if (cost >= next.cost) return;
      next.cost = cost;
      next.from = from;
      const std::span<const Link> links = graph_.links_of(link.vertex);
      if (link.vertex == goal_ || links.size() > 2) return push(link.vertex);
      if (links.size() < 2) return;  // a dead end
      from = link.vertex;
      link = links[links[0].edge == link.edge ? 1 : 0];
    }
  }

  void push(VertexId vertex) {
    const double rest = std::max((graph_.vertices[number(vertex)].position - target_).norm(),
                                 length_bound(landmarks_, vertex, goal_));
    const double cost = states_[number(vertex)].cost;
    open_.push({cost + rest, cost, vertex});
  }

  std::vector<VertexId> route() const {
    std::vector<VertexId> route;
    for (VertexId v = goal_; v != kNoVertex; v = states_[number(v)].from) route.push_back(v);
    std::reverse(route.begin(), route.end());
    return route;
  }

  const SparseGraph& graph_;
  const Landmarks& landmarks_;
  const VertexId goal_;
  const Point target_;
  const double narrowest_;
  const std::vector<float>* penalty_;
  std::vector<VertexState> states_;
  std::priority_queue<OpenEntry> open_;
};

}  // namespace

std::vector<VertexId> search_graph(const SparseGraph& graph, const Landmarks& landmarks,
                                   VertexId start, VertexId goal, double radius,
                                   const std::vector<float>* penalty) {
  return GraphSearch(graph, landmarks, start, goal, radius, penalty).run();
}

EdgeId edge_between(const SparseGraph& graph, VertexId a, VertexId b) {
  for (const Link& link : graph.links_of(a))
    if (link.vertex == b) return link.edge;
  return EdgeId{0xffffffffu};
}

}  // namespace ridgeway::detail
