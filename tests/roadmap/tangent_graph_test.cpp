// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/tangent_graph.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "roadmap/attach_way.hpp"
#include "roadmap/corner_regions.hpp"
#include "roadmap/tangent_search.hpp"
#include "support/dijkstra.hpp"
#include "support/pillars.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::kPillarClearance;
constexpr unsigned kSeeds = 10;

Roadmap pillar_roadmap(unsigned seed, std::size_t tangent_pairs = 2000) {
  std::vector<Eigen::Vector2d> axes;
  BuildConfig config;
  config.min_clearance = kPillarClearance;
  config.tangent_pairs = tangent_pairs;
  return build_roadmap(testing::pillars(seed, axes), config).roadmap;
}

TEST(TangentGraph, KeepsItsContract) {
  std::size_t corners = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = pillar_roadmap(seed);
    const EsdfMap& esdf = roadmap.esdf;
    const FreeSpace space(esdf);
    const SparseGraph& graph = roadmap.tangents.graph;
    corners += graph.vertices.size();
    for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
      const Vertex& corner = graph.vertices[i];
      const VoxelId id = esdf.layout.find(corner.voxel);
      ASSERT_NE(id, kNoVoxel);
      EXPECT_EQ(corner.position, centre_of(corner.voxel, esdf.voxel_size));
      EXPECT_EQ(corner.clearance, esdf.distance(id));
      EXPECT_GE(corner.clearance, kPillarClearance * (1.0 - 1e-9));
      if (i > 0) {
        EXPECT_LT(esdf.layout.find(graph.vertices[i - 1].voxel), id);
      }
    }
    for (const Edge& edge : graph.edges) {
      const Point& from = graph.vertices[number(edge.from)].position;
      const Point& to = graph.vertices[number(edge.to)].position;
      EXPECT_DOUBLE_EQ(edge.length, (to - from).norm());
      EXPECT_EQ(edge.clearance, space.clearance(from, to));
      EXPECT_GE(edge.clearance, kPillarClearance * (1.0 - 1e-9));
    }
  }
  EXPECT_GT(corners, 20 * kSeeds);
}

TEST(TangentGraph, IsTheSameForAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto run = [&] { return pillar_roadmap(seed).tangents; };
    const TangentGraph one = with_threads(1, run), two = with_threads(2, run);
    EXPECT_EQ(one.first_seen, two.first_seen);
    EXPECT_EQ(one.seen, two.seen);
    EXPECT_EQ(one.hubs.labels, two.hubs.labels);
    ASSERT_EQ(one.graph.vertices.size(), two.graph.vertices.size());
    ASSERT_EQ(one.graph.edges.size(), two.graph.edges.size());
    for (std::size_t i = 0; i < one.graph.vertices.size(); ++i)
      EXPECT_EQ(one.graph.vertices[i].voxel, two.graph.vertices[i].voxel);
    for (std::size_t i = 0; i < one.graph.edges.size(); ++i) {
      EXPECT_EQ(one.graph.edges[i].from, two.graph.edges[i].from);
      EXPECT_EQ(one.graph.edges[i].to, two.graph.edges[i].to);
      EXPECT_EQ(one.graph.edges[i].clearance, two.graph.edges[i].clearance);
    }
  }
}

TEST(TangentGraph, IsEmptyWhereItIsNotWantedOrCannotBeLearnt) {
  for (const std::size_t pairs : {std::size_t{0}, std::size_t{300}}) {
    const TangentGraph tangents = pillar_roadmap(1, pairs).tangents;
    EXPECT_TRUE(tangents.graph.vertices.empty());
    EXPECT_TRUE(tangents.seen_from(0).empty());
  }
}

/// Length of the shortest route over corners by Bellman and Ford from every corner that the start
/// sees; infinite where there is none.
double shortest_by_force(const TangentGraph& tangents, const FreeSpace& space,
                         const detail::TangentQuery& q) {
  double best = std::numeric_limits<double>::infinity();
  for (const VertexId first : q.seen_from_start) {
    const Point& near_start = tangents.graph.vertices[number(first)].position;
    if (!space.is_free(q.start, near_start, q.radius)) continue;
    const auto lengths = testing::dijkstra_graph(tangents.graph, first, q.radius);
    for (const VertexId last : q.seen_from_goal) {
      const Point& near_goal = tangents.graph.vertices[number(last)].position;
      if (!lengths.contains(last) || !space.is_free(near_goal, q.goal, q.radius)) continue;
      best = std::min(
          best, (near_start - q.start).norm() + lengths.at(last) + (q.goal - near_goal).norm());
    }
  }
  return best;
}

TEST(TangentGraph, SearchFindsTheShortestRoute) {
  int found = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = pillar_roadmap(seed);
    const FreeSpace space(roadmap.esdf);
    const std::vector<VoxelId> places = testing::traversable_places(roadmap.esdf, kPillarClearance);
    std::mt19937 random(seed);
    for (int i = 0; i < 20; ++i) {
      const VoxelId from = places[random() % places.size()], to = places[random() % places.size()];
      const auto place = [&](VoxelId id) {
        return centre_of(roadmap.esdf.layout.index_of(id), roadmap.esdf.voxel_size);
      };
      const detail::TangentQuery query{place(from), place(to), kPillarClearance,
                                       roadmap.tangents.seen_from(from),
                                       roadmap.tangents.seen_from(to)};
      const std::vector<VertexId> route =
          detail::search_tangents(roadmap.tangents.graph, roadmap.tangents.hubs, space, query);
      const double shortest = shortest_by_force(roadmap.tangents, space, query);
      ASSERT_EQ(route.empty(), std::isinf(shortest));
      if (route.empty()) continue;
      ++found;
      std::vector<Point> path{query.start};
      for (const VertexId v : route)
        path.push_back(roadmap.tangents.graph.vertices[number(v)].position);
      path.push_back(query.goal);
      double length = 0.0;
      for (std::size_t k = 1; k < path.size(); ++k) {
        EXPECT_TRUE(space.is_free(path[k - 1], path[k], kPillarClearance));
        length += (path[k] - path[k - 1]).norm();
      }
      EXPECT_NEAR(length, shortest, 1e-6 * shortest);  // its lengths are floats
    }
  }
  EXPECT_GT(found, 100);
}

/// By the definition: the way of every voxel is followed to its end.
std::vector<detail::Part> plain_parts_of_regions(const Roadmap& roadmap,
                                                 const BlockRegions& regions) {
  const BlockLayout& layout = roadmap.esdf.layout;
  const VoxelField<Direction>& next = roadmap.attach.next;
  const GraphComponents parts = connected_components(roadmap.graph);
  std::vector<std::set<std::uint32_t>> met(regions.count);
  for (VoxelId start = 0; start < next.size(); ++start) {
    if (next[start] == AttachField::kNotTraversable) continue;
    VoxelId id = start;
    while (next[id] != AttachField::kHere) id = layout.neighbour(id, next[id]);
    const VertexId vertex = detail::vertex_at(roadmap.graph, layout.index_of(id));
    met[regions.region_of_block[start / kBlockVoxels]].insert(
        vertex == kNoVertex ? detail::kNoPart : parts.label[number(vertex)]);
  }
  std::vector<detail::Part> result;
  result.reserve(met.size());
  for (const std::set<std::uint32_t>& labels : met)
    result.push_back(labels.size() == 1 ? static_cast<detail::Part>(*labels.begin())
                                        : detail::kNoPart);
  return result;
}

TEST(TangentGraph, RegionsKnowTheOnePartThatAllTheirWaysLeadTo) {
  std::size_t of_one_part = 0, of_several = 0, mixed = 0;
  const auto expect_as_plain = [&](const Roadmap& roadmap) {
    const BlockRegions regions = number_regions(roadmap.esdf.layout);
    const std::vector<detail::Part> expected = plain_parts_of_regions(roadmap, regions),
                                    found = detail::parts_of_regions(
                                        roadmap, regions.region_of_block, regions.count);
    ASSERT_EQ(found.size(), expected.size());
    std::vector<char> has_way(regions.count);
    for (VoxelId id = 0; id < roadmap.attach.next.size(); ++id)
      if (roadmap.attach.next[id] != AttachField::kNotTraversable)
        has_way[regions.region_of_block[id / kBlockVoxels]] = 1;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (has_way[i] == 0) continue;
      EXPECT_EQ(found[i], expected[i]) << i;
      mixed += expected[i] == detail::kNoPart;
    }
    (connected_components(roadmap.graph).count == 1 ? of_one_part : of_several) += 1;
  };
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    expect_as_plain(pillar_roadmap(seed, 0));
    expect_as_plain(
        build_roadmap(testing::random_map(seed, 24), {.min_clearance = 0.1, .tangent_pairs = 0})
            .roadmap);
  }
  EXPECT_GE(of_one_part, kSeeds / 2);  // both ways of finding them are asked
  EXPECT_GE(of_several, kSeeds / 2);
  EXPECT_GT(mixed, 0u);
}

}  // namespace
}  // namespace ridgeway
