// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/sparse_graph.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace ridgeway {
namespace {

/// Representative of a vertex's part; halves the way for later calls.
std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

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
  std::vector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Edge& edge : graph.edges) {
    const std::uint32_t a = find_root(parent, static_cast<std::uint32_t>(edge.from));
    const std::uint32_t b = find_root(parent, static_cast<std::uint32_t>(edge.to));
    parent[std::max(a, b)] = std::min(a, b);  // a root is the smallest vertex of its part
  }
  GraphComponents parts;
  parts.label.resize(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    const std::uint32_t root = find_root(parent, v);
    parts.label[v] = root == v ? parts.count++ : parts.label[root];
  }
  return parts;
}

}  // namespace ridgeway
