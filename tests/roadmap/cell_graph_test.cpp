// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "roadmap/cell_neighbours.hpp"
#include "roadmap/cell_search.hpp"
#include "support/pillars.hpp"
#include "support/places.hpp"

namespace ridgeway {
namespace {

constexpr double kClearance = testing::kPillarClearance;

Roadmap pillar_roadmap(unsigned seed) {
  std::vector<Eigen::Vector2d> axes;
  return build_roadmap(testing::pillars(seed, axes), {.min_clearance = kClearance}).roadmap;
}

TEST(CellGraph, EveryPlaceAndEdgeKeepsItsClearance) {
  std::size_t edges = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = pillar_roadmap(seed);
    const EsdfMap& esdf = roadmap.esdf;
    const FreeSpace space(esdf);
    const detail::CellLattice lattice(esdf.layout);
    const std::vector<CellGraph::Cell>& cells = roadmap.cells.cells;
    ASSERT_EQ(cells.size(), esdf.layout.block_count() * std::size_t{CellGraph::kPerBlock});
    const auto place = [&](detail::CellId cell) {
      return centre_of(lattice.voxel_at(cell, cells[cell].place), esdf.voxel_size);
    };
    for (detail::CellId cell = 0; cell < cells.size(); ++cell) {
      EXPECT_EQ(lattice.cell_of(lattice.first_voxel(cell)), cell);
      if (cells[cell].place == CellGraph::kNoPlace) continue;
      EXPECT_EQ(lattice.cell_of(lattice.voxel_at(cell, cells[cell].place)), cell);
      EXPECT_TRUE(space.is_free(place(cell), kClearance));
      for (int d = kCentre + 1; d < 27; ++d) {
        const detail::CellId next = lattice.neighbour(cell, d);
        if (next == detail::kNoCell) continue;
        EXPECT_EQ(lattice.neighbour(next, opposite(d)), cell);
        const std::size_t width = detail::edge_width(cells, cell, next, d);
        if (width == 0) continue;
        ++edges;
        for (std::size_t level = 0; level < width; ++level)
          EXPECT_EQ(cells[cell].parts[level], cells[next].parts[level]);
        EXPECT_GE(space.clearance(place(cell), place(next)) * (1.0 + 1e-6),
                  kClearance * detail::kRadiusLevels[width - 1]);
      }
    }
  }
  EXPECT_GT(edges, 6000u);
}

TEST(CellGraph, IsTheSameForAnyNumberOfThreads) {
  const Roadmap roadmap = pillar_roadmap(1);
  const auto run = [&] { return build_cell_graph(roadmap.esdf, kClearance).cells; };
  const std::vector<CellGraph::Cell> one = with_threads(1, run), two = with_threads(2, run);
  EXPECT_TRUE(std::equal(one.begin(), one.end(), two.begin(), two.end(),
                         [](const CellGraph::Cell& a, const CellGraph::Cell& b) {
                           return a.place == b.place && a.widths == b.widths && a.parts == b.parts;
                         }));
}

TEST(CellGraph, RoutesAreFreeAtTheirRadius) {
  int found = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = pillar_roadmap(seed);
    const EsdfMap& esdf = roadmap.esdf;
    const FreeSpace space(esdf);
    std::mt19937 random(seed);
    for (const double radius : {kClearance, 1.25 * kClearance}) {
      const std::vector<VoxelId> places = testing::traversable_places(esdf, radius);
      for (int i = 0; i < 20; ++i) {
        const VoxelId from = places[random() % places.size()];
        const VoxelId to = places[random() % places.size()];
        const auto place = [&](VoxelId id) {
          return centre_of(esdf.layout.index_of(id), esdf.voxel_size);
        };
        const detail::AttachWay out = detail::follow_attach(roadmap, from, radius);
        const detail::AttachWay in = detail::follow_attach(roadmap, to, radius);
        const std::vector<Point> route =
            detail::search_cells(roadmap, space, {place(from), place(to), out, in, radius})
                .waypoints;
        if (route.empty()) continue;
        ++found;
        EXPECT_EQ(route.front(), place(from));
        EXPECT_EQ(route.back(), place(to));
        for (std::size_t k = 1; k < route.size(); ++k)
          EXPECT_TRUE(space.is_free(route[k - 1], route[k], radius));
      }
    }
  }
  EXPECT_GT(found, 150);
}

}  // namespace
}  // namespace ridgeway
