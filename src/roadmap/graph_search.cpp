// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "graph_search.hpp"

#include <algorithm>
#include <limits>

#include "best_first_search.hpp"
#include "common/rounding.hpp"

namespace ridgeway::detail {
namespace {

/// The cost of a way to a vertex, and of one over it to the goal at least.
struct Estimate {
  double whole, cost;
  bool operator<(const Estimate& other) const { return whole < other.whole; }
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
        narrowest_(detail::least_fit(radius)),
        penalty_(penalty),
        search_(graph.vertices.size(), std::numeric_limits<double>::infinity()) {
    search_.improve(start, 0.0, start);
    enqueue(start);
  }

  std::vector<VertexId> run() {
    bool found = false;
    search_.run([&](VertexId v) {
      found = v == goal_;
      if (found) return false;
      for (const Link& link : graph_.links_of(v)) walk(v, link);
      return true;
    });
    return found ? search_.way_to(goal_) : std::vector<VertexId>{};
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
      const double cost = search_.cost(from) + edge.length * factor;
      if (!search_.improve(link.vertex, cost, from)) return;
      const std::span<const Link> links = graph_.links_of(link.vertex);
      if (link.vertex == goal_ || links.size() > 2) return enqueue(link.vertex);
      if (links.size() < 2) return;  // a dead end
      from = link.vertex;
      link = links[links[0].edge == link.edge ? 1 : 0];
    }
  }

  void enqueue(VertexId vertex) {
    const double rest = std::max((graph_.vertices[number(vertex)].position - target_).norm(),
                                 length_bound(landmarks_, vertex, goal_));
    const double cost = search_.cost(vertex);
    search_.enqueue(vertex, {cost + rest, cost});
  }

  const SparseGraph& graph_;
  const Landmarks& landmarks_;
  const VertexId goal_;
  const Point target_;
  const double narrowest_;
  const std::vector<float>* penalty_;
  BestFirstSearch<VertexId, double, Estimate> search_;
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
