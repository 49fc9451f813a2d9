// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What holds of every roadmap that is built.
#include <gtest/gtest.h>

#include <optional>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "support/flood.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

TEST(Roadmap, EveryEdgeKeepsItsClearanceAndGraphAndTreeAreThoseOfSpace) {
  int maps = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 24);
    std::optional<BuildResult> built;
    try {
      built = build_roadmap(map, {.min_clearance = 0.1});
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    ++maps;
    const Roadmap& roadmap = built->roadmap;
    const SparseGraph& graph = roadmap.graph;
    const FreeSpace space(roadmap.esdf);
    for (const Edge& edge : graph.edges) {
      const Point& a = graph.vertices[number(edge.from)].position;
      const Point& b = graph.vertices[number(edge.to)].position;
      ASSERT_LT(edge.from, edge.to);
      ASSERT_GE(edge.clearance, 0.1 * (1 - 1e-9));
      ASSERT_NEAR(edge.clearance, space.clearance(a, b), 1e-12);
      ASSERT_NEAR(edge.length, (a - b).norm(), 1e-12);
    }
    const testing::Regions regions = testing::regions_at(roadmap.esdf, 0.1);
    EXPECT_EQ(built->report.traversable_components, regions.first.size());
    EXPECT_EQ(built->report.graph_components, regions.first.size());
    // The tree: connected at a radius exactly where flooding connects.
    for (const double radius : {0.1, 0.15, 0.2, 0.25}) {
      const testing::Regions wide = testing::regions_at(roadmap.esdf, radius);
      for (std::uint32_t i = 0; i < graph.vertices.size(); ++i) {
        const std::uint32_t j = (i * 7 + 3) % static_cast<std::uint32_t>(graph.vertices.size());
        const VoxelId vi = roadmap.esdf.layout.find(graph.vertices[i].voxel);
        const VoxelId vj = roadmap.esdf.layout.find(graph.vertices[j].voxel);
        const bool connected = wide.label.contains(vi) && wide.label.contains(vj) &&
                               wide.label.at(vi) == wide.label.at(vj);
        ASSERT_EQ(widest_way(graph, roadmap.tree, VertexId{i}, VertexId{j}) >= radius * (1 - 1e-9),
                  connected);
      }
    }
  }
  EXPECT_GE(maps, 40);
}

TEST(Roadmap, IsTheSameForAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const OccupancyMap map = testing::random_map(seed, 50);
    const auto run = [&] { return build_roadmap(map, {.min_clearance = 0.1}).roadmap; };
    const Roadmap one = with_threads(1, run), two = with_threads(2, run);
    ASSERT_EQ(one.diagram.voxels, two.diagram.voxels);
    ASSERT_EQ(one.attach.next.values(), two.attach.next.values());
    ASSERT_EQ(one.graph.edges.size(), two.graph.edges.size());
    for (std::size_t i = 0; i < one.graph.edges.size(); ++i) {
      ASSERT_EQ(one.graph.edges[i].from, two.graph.edges[i].from);
      ASSERT_EQ(one.graph.edges[i].to, two.graph.edges[i].to);
      ASSERT_EQ(one.graph.edges[i].clearance, two.graph.edges[i].clearance);
    }
    ASSERT_EQ(one.tree.parent, two.tree.parent);
  }
}

TEST(Roadmap, PaperDiagramStillAnswersExactly) {
  std::size_t maps = 0, solved = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 24);
    std::optional<Roadmap> roadmap;
    try {
      roadmap = build_roadmap(map, {.min_clearance = 0.1, .paper_diagram = true}).roadmap;
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    ++maps;
    const CheckReport report = check_roadmap(*roadmap, {.queries = 60, .seed = seed});
    EXPECT_TRUE(report.is_clean());
    EXPECT_EQ(report.queries, 60u);
    solved += report.graph_ok;
  }
  EXPECT_GE(maps, 15u);
  EXPECT_GE(solved, 200u);
}

TEST(Components, TellAtWhichRadiusAndWhereTheyWouldJoin) {
  // Two rooms joined by a window of 4 x 4 voxels: a robot of 0.2 fits, one of 0.3 does not.
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {61, 23, 23}, [](const VoxelIndex& v) {
    const bool edge = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 61 || v.y == 23 || v.z == 23;
    const bool wall = v.x == 30 || v.x == 31;
    const bool window = v.y >= 10 && v.y <= 13 && v.z >= 10 && v.z <= 13;
    return edge || (wall && !window) ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const auto report_at = [&](double radius) {
    return report_components(build_roadmap(map, {.min_clearance = radius}).roadmap);
  };
  const ComponentReport report = report_at(0.3);
  ASSERT_EQ(report.components.size(), 2u);
  EXPECT_GE(report.components[0].volume, report.components[1].volume);
  ASSERT_EQ(report.joins.size(), 1u);
  EXPECT_NEAR(report.joins[0].radius, 0.15, 1e-9);  // centres lie 0.15 m from the frame
  EXPECT_NEAR(report.joins[0].place.x(), 3.1, 0.2);
  EXPECT_EQ(report_at(0.15).components.size(), 1u);
}

}  // namespace
}  // namespace ridgeway
