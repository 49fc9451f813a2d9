// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "paths/planning_constants.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "roadmap/cell_bends.hpp"
#include "roadmap/cell_neighbours.hpp"
#include "roadmap/cell_search.hpp"
#include "roadmap/cell_walks.hpp"
#include "roadmap/open_parts.hpp"
#include "support/flood.hpp"
#include "support/pillars.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::kPillarClearance;

Roadmap roadmap_of_pillars(unsigned seed, double clearance = kPillarClearance) {
  std::vector<Eigen::Vector2d> axes;
  return build_roadmap(testing::pillars(seed, axes), {.min_clearance = clearance}).roadmap;
}

TEST(CellGraph, EveryPlaceAndEdgeKeepsItsClearance) {
  std::size_t edges = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = roadmap_of_pillars(seed);
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
      EXPECT_TRUE(space.is_free(place(cell), kPillarClearance));
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
                  kPillarClearance * detail::kRadiusLevels[width - 1]);
      }
    }
  }
  EXPECT_GT(edges, 6000u);
}

TEST(CellGraph, KnowsWhereAllEdgesAroundACellLetARadiusThrough) {
  std::size_t open = 0, closed = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const OccupancyMap map =
        testing::make_map(0.1, {0, 0, 0}, {47, 47, 47}, [&](const VoxelIndex&) {
          return random() % 3000 == 0 ? VoxelState::kOccupied : VoxelState::kFree;
        });
    const EsdfMap esdf = compute_esdf(map);
    const CellGraph graph = build_cell_graph(esdf, 0.1);
    const detail::CellLattice lattice(esdf.layout);
    const std::vector<CellGraph::Cell>& cells = graph.cells;
    for (detail::CellId cell = 0; cell < cells.size(); ++cell) {
      std::size_t least = CellGraph::kLevels;
      for (int d = 0; d < 27; ++d) {
        if (d == kCentre) continue;
        const detail::CellId next = lattice.neighbour(cell, d);
        const std::size_t width =
            next == detail::kNoCell ? 0 : detail::edge_width(cells, cell, next, d);
        least = std::min(least, width);
      }
      ASSERT_EQ(cells[cell].all_around, least);
      least > 0 ? ++open : ++closed;
    }
  }
  EXPECT_GT(open, 1000u);
  EXPECT_GT(closed, 1000u);
}

TEST(CellGraph, IsTheSameForAnyNumberOfThreads) {
  const Roadmap roadmap = roadmap_of_pillars(1);
  const auto run = [&] { return build_cell_graph(roadmap.esdf, kPillarClearance); };
  const CellGraph one = with_threads(1, run), two = with_threads(2, run);
  EXPECT_TRUE(std::equal(one.cells.begin(), one.cells.end(), two.cells.begin(), two.cells.end(),
                         [](const CellGraph::Cell& a, const CellGraph::Cell& b) {
                           return a.place == b.place && a.widths == b.widths &&
                                  a.parts == b.parts && a.all_around == b.all_around;
                         }));
  EXPECT_FALSE(one.bends.empty());
  EXPECT_TRUE(std::equal(one.bends.begin(), one.bends.end(), two.bends.begin(), two.bends.end(),
                         [](const CellGraph::Bend& a, const CellGraph::Bend& b) {
                           return a.from == b.from && a.to == b.to && a.length == b.length &&
                                  a.width == b.width;
                         }));
}

TEST(CellGraph, RoutesAreFreeAtTheirRadius) {
  int found = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = roadmap_of_pillars(seed, 0.5 * kPillarClearance);
    const EsdfMap& esdf = roadmap.esdf;
    const FreeSpace space(esdf);
    std::mt19937 random(seed);
    for (const double factor : {1.0, 1.1, 1.25, 1.4, 1.8, 2.4}) {
      const double radius = factor * roadmap.min_clearance;
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
            detail::search_cells(roadmap, space, {place(from), place(to), out, in, radius},
                                 detail::Deadline::never())
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
  EXPECT_GT(found, 400);
}

TEST(OpenParts, ConnectAllTheirVoxelsByMovesAcrossFaces) {
  int parts_seen = 0, ways = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const double radius = 0.05;
    BuildConfig config{.min_clearance = radius, .tangent_pairs = 0};
    Roadmap roadmap;
    try {
      roadmap = build_roadmap(testing::random_map(seed, 40), config).roadmap;
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    const EsdfMap& esdf = roadmap.esdf;
    const testing::Regions regions = testing::regions_at(esdf, radius);
    std::map<std::uint32_t, std::uint32_t> region_of;  // by part
    for (const VoxelId id : testing::traversable_places(esdf, radius)) {
      const std::uint32_t own = roadmap.cells.open_parts[esdf.layout.rank(id / kBlockVoxels)];
      const std::uint32_t reached = detail::open_part_of(roadmap, id);
      if (own != CellGraph::kNotOpen) EXPECT_EQ(reached, own);
      if (reached == CellGraph::kNotOpen) continue;
      ++ways;
      const auto [known, is_new] = region_of.emplace(reached, regions.label.at(id));
      parts_seen += is_new;
      ASSERT_EQ(known->second, regions.label.at(id));
    }
  }
  EXPECT_GT(parts_seen, 30);
  EXPECT_GT(ways, 10'000);
}

/// Voxels of 1 m, two fifths of them occupied: passages a voxel wide, for a robot that just fits.
Roadmap clutter(unsigned seed) {
  std::mt19937 random(seed);
  OccupancyBuilder voxels(1.0);
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        voxels.set({x, y, z}, random() % 5 < 2 ? VoxelState::kOccupied : VoxelState::kFree);
  Roadmap roadmap;
  roadmap.min_clearance = 0.5;
  roadmap.esdf = compute_esdf(std::move(voxels).finish());
  roadmap.cells = build_cell_graph(roadmap.esdf, roadmap.min_clearance);
  return roadmap;
}

/// The part at the smallest radius that moves within a voxel's cell lead to.
std::uint16_t part_around(const Roadmap& roadmap, const VoxelIndex& v) {
  const CellGraph& graph = roadmap.cells;
  const detail::CellLattice lattice(roadmap.esdf.layout);
  const detail::CellId cell = lattice.cell_of(v);
  const FreeSpace space(roadmap.esdf);
  const SquaredHalves threshold = least_clearance(roadmap.min_clearance, roadmap.esdf.voxel_size);
  const auto place = static_cast<std::uint8_t>((v.x & 3) | (v.y & 3) << 2 | (v.z & 3) << 4);
  const detail::CellMask inside =
      detail::flood(detail::bit_of(place), detail::fitting_voxels(space, cell, threshold));
  if ((inside & detail::bit_of(graph.cells[cell].place)) != 0) return graph.cells[cell].parts[0];
  for (const CellGraph::Nook& nook : graph.nooks)
    if (nook.cell == cell && (inside & detail::bit_of(nook.place)) != 0) return nook.parts[0];
  return CellGraph::kNoPart;
}

TEST(CellGraph, ConnectsWhatMovesAcrossFacesConnect) {
  std::size_t nooks = 0, moves = 0;
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = clutter(seed);
    const EsdfMap& esdf = roadmap.esdf;
    nooks += roadmap.cells.nooks.size();
    for (const VoxelId from : testing::traversable_places(esdf, roadmap.min_clearance)) {
      const VoxelIndex v = esdf.layout.index_of(from);
      const std::uint16_t part = part_around(roadmap, v);
      ASSERT_NE(part, CellGraph::kNoPart);
      for (const VoxelIndex& step : {VoxelIndex{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        const VoxelId to = esdf.layout.find(v + step);
        if (to == kNoVoxel || !esdf.is_open(to)) continue;
        ++moves;
        ASSERT_EQ(part_around(roadmap, v + step), part);
      }
    }
  }
  EXPECT_GT(nooks, 100u);
  EXPECT_GT(moves, 5000u);
}

/// Pairs of places that a level of radii lets through.
std::vector<std::pair<detail::CellId, detail::CellId>> links_at(const Roadmap& roadmap,
                                                                std::size_t level) {
  const CellGraph& graph = roadmap.cells;
  const detail::CellLattice lattice(roadmap.esdf.layout);
  std::vector<std::pair<detail::CellId, detail::CellId>> links;
  for (detail::CellId cell = 0; cell < graph.cells.size(); ++cell)
    for (int d = kCentre + 1; d < 27; ++d)
      if (const detail::CellId next = lattice.neighbour(cell, d);
          next != detail::kNoCell && detail::edge_width(graph.cells, cell, next, d) > level)
        links.emplace_back(cell, next);
  for (const CellGraph::Bend& bend : graph.bends)
    if (bend.width > level) links.emplace_back(bend.from, bend.to);
  return links;
}

TEST(CellGraph, PartsAreWhatEdgesAndBendsConnectAtEachRadius) {
  std::size_t parts = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = seed < 2 ? clutter(seed) : roadmap_of_pillars(seed);
    const CellGraph& graph = roadmap.cells;
    const auto places = static_cast<detail::CellId>(graph.cells.size() + graph.nooks.size());
    for (std::size_t level = 0; level < CellGraph::kLevels; ++level) {
      std::vector<detail::CellId> first(places);  // of those that a place is connected with
      std::iota(first.begin(), first.end(), 0u);
      const auto links = links_at(roadmap, level);
      for (bool has_changed = true; has_changed;) {
        has_changed = false;
        for (const auto& [a, b] : links) {
          if (first[a] == first[b]) continue;
          first[a] = first[b] = std::min(first[a], first[b]);
          has_changed = true;
        }
      }
      std::uint16_t next = 0;
      for (detail::CellId place = 0; place < places; ++place) {
        if (detail::number_in_cell(graph, place) == CellGraph::kNoPlace) continue;
        const auto part_of = [&](detail::CellId of) {
          return of < graph.cells.size() ? graph.cells[of].parts[level]
                                         : graph.nooks[of - graph.cells.size()].parts[level];
        };
        ASSERT_EQ(part_of(place), first[place] == place ? next++ : part_of(first[place]));
      }
      parts += next;
    }
  }
  EXPECT_GT(parts, 100u);
}

TEST(CellGraph, BendsAreMovesThatKeepTheirRadius) {
  std::size_t bends = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = seed < 2 ? clutter(seed) : roadmap_of_pillars(seed);
    const EsdfMap& esdf = roadmap.esdf;
    const FreeSpace space(esdf);
    const CellGraph& graph = roadmap.cells;
    const detail::CellLattice lattice(esdf.layout);
    const auto voxel_of = [&](detail::CellId place) {
      return lattice.voxel_at(detail::cell_of_place(graph, place),
                              detail::number_in_cell(graph, place));
    };
    for (const CellGraph::Bend& bend : graph.bends) {
      ASSERT_GE(bend.width, 1);
      const double radius = roadmap.min_clearance * detail::kRadiusLevels[bend.width - 1u];
      const std::vector<VoxelIndex> way = detail::way_over_bend(
          graph, space, bend.from, bend.to, least_clearance(radius, esdf.voxel_size));
      ASSERT_GE(way.size(), 2u);
      EXPECT_EQ(way.front(), voxel_of(bend.from));
      EXPECT_EQ(way.back(), voxel_of(bend.to));
      for (std::size_t i = 1; i < way.size(); ++i)
        EXPECT_TRUE(space.is_free(centre_of(way[i - 1], esdf.voxel_size),
                                  centre_of(way[i], esdf.voxel_size), radius));
      EXPECT_LE(bend.length, static_cast<float>(way.size() - 1));
      EXPECT_GE(bend.length * esdf.voxel_size * (1.0 + 1e-6),
                (centre_of(way.back(), esdf.voxel_size) - centre_of(way.front(), esdf.voxel_size))
                    .norm());
      ++bends;
    }
  }
  EXPECT_GT(bends, 500u);
}

TEST(CellGraph, LeadsThroughPassagesAVoxelWide) {
  const Roadmap roadmap = clutter(7);
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  const double radius = roadmap.min_clearance;
  const std::vector<VoxelId> places = testing::traversable_places(esdf, radius);
  std::mt19937 random(7);
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    const VoxelId from = places[random() % places.size()], to = places[random() % places.size()];
    const VoxelIndex a = esdf.layout.index_of(from), b = esdf.layout.index_of(to);
    if (part_around(roadmap, a) != part_around(roadmap, b)) continue;
    const Point start = centre_of(a, esdf.voxel_size), goal = centre_of(b, esdf.voxel_size);
    detail::AttachWay out, in;  // ways that stop where they begin
    out.voxels = {from};
    in.voxels = {to};
    const std::vector<Point> route =
        detail::search_cells(roadmap, space, {start, goal, out, in, radius},
                             detail::Deadline::never())
            .waypoints;
    ASSERT_FALSE(route.empty());
    EXPECT_EQ(route.front(), start);
    EXPECT_EQ(route.back(), goal);
    for (std::size_t k = 1; k < route.size(); ++k)
      EXPECT_TRUE(space.is_free(route[k - 1], route[k], radius));
    ++found;
  }
  EXPECT_GT(found, 15);
}

}  // namespace
}  // namespace ridgeway
