// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "skeleton/compute_skeleton.hpp"
#include "support/pillars.hpp"
#include "support/random_maps.hpp"
#include "support/shapes.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

using testing::kPillarClearance;

/// How often each independent cycle of a graph winds around each vertical axis: one row a cycle.
/// Every link outside a spanning forest closes one.
Eigen::MatrixXd windings(const SparseGraph& graph, const std::vector<Eigen::Vector2d>& axes) {
  const auto turn = [&](VertexId a, VertexId b) {
    return testing::turns(graph.vertices[number(a)].position, graph.vertices[number(b)].position,
                          axes);
  };
  const std::size_t count = graph.vertices.size();
  std::vector<Eigen::RowVectorXd> angle(count);  // turned on the way from the root
  std::vector<bool> used(graph.edges.size(), false);
  for (std::uint32_t root = 0; root < count; ++root) {
    if (angle[root].size() > 0) continue;
    angle[root] = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(axes.size()));
    std::vector<VertexId> stack{VertexId{root}};
    while (!stack.empty()) {
      const VertexId v = stack.back();
      stack.pop_back();
      for (const Link& link : graph.links_of(v)) {
        if (angle[number(link.vertex)].size() > 0) continue;
        used[number(link.edge)] = true;
        angle[number(link.vertex)] = angle[number(v)] + turn(v, link.vertex);
        stack.push_back(link.vertex);
      }
    }
  }
  std::vector<Eigen::RowVectorXd> cycles;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (!used[e])
      cycles.emplace_back(angle[number(edge.from)] + turn(edge.from, edge.to) -
                          angle[number(edge.to)]);
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(cycles.size()),
                       static_cast<Eigen::Index>(axes.size()));
  for (std::size_t i = 0; i < cycles.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = cycles[i];
  return rows;
}

Eigen::Index rank_of(const Eigen::MatrixXd& rows) {
  if (rows.rows() == 0) return 0;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(rows);
  lu.setThreshold(1e-6);
  return lu.rank();
}

/// Whether two vertices are connected by edges at least as wide as `radius`, for all radii.
void expect_connected_alike(const SparseGraph& before, const SparseGraph& after, double radius) {
  const auto parts_of = [&](const SparseGraph& graph) {
    DisjointSets parts(graph.vertices.size());
    for (const Edge& edge : graph.edges)
      if (edge.clearance >= radius)
        parts.join(static_cast<std::uint32_t>(edge.from), static_cast<std::uint32_t>(edge.to));
    return parts;
  };
  DisjointSets old_parts = parts_of(before), new_parts = parts_of(after);
  std::vector<std::uint32_t> old_number(after.vertices.size());
  for (std::uint32_t v = 0, w = 0; v < after.vertices.size(); ++v, ++w) {
    while (before.vertices[w].voxel != after.vertices[v].voxel) ++w;  // both in the same order
    old_number[v] = w;
  }
  for (std::uint32_t v = 0; v < after.vertices.size(); ++v)
    for (std::uint32_t w = 0; w < v; ++w)
      ASSERT_EQ(old_parts.find(old_number[v]) == old_parts.find(old_number[w]),
                new_parts.find(v) == new_parts.find(w))
          << "at radius " << radius;
}

struct Pair {
  Roadmap whole;  // its graph as fitted to the diagram
  SparseGraph simple;
};

Pair build_pair(const OccupancyMap& map, double min_clearance) {
  Pair pair{build_roadmap(map, {.min_clearance = min_clearance, .simplify = false}).roadmap, {}};
  pair.simple = simplify_graph(pair.whole.esdf, pair.whole.graph);
  return pair;
}

TEST(SimplifyGraph, EveryPillarKeepsItsWayAround) {
  std::size_t elements_before = 0, elements_after = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<Eigen::Vector2d> axes;
    const Pair pair = build_pair(testing::pillars(seed, axes), kPillarClearance);
    ASSERT_GT(axes.size(), 3u);
    EXPECT_EQ(rank_of(windings(pair.whole.graph, axes)), static_cast<Eigen::Index>(axes.size()));
    EXPECT_EQ(rank_of(windings(pair.simple, axes)), static_cast<Eigen::Index>(axes.size()));
    elements_before += pair.whole.graph.vertices.size() + pair.whole.graph.edges.size();
    elements_after += pair.simple.vertices.size() + pair.simple.edges.size();
  }
  EXPECT_LT(3 * elements_after, 2 * elements_before);
}

TEST(SimplifyGraph, EdgesKeepTheirContractAndComponentsStay) {
  int maps = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const OccupancyMap map = testing::random_map(seed, 40);
    Pair pair;
    try {
      pair = build_pair(map, 0.1);
    } catch (const InputError&) {
      continue;  // nothing is traversable
    }
    maps += !pair.simple.edges.empty();
    const FreeSpace space(pair.whole.esdf);
    for (const Edge& edge : pair.simple.edges) {
      const Point a = pair.simple.vertices[number(edge.from)].position;
      const Point b = pair.simple.vertices[number(edge.to)].position;
      EXPECT_LT(number(edge.from), number(edge.to));
      EXPECT_TRUE(space.is_free(a, b, 0.1));
      EXPECT_NEAR(edge.clearance, space.clearance(a, b), 1e-9);
      EXPECT_NEAR(edge.length, (b - a).norm(), 1e-9);
    }
    EXPECT_EQ(connected_components(pair.simple).count,
              connected_components(pair.whole.graph).count);
  }
  EXPECT_GE(maps, 30);
}

TEST(SimplifyGraph, WidthsBelowTheSmallestRadiusCountAsThat) {
  std::size_t edges = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Eigen::Vector2d> axes;
    const Pair pair = build_pair(testing::pillars(seed, axes), kPillarClearance);
    const auto simplified = [&](double widest_kept) {
      return simplify_graph(pair.whole.esdf, pair.whole.graph, {.widest_kept = widest_kept});
    };
    const SparseGraph narrow = simplified(0.2 * kPillarClearance),
                      least = simplified(kPillarClearance);
    for (const Edge& edge : narrow.edges)
      EXPECT_GE(edge.clearance, kPillarClearance * (1.0 - 1e-9));
    ASSERT_EQ(narrow.edges.size(), least.edges.size());
    for (std::size_t i = 0; i < least.edges.size(); ++i) {
      EXPECT_EQ(narrow.edges[i].from, least.edges[i].from);
      EXPECT_EQ(narrow.edges[i].to, least.edges[i].to);
    }
    edges += least.edges.size();
  }
  EXPECT_GT(edges, 100u);
}

TEST(SimplifyGraph, ConnectsAtLargerRadiiWhatItDid) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<Eigen::Vector2d> axes;
    const Pair pair = build_pair(testing::pillars(seed, axes), kPillarClearance);
    for (const double factor : {1.0, 1.25, 1.5, 1.75, 2.0})
      expect_connected_alike(pair.whole.graph, pair.simple,
                             factor * kPillarClearance * (1.0 - 1e-9));
  }
}

TEST(SimplifyGraph, LooksTheSameTheSecondTime) {
  for (const testing::Shape& shape : testing::test_shapes()) {
    const Pair pair = build_pair(shape.map(), shape.min_clearance);
    const SparseGraph again = simplify_graph(pair.whole.esdf, pair.simple);
    EXPECT_EQ(again.vertices.size(), pair.simple.vertices.size()) << shape.name;
    EXPECT_EQ(again.edges.size(), pair.simple.edges.size()) << shape.name;
  }
}

TEST(SimplifyGraph, IsTheSameForAnyNumberOfThreads) {
  constexpr double kVoxel = 0.1, kRadius = 1.2 * kVoxel;
  std::mt19937 random(1);
  const OccupancyMap map = testing::make_map(kVoxel, {0, 0, 0}, {60, 60, 20}, [&](VoxelIndex) {
    return random() % 60 == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const EsdfMap esdf = compute_esdf(map, {});
  const VoxelMask diagram = compute_skeleton(esdf, kRadius, {});
  const SparseGraph fitted = build_graph(esdf, diagram, {.min_clearance = kRadius});
  ASSERT_GT(fitted.edges.size(), 1000u);  // so that not all are asked at once
  const auto run = [&] {
    const SparseGraph graph = simplify_graph(esdf, fitted, {});
    std::vector<std::tuple<VoxelIndex, VoxelIndex, double>> edges;
    for (const Edge& edge : graph.edges)
      edges.emplace_back(graph.vertices[number(edge.from)].voxel,
                         graph.vertices[number(edge.to)].voxel, edge.clearance);
    return edges;
  };
  const auto one = with_threads(1, run);
  EXPECT_LT(one.size(), fitted.edges.size());
  EXPECT_EQ(one, with_threads(2, run));
}

}  // namespace
}  // namespace ridgeway
