// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <limits>

#include "best_first_search.hpp"
#include "bounded_hub_labels.hpp"
#include "ridgeway/roadmap/tangent_graph.hpp"

namespace ridgeway {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-12;
constexpr std::size_t kSampledTrees = 32;  // that show through which vertices most ways pass

/// Dijkstra from one vertex after the other, with memory taken once.
class ShortestTrees {
 public:
  explicit ShortestTrees(const SparseGraph& graph)
      : graph_(graph), search_(graph.vertices.size(), kFar) {}

  /// Calls reach(vertex, parent, length) for each vertex in the order of its length; goes on from
  /// it where that returns true.
  template <typename Reach>
  void grow(VertexId root, const Reach& reach) {
    search_.restart();
    search_.offer(root, 0.0, root);
    search_.run([&](VertexId v) {
      const double length = search_.cost(v);
      if (!reach(v, search_.from(v), length)) return true;
      const std::span<const Link> links = graph_.links_of(v);
      steps_ += links.size();
      for (const Link& link : links)
        search_.offer(link.vertex, length + graph_.edges[number(link.edge)].length, v);
      return true;
    });
  }

  /// Links followed, by all trees so far.
  std::size_t steps() const { return steps_; }

 private:
  const SparseGraph& graph_;
  detail::BestFirstSearch<VertexId, double> search_;
  std::size_t steps_ = 0;
};

/// A label in the making.
struct Way {
  std::uint32_t hub;
  VertexId next;
  double length;
};

/// All vertices, those first that most shortest ways from some of them pass.
std::vector<VertexId> by_importance(const SparseGraph& graph, ShortestTrees& trees) {
  const std::size_t count = graph.vertices.size();
  std::vector<std::size_t> passed(count, 0), beyond(count);
  const std::size_t step = std::max<std::size_t>(count / kSampledTrees, 1);
  for (std::size_t root = 0; root < count; root += step) {
    std::vector<std::pair<VertexId, VertexId>> tree;  // with parents, roots first
    trees.grow(VertexId{static_cast<std::uint32_t>(root)},
               [&](VertexId v, VertexId parent, double) {
                 tree.emplace_back(v, parent);
                 return true;
               });
    std::fill(beyond.begin(), beyond.end(), 1);
    std::reverse(tree.begin(), tree.end());
    for (const auto& [v, parent] : tree) {
      passed[number(v)] += beyond[number(v)];
      if (parent != v) beyond[number(parent)] += beyond[number(v)];
    }
  }
  std::vector<VertexId> order(count);
  for (std::uint32_t v = 0; v < count; ++v) order[v] = VertexId{v};
  std::stable_sort(order.begin(), order.end(),
                   [&](VertexId a, VertexId b) { return passed[number(a)] > passed[number(b)]; });
  return order;
}

}  // namespace

std::optional<HubLabels> detail::label_hubs_within(const SparseGraph& graph,
                                                   std::size_t most_steps) {
  ShortestTrees trees(graph);
  const std::vector<VertexId> order = by_importance(graph, trees);
  std::vector<std::vector<Way>> ways(order.size());
  std::vector<double> to_root(order.size(), kFar);  // by hub
  std::size_t compared = 0;
  for (std::uint32_t hub = 0; hub < order.size(); ++hub) {
    if (compared + trees.steps() > most_steps) return std::nullopt;
    const VertexId root = order[hub];
    for (const Way& way : ways[number(root)]) to_root[way.hub] = way.length;
    trees.grow(root, [&](VertexId v, VertexId parent, double length) {
      compared += ways[number(v)].size();
      for (const Way& way : ways[number(v)])
        if (way.length + to_root[way.hub] <= length * (1.0 + kRounding) && v != root) return false;
      ways[number(v)].push_back({hub, parent, length});
      return true;
    });
    for (const Way& way : ways[number(root)]) to_root[way.hub] = kFar;
  }
  HubLabels hubs{{0}, {}, {}};
  for (const std::vector<Way>& own : ways) {
    for (const Way& way : own) {
      hubs.labels.push_back({way.hub, static_cast<float>(way.length)});
      hubs.next.push_back(way.next);
    }
    hubs.first.push_back(static_cast<std::uint32_t>(hubs.labels.size()));
  }
  return hubs;
}

HubLabels label_hubs(const SparseGraph& graph) {
  return *detail::label_hubs_within(graph, std::numeric_limits<std::size_t>::max());
}

std::vector<VertexId> way_to_hub(const HubLabels& hubs, VertexId from, std::uint32_t hub) {
  std::vector<VertexId> way{from};
  for (;;) {
    const std::span<const HubLabel> labels = hubs.of(way.back());
    const auto label = std::lower_bound(
        labels.begin(), labels.end(), hub,
        [](const HubLabel& own, std::uint32_t wanted) { return own.hub < wanted; });
    const VertexId next = hubs.next[static_cast<std::size_t>(&*label - hubs.labels.data())];
    if (next == way.back()) return way;
    way.push_back(next);
  }
}

}  // namespace ridgeway
