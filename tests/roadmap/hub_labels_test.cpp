// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "ridgeway/roadmap/tangent_graph.hpp"
#include "roadmap/bounded_hub_labels.hpp"
#include "support/dijkstra.hpp"

namespace ridgeway {
namespace {

constexpr double kNotLinked = std::numeric_limits<double>::infinity();

/// Places at random, about as many edges as `degree` says; often in several parts. Lengths are
/// straight, whole numbers (many ways as short as another) or 1.
SparseGraph graph_of_degree(unsigned seed, std::uint32_t vertices, double degree) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, 10.0), chance(0.0, 1.0);
  SparseGraph graph;
  for (std::uint32_t v = 0; v < vertices; ++v)
    graph.vertices.push_back({{}, {place(random), place(random), place(random)}, 1.0});
  for (std::uint32_t a = 0; a < vertices; ++a)
    for (std::uint32_t b = a + 1; b < vertices; ++b) {
      if (chance(random) * vertices > degree) continue;
      const double straight = (graph.vertices[a].position - graph.vertices[b].position).norm();
      const double length = seed % 3 == 0 ? straight : seed % 3 == 1 ? std::ceil(straight) : 1.0;
      graph.edges.push_back({VertexId{a}, VertexId{b}, length, 1.0});
    }
  index_links(graph);
  return graph;
}

struct Shared {
  double length = kNotLinked;
  std::uint32_t hub = 0;
};

Shared shared_hub(const HubLabels& hubs, VertexId a, VertexId b) {
  Shared best;
  for (const HubLabel& from : hubs.of(a))
    for (const HubLabel& to : hubs.of(b)) {
      const double length = static_cast<double>(from.length) + static_cast<double>(to.length);
      if (from.hub == to.hub && length < best.length) best = {length, from.hub};
    }
  return best;
}

double length_along(const SparseGraph& graph, const std::vector<VertexId>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    double edge_length = kNotLinked;
    for (const Link& link : graph.links_of(way[i - 1]))
      if (link.vertex == way[i]) edge_length = graph.edges[number(link.edge)].length;
    length += edge_length;
  }
  return length;
}

TEST(HubLabels, GiveTheShortestLengthsAndWays) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const SparseGraph graph = graph_of_degree(seed, 60, 0.5 + 0.25 * (seed % 10));
    const HubLabels hubs = label_hubs(graph);
    for (std::uint32_t a = 0; a < graph.vertices.size(); ++a) {
      const auto lengths = testing::dijkstra_graph(graph, VertexId{a}, 0.5);
      const auto labels = hubs.of(VertexId{a});
      EXPECT_TRUE(std::is_sorted(labels.begin(), labels.end(),
                                 [](const auto& l, const auto& r) { return l.hub < r.hub; }));
      for (std::uint32_t b = 0; b < graph.vertices.size(); ++b) {
        const Shared shared = shared_hub(hubs, VertexId{a}, VertexId{b});
        if (!lengths.contains(VertexId{b})) {
          ASSERT_EQ(shared.length, kNotLinked);
          continue;
        }
        const double length = lengths.at(VertexId{b});
        ASSERT_NEAR(shared.length, length, 1e-6 * length);
        std::vector<VertexId> way = way_to_hub(hubs, VertexId{a}, shared.hub);
        const std::vector<VertexId> back = way_to_hub(hubs, VertexId{b}, shared.hub);
        ASSERT_EQ(way.front(), VertexId{a});
        ASSERT_EQ(way.back(), back.back());
        way.insert(way.end(), back.rbegin() + 1, back.rend());
        ASSERT_EQ(way.back(), VertexId{b});
        ASSERT_NEAR(length_along(graph, way), length, 1e-6 * length);
      }
    }
  }
}

TEST(HubLabels, AreFewOnALongChain) {
  SparseGraph chain;
  for (std::uint32_t v = 0; v < 256; ++v) chain.vertices.push_back({{}, {1.0 * v, 0.0, 0.0}, 1.0});
  for (std::uint32_t v = 1; v < 256; ++v)
    chain.edges.push_back({VertexId{v - 1}, VertexId{v}, 1.0, 1.0});
  index_links(chain);
  EXPECT_LT(label_hubs(chain).labels.size(), 256u * 32u);  // without pruning 256 each
}

/// Any two places joined by a straight edge: no way passes a third one, and nothing is pruned.
TEST(HubLabels, AreGivenUpWhereTheyWouldTakeTooLong) {
  constexpr std::uint32_t kCount = 300;
  SparseGraph graph;
  for (std::uint32_t v = 0; v < kCount; ++v)
    graph.vertices.push_back({{}, {std::cos(0.01 * v), std::sin(0.01 * v), 0.0}, 1.0});
  for (std::uint32_t a = 0; a < kCount; ++a)
    for (std::uint32_t b = a + 1; b < kCount; ++b)
      graph.edges.push_back({VertexId{a}, VertexId{b},
                             (graph.vertices[a].position - graph.vertices[b].position).norm(),
                             1.0});
  index_links(graph);
  EXPECT_EQ(label_hubs(graph).labels.size(), kCount * (kCount + 1) / 2);
  EXPECT_TRUE(detail::label_hubs_within(graph));
  EXPECT_FALSE(detail::label_hubs_within(graph, 1'000'000));
}

TEST(HubLabels, OfNothingAreNone) {
  SparseGraph graph;
  index_links(graph);
  EXPECT_TRUE(label_hubs(graph).labels.empty());
}

}  // namespace
}  // namespace ridgeway
