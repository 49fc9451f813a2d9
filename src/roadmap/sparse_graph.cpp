// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/sparse_graph.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "voxel/disjoint_sets.hpp"

namespace ridgeway {

void index_links(SparseGraph& graph) {
  std::sort(graph.edges.begin(), graph.edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  graph.first_link.assign(graph.vertices.size() + 1, 0);
  for (const Edge& edge : graph.edges) {
    ++graph.first_link[number(edge.from) + 1];
    ++graph.first_link[number(edge.to) + 1];
  }
  std::partial_sum(graph.first_link.begin(), graph.first_link.end(), graph.first_link.begin());
  graph.links.resize(2 * graph.edges.size());
  std::vector<std::uint32_t> next(graph.first_link.begin(), graph.first_link.end() - 1);
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i) {
    const Edge& edge = graph.edges[i];
    graph.links[next[number(edge.from)]++] = {edge.to, EdgeId{i}};
    graph.links[next[number(edge.to)]++] = {edge.from, EdgeId{i}};
  }
}

GraphComponents connected_components(const SparseGraph& graph) {
  const std::size_t count = graph.vertices.size();
  DisjointSets sets(count);
  for (const Edge& edge : graph.edges)
    sets.join(static_cast<std::uint32_t>(edge.from), static_cast<std::uint32_t>(edge.to));
  GraphComponents parts;
  parts.label.resize(count);
  std::vector<std::uint32_t> label_of(count, static_cast<std::uint32_t>(count));  // by set
  for (std::uint32_t v = 0; v < count; ++v) {
    std::uint32_t& label = label_of[sets.find(v)];
    if (label == count) label = parts.count++;
    parts.label[v] = label;
  }
  return parts;
}

}  // namespace ridgeway
