// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/sparse_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace ridgeway {
namespace {

SparseGraph random_graph(std::uint32_t vertices, std::size_t tries, std::uint32_t seed) {
  SparseGraph graph;
  graph.vertices.resize(vertices);
  std::mt19937 random(seed);
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (std::size_t i = 0; i < tries; ++i) {
    const auto a = static_cast<std::uint32_t>(random() % vertices);
    const auto b = static_cast<std::uint32_t>(random() % vertices);
    if (a == b || !taken.insert(std::minmax(a, b)).second) continue;
    graph.edges.push_back({VertexId{std::min(a, b)}, VertexId{std::max(a, b)}, 1.0 + a, 0.5});
  }
  return graph;
}

/// Labels by flooding along the links from each vertex in turn.
std::vector<std::uint32_t> flood_labels(const SparseGraph& graph) {
  std::vector<std::uint32_t> label(graph.vertices.size(), 0xffffffffu);
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < label.size(); ++seed) {
    if (label[seed] != 0xffffffffu) continue;
    std::vector<std::uint32_t> open = {seed};
    label[seed] = count;
    while (!open.empty()) {
      const VertexId v{open.back()};
      open.pop_back();
      for (const Link& link : graph.links_of(v)) {
        if (label[number(link.vertex)] != 0xffffffffu) continue;
        label[number(link.vertex)] = count;
        open.push_back(static_cast<std::uint32_t>(link.vertex));
      }
    }
    ++count;
  }
  return label;
}

TEST(SparseGraph, EveryEdgeIsLinkedFromBothEnds) {
  SparseGraph graph = random_graph(50, 120, 1);
  const std::size_t edges = graph.edges.size();
  index_links(graph);
  ASSERT_EQ(graph.edges.size(), edges);
  ASSERT_EQ(graph.first_link.size(), 51u);
  ASSERT_EQ(graph.links.size(), 2 * edges);
  EXPECT_EQ(graph.first_link.back(), graph.links.size());
  std::vector<int> seen(edges, 0);
  for (std::uint32_t v = 0; v < 50; ++v) {
    for (const Link& link : graph.links_of(VertexId{v})) {
      const Edge& edge = graph.edges[number(link.edge)];
      EXPECT_TRUE((edge.from == VertexId{v} && edge.to == link.vertex) ||
                  (edge.to == VertexId{v} && edge.from == link.vertex));
      ++seen[number(link.edge)];
    }
  }
  for (const int times : seen) EXPECT_EQ(times, 2);
}

TEST(SparseGraph, EdgesEndUpSorted) {
  SparseGraph graph = random_graph(40, 100, 2);
  index_links(graph);
  for (std::size_t i = 1; i < graph.edges.size(); ++i) {
    const Edge &a = graph.edges[i - 1], &b = graph.edges[i];
    EXPECT_TRUE(a.from < b.from || (a.from == b.from && a.to < b.to));
  }
}

TEST(SparseGraph, NoVerticesIsFine) {
  SparseGraph graph;
  index_links(graph);
  EXPECT_EQ(graph.first_link.size(), 1u);
  EXPECT_TRUE(graph.links.empty());
  EXPECT_EQ(connected_components(graph).count, 0u);
}

TEST(SparseGraph, ComponentsAreThoseOfAFlood) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SparseGraph graph = random_graph(60, 20 + 2 * seed, seed);
    const GraphComponents unsorted = connected_components(graph);
    index_links(graph);
    const GraphComponents parts = connected_components(graph);
    const std::vector<std::uint32_t> expected = flood_labels(graph);
    EXPECT_EQ(parts.label, expected);
    EXPECT_EQ(unsorted.label, expected);
    EXPECT_EQ(parts.count, *std::max_element(expected.begin(), expected.end()) + 1);
  }
}

}  // namespace
}  // namespace ridgeway
