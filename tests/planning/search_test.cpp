// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include "planning/lattice_search.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "roadmap/graph_search.hpp"
#include "support/dijkstra.hpp"
#include "support/places.hpp"
#include "support/random_limits.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::Deadline;
using detail::LatticePath;
using detail::SearchStatus;

const Deadline kNever(std::numeric_limits<double>::infinity());

/// A roadmap of a random map; nothing where the map has no room for the robot.
std::optional<Roadmap> random_roadmap(unsigned seed, double min_clearance, UnknownPolicy policy) {
  const OccupancyMap map = testing::random_map(seed, 20);
  BuildConfig config{.min_clearance = min_clearance, .unknown = policy};
  try {
    return build_roadmap(map, config).roadmap;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

double lattice_length(const EsdfMap& esdf, const std::vector<VoxelId>& voxels) {
  double length = 0.0;
  for (std::size_t i = 1; i < voxels.size(); ++i) {
    const VoxelIndex o = esdf.layout.index_of(voxels[i]) - esdf.layout.index_of(voxels[i - 1]);
    length += std::sqrt(static_cast<double>(o.x * o.x + o.y * o.y + o.z * o.z));
  }
  return length;
}

void expect_equals_dijkstra(const EsdfMap& esdf, const std::vector<VoxelId>& places, double radius,
                            const VoxelMask* within, int& routes) {
  if (places.empty()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const VoxelId start = places[k * 7919 % places.size()];
    const auto costs = testing::dijkstra_voxels(esdf, start, radius, within);
    for (std::size_t j = 0; j < 12; ++j) {
      const VoxelId goal = places[(k * 31 + j * 104729) % places.size()];
      const LatticePath path =
          detail::search_lattice(esdf, start, goal, radius, {.within = within}, kNever);
      const auto cost = costs.find(goal);
      ASSERT_EQ(path.status == SearchStatus::kFound, cost != costs.end());
      if (path.status != SearchStatus::kFound) continue;
      ++routes;
      ASSERT_NEAR(path.cost, cost->second, 1e-9);
      ASSERT_NEAR(lattice_length(esdf, path.voxels), cost->second, 1e-9);
    }
  }
}

TEST(AStar, ThroughEsdfDiagramAndGraphEqualsDijkstra) {
  int esdf_routes = 0, diagram_routes = 0, graph_routes = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const auto roadmap = random_roadmap(seed, 0.1, policy);
    if (!roadmap) continue;
    const EsdfMap& esdf = roadmap->esdf;
    for (const double radius : {0.1, 0.125, 0.2}) {
      const VoxelMask* diagram = &roadmap->diagram.voxels;
      expect_equals_dijkstra(esdf, testing::traversable_places(esdf, radius), radius, nullptr,
                             esdf_routes);
      expect_equals_dijkstra(esdf, testing::traversable_places(esdf, radius, diagram), radius,
                             diagram, diagram_routes);
      const SparseGraph& graph = roadmap->graph;
      const VertexId start{static_cast<std::uint32_t>(seed % graph.vertices.size())};
      const auto costs = testing::dijkstra_graph(graph, start, radius);
      for (std::uint32_t v = 0; v < graph.vertices.size(); ++v) {
        const auto route = detail::search_graph(graph, v % 2 ? roadmap->landmarks : Landmarks{},
                                                start, VertexId{v}, radius);
        ASSERT_EQ(!route.empty(), costs.contains(VertexId{v}));
        double length = 0.0;
        for (std::size_t i = 1; i < route.size(); ++i)
          length += graph.edges[number(detail::edge_between(graph, route[i - 1], route[i]))].length;
        if (!route.empty()) {
          ASSERT_NEAR(length, costs.at(VertexId{v}), 1e-9);
        }
        graph_routes += route.size() > 1;
      }
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(esdf_routes, 500);
  EXPECT_GT(diagram_routes, 500);
  EXPECT_GT(graph_routes, 200);
}

TEST(Landmarks, BoundTheLengthBetweenVerticesFromBelow) {
  int bounds = 0, close_bounds = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto roadmap = random_roadmap(seed, 0.1, UnknownPolicy::kObstacle);
    if (!roadmap) continue;
    const SparseGraph& graph = roadmap->graph;
    for (std::uint32_t u = 0; u < graph.vertices.size(); ++u)
      for (const auto& [v, length] : testing::dijkstra_graph(graph, VertexId{u}, 0.1)) {
        const double bound = length_bound(roadmap->landmarks, VertexId{u}, v);
        ASSERT_LE(bound, length + 1e-9);
        bounds += length > 0.0;
        close_bounds += length > 0.0 && bound > 0.9 * length;
      }
  }
  EXPECT_GT(bounds, 200);
  EXPECT_GT(close_bounds, bounds / 2);
}

TEST(AStar, WithPenaltiesEqualsDijkstraOnLongerEdges) {
  int routes = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto roadmap = random_roadmap(seed, 0.1, UnknownPolicy::kObstacle);
    if (!roadmap) continue;
    const SparseGraph& graph = roadmap->graph;
    SparseGraph longer = graph;
    std::vector<float> penalty(graph.edges.size());
    for (std::size_t e = 0; e < penalty.size(); ++e) {
      penalty[e] = 1.0f + 0.25f * static_cast<float>((e * 7 + seed) % 9);
      longer.edges[e].length *= static_cast<double>(penalty[e]);
    }
    const VertexId start{static_cast<std::uint32_t>(seed % graph.vertices.size())};
    const auto costs = testing::dijkstra_graph(longer, start, 0.1);
    for (std::uint32_t v = 0; v < graph.vertices.size(); ++v) {
      const auto route =
          detail::search_graph(graph, roadmap->landmarks, start, VertexId{v}, 0.1, &penalty);
      ASSERT_EQ(!route.empty(), costs.contains(VertexId{v}));
      double cost = 0.0;
      for (std::size_t i = 1; i < route.size(); ++i)
        cost += longer.edges[number(detail::edge_between(graph, route[i - 1], route[i]))].length;
      if (!route.empty()) {
        ASSERT_NEAR(cost, costs.at(VertexId{v}), 1e-9);
      }
      routes += route.size() > 2;
    }
  }
  EXPECT_GT(routes, 100);
}

TEST(AStar, KeepsToTheLengthOfInterest) {
  int routes = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed));
    const std::vector<VoxelId> places = testing::traversable_places(esdf, 0.1);
    if (places.empty()) continue;
    const VoxelId start = places[seed * 7919 % places.size()];
    for (std::size_t j = 0; j < 12; ++j) {
      const VoxelId goal = places[(seed * 31 + j * 104729) % places.size()];
      const LatticePath best = detail::search_lattice(esdf, start, goal, 0.1, {}, kNever);
      const auto search = [&](const detail::LatticeOptions& options) {
        return detail::search_lattice(esdf, start, goal, 0.1, options, kNever);
      };
      if (best.status != SearchStatus::kFound) continue;
      ++routes;
      ASSERT_NEAR(search({.longest = best.cost + 1e-6}).cost, best.cost, 1e-9);
      if (best.cost > 0.0) {
        ASSERT_EQ(search({.longest = best.cost - 1e-6}).status, SearchStatus::kNoRoute);
      }
    }
  }
  EXPECT_GT(routes, 200);
}

/// The voxels that moves may lead over within limits, by the test's own judgement.
VoxelMask voxels_within(const EsdfMap& esdf, const FlightLimits& limits) {
  VoxelMask within(esdf.layout);
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (testing::is_within(limits, esdf.layout.index_of(id), esdf.voxel_size)) within.set(id);
  return within;
}

struct LimitedRoutes {
  int found = 0, none = 0;
  int longer = 0;  ///< than without limits
};

/// From one place to others, and again where only what is no longer than the shortest path counts.
void expect_equals_dijkstra_within(const EsdfMap& esdf, const FlightLimits& limits, double radius,
                                   unsigned seed, LimitedRoutes& routes) {
  const VoxelMask within = voxels_within(esdf, limits);
  const std::vector<VoxelId> places = testing::traversable_places(esdf, radius, &within);
  if (places.empty()) return;
  const FreeSpace space(esdf, limits);
  const VoxelId start = places[seed * 7919 % places.size()];
  const auto costs = testing::dijkstra_voxels(esdf, start, radius, &within);
  for (std::size_t j = 0; j < 12; ++j) {
    const VoxelId goal = places[(seed * 31 + j * 104729) % places.size()];
    const auto search = [&](const FreeSpace& free, const detail::LatticeOptions& options) {
      return detail::search_lattice(free, start, goal, radius, options, kNever);
    };
    const LatticePath path = search(space, {});
    const auto cost = costs.find(goal);
    ASSERT_EQ(path.status == SearchStatus::kFound, cost != costs.end());
    if (path.status != SearchStatus::kFound) {
      ++routes.none;
      continue;
    }
    ++routes.found;
    ASSERT_NEAR(path.cost, cost->second, 1e-9);
    ASSERT_NEAR(lattice_length(esdf, path.voxels), cost->second, 1e-9);
    for (const VoxelId id : path.voxels) ASSERT_TRUE(within.test(id));
    ASSERT_NEAR(search(space, {.longest = cost->second + 1e-6}).cost, cost->second, 1e-9);
    const FlightLimits none;
    routes.longer += search(FreeSpace(esdf, none), {}).cost < cost->second - 1e-9;
  }
}

TEST(AStar, WithinLimitsOfFlightEqualsDijkstra) {
  LimitedRoutes routes;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
    std::mt19937 random(seed);
    FlightLimits limits = testing::random_limits(random, *known_bounds(map));
    for (int i = 0; i < 4; ++i)  // so many boxes that paths go round them
      for (const Box& box : testing::random_limits(random, *known_bounds(map)).keep_out)
        limits.keep_out.push_back(box);
    for (const double radius : {0.1, 0.15})
      expect_equals_dijkstra_within(esdf, limits, radius, seed, routes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(routes.found, 1000);
  EXPECT_GT(routes.none, 100);
  EXPECT_GT(routes.longer, 50);
}

TEST(AStar, StopsAtItsDeadline) {
  const auto roadmap = random_roadmap(1, 0.05, UnknownPolicy::kObstacle);
  ASSERT_TRUE(roadmap);
  const OccupancyMap map =
      testing::make_map(0.05, {0, 0, 0}, {79, 79, 79}, [](const VoxelIndex& v) {
        return v.x == 40 ? VoxelState::kOccupied : VoxelState::kFree;  // two rooms
      });
  const EsdfMap esdf = build_roadmap(map, {.min_clearance = 0.1}).roadmap.esdf;
  const LatticePath path = detail::search_lattice(
      esdf, esdf.layout.find({10, 40, 40}), esdf.layout.find({70, 40, 40}), 0.1, {}, Deadline(0.0));
  EXPECT_EQ(path.status, SearchStatus::kTimeout);
}

}  // namespace
}  // namespace ridgeway
