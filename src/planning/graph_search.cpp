// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "graph_search.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace ridgeway::detail {
namespace {

struct OpenEntry {
  double estimate;
  VertexId vertex;
  bool operator<(const OpenEntry& other) const {  // the queue's top is the best
    return estimate != other.estimate ? estimate > other.estimate : vertex > other.vertex;
  }
};

struct VertexState {
  double cost = std::numeric_limits<double>::infinity();
  VertexId from = kNoVertex;
  bool closed = false;
};

}  // namespace

std::vector<VertexId> search_graph(const SparseGraph& graph, VertexId start, VertexId goal,
                                   double radius, const std::vector<float>* penalty) {
  const double narrowest = radius * (1.0 - 1e-9);
  const Point target = graph.vertices[number(goal)].position;
  const auto heuristic = [&](VertexId v) {
    return (graph.vertices[number(v)].position - target).norm();
  };
  const auto is_dead_end = [&](VertexId v) { return v != goal && graph.links_of(v).size() == 1; };
  std::vector<VertexState> states(graph.vertices.size());
  std::priority_queue<OpenEntry> open;
  states[number(start)].cost = 0.0;
  open.push({heuristic(start), start});
  while (!open.empty()) {
    const VertexId vertex = open.top().vertex;
    open.pop();
    VertexState& state = states[number(vertex)];
    if (state.closed) continue;
    state.closed = true;
    if (vertex == goal) break;
    for (const Link& link : graph.links_of(vertex)) {
      const Edge& edge = graph.edges[number(link.edge)];
      if (edge.clearance < narrowest) continue;
      const double factor =
          penalty != nullptr ? static_cast<double>((*penalty)[number(link.edge)]) : 1.0;
      const double cost = state.cost + edge.length * factor;
      VertexState& next = states[number(link.vertex)];
      if (next.closed || cost >= next.cost) continue;
      if (is_dead_end(link.vertex)) continue;
      next.cost = cost;
      next.from = vertex;
      open.push({cost + heuristic(link.vertex), link.vertex});
    }
  }
  std::vector<VertexId> route;
  if (!states[number(goal)].closed) return route;
  for (VertexId v = goal; v != kNoVertex; v = states[number(v)].from) route.push_back(v);
  std::reverse(route.begin(), route.end());
  return route;
}

EdgeId edge_between(const SparseGraph& graph, VertexId a, VertexId b) {
  for (const Link& link : graph.links_of(a))
    if (link.vertex == b) return link.edge;
  return EdgeId{0xffffffffu};
}

}  // namespace ridgeway::detail
