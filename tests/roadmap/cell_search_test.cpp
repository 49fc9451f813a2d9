// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap/cell_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/places.hpp"

namespace ridgeway {
namespace {

constexpr int kLength = 96, kWidth = 24;  // voxels, along x and across

/// Plates a voxel thick in open space, upright and level, all along x: they cut cells in two.
Roadmap plates(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int end) {
    return static_cast<int>(random() % static_cast<unsigned>(end));
  };
  OccupancyBuilder voxels(1.0);
  for (int z = 0; z < kWidth; ++z)
    for (int y = 0; y < kWidth; ++y)
      for (int x = 0; x < kLength; ++x) voxels.set({x, y, z}, VoxelState::kFree);
  for (int plate = 0; plate < 60; ++plate) {
    const bool is_upright = below(2) == 0;
    const int first = below(kLength - 12), at = below(kWidth), beside = below(kWidth - 12);
    for (int i = 0; i < 12; ++i)
      for (int k = 0; k < 12; ++k)
        voxels.set(is_upright ? VoxelIndex{first + i, at, beside + k}
                              : VoxelIndex{first + i, beside + k, at},
                   VoxelState::kOccupied);
  }
  Roadmap roadmap;
  roadmap.min_clearance = 0.5;
  roadmap.esdf = compute_esdf(std::move(voxels).finish());
  roadmap.cells = build_cell_graph(roadmap.esdf, roadmap.min_clearance);
  return roadmap;
}

/// Between places that moves connect, each with a way to the graph that ends where it begins.
std::vector<Point> route_between(const Roadmap& roadmap, VoxelId from, VoxelId to) {
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  detail::AttachWay out, in;
  out.voxels = {from};
  in.voxels = {to};
  const Point start = centre_of(esdf.layout.index_of(from), esdf.voxel_size);
  const Point goal = centre_of(esdf.layout.index_of(to), esdf.voxel_size);
  std::vector<Point> route =
      detail::search_cells(roadmap, space, {start, goal, out, in, roadmap.min_clearance},
                           detail::Deadline::never())
          .waypoints;
  if (route.empty()) return route;
  EXPECT_EQ(route.front(), start);
  EXPECT_EQ(route.back(), goal);
  for (std::size_t k = 1; k < route.size(); ++k)
    EXPECT_TRUE(space.is_free(route[k - 1], route[k], roadmap.min_clearance))
        << route[k - 1].transpose() << " to " << route[k].transpose();
  return route;
}

TEST(CellSearch, CrossesOpenSpaceInLongSteps) {
  int found = 0, long_steps = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = plates(seed);
    EXPECT_FALSE(roadmap.cells.nooks.empty());
    std::vector<VoxelId> near, far;
    for (const VoxelId id : testing::traversable_places(roadmap.esdf, roadmap.min_clearance)) {
      const int x = roadmap.esdf.layout.index_of(id).x;
      if (x < kLength / 4) near.push_back(id);
      if (x >= kLength - kLength / 4) far.push_back(id);
    }
    std::mt19937 random(seed);
    for (int i = 0; i < 300; ++i) {
      const std::vector<Point> route =
          route_between(roadmap, near[random() % near.size()], far[random() % far.size()]);
      if (route.empty()) continue;  // shut in, or the ends see no place of a cell
      ++found;
      double longest = 0.0;
      for (std::size_t k = 1; k < route.size(); ++k)
        longest = std::max(longest, (route[k] - route[k - 1]).norm());
      long_steps += longest > 16.0;
    }
  }
  EXPECT_GT(found, 200);
  EXPECT_GT(long_steps, found / 3);
}

}  // namespace
}  // namespace ridgeway
