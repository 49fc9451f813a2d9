// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The promises of every skeleton stage on real maps: the one that comes with the project, and all
// .bt and .ot files below the folder that the environment variable RIDGEWAY_MAPS names.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/simple_point.hpp"
#include "support/betti.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;
using testing::Betti;
using testing::betti_numbers;

std::vector<fs::path> maps() {
  std::vector<fs::path> paths{fs::path(RIDGEWAY_DATA_DIR) / "fr_079.bt"};
  if (const char* folder = std::getenv("RIDGEWAY_MAPS"); folder != nullptr)
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".bt" || entry.path().extension() == ".ot")
        paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Simple voxels that end no curve.
std::vector<VoxelId> simple_voxels(const EsdfMap& esdf, const VoxelMask& voxels) {
  std::vector<VoxelId> simple;
  for (const VoxelId id : voxels.members(esdf.layout)) {
    const Cube27 cube = cube_around(esdf.layout, voxels, id);
    if (is_simple(cube) && !is_curve_end(cube)) simple.push_back(id);
  }
  return simple;
}

using Widths = std::array<std::array<SquaredHalves, 27>, 27>;

/// Widest ways between all cells of a cube of voxels over moves between them (Floyd-Warshall).
Widths widest_ways(const EsdfMap& esdf, VoxelId id, Cube27 cells) {
  const FreeSpace space(esdf);
  Widths widths{};
  for (int a = 0; a < 27; ++a)
    for (int b = 0; b < 27; ++b) {
      const VoxelIndex o = offset_of(b) - offset_of(a);
      const bool adjacent =
          a != b && std::abs(o.x) <= 1 && std::abs(o.y) <= 1 && std::abs(o.z) <= 1;
      if (!adjacent || !(cells >> a & 1) || !(cells >> b & 1)) continue;
      const VoxelId from = esdf.layout.neighbour(id, a), to = esdf.layout.neighbour(id, b);
      widths[a][b] = space.move_clearance(from, to, direction_of(o));
    }
  for (int via = 0; via < 27; ++via)
    for (int a = 0; a < 27; ++a)
      for (int b = 0; b < 27; ++b)
        widths[a][b] = std::max(widths[a][b], std::min(widths[a][via], widths[via][b]));
  return widths;
}

/// Whether a way for robots of a radius or more would get narrower without a voxel.
bool widens_a_way(const EsdfMap& esdf, const VoxelMask& voxels, VoxelId id, double radius) {
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  const Cube27 cube = cube_around(esdf.layout, voxels, id);
  const Widths with = widest_ways(esdf, id, cube);
  const Widths without = widest_ways(esdf, id, cube & ~kCentreBit);
  for (int a = 0; a < 27; ++a)
    for (int b = 0; b < a; ++b)
      if (a != kCentre && b != kCentre && with[a][b] >= threshold && without[a][b] < with[a][b])
        return true;
  return false;
}

TEST(MapTopology, EveryStageKeepsItsPromiseOnRealMaps) {
  for (const fs::path& path : maps()) {
    SCOPED_TRACE(path.string());
    const OccupancyMap map = load_map(path, {});
    const double radius = map.voxel_size > 0.15 ? 3.0 * map.voxel_size : 0.3;
    const EsdfMap esdf = compute_esdf(map, {});
    const VoxelMask traversable = traversable_voxels(esdf, radius);
    if (traversable.count() == 0) continue;  // no room for the robot, nothing to thin
    VoxelMask edges = extract_edges(esdf, compute_gvd(esdf, traversable));
    const Betti thick = betti_numbers(esdf.layout, edges);
    thin(esdf.layout, edges);
    EXPECT_EQ(betti_numbers(esdf.layout, edges), thick);
    EXPECT_TRUE(simple_voxels(esdf, edges).empty());

    Basins basins = find_basins(esdf, traversable, radius);
    const Betti space = betti_numbers(esdf.layout, traversable);
    VoxelMask open = traversable;
    join_background(esdf, open, basins.not_simple_at_first_turn);
    const Betti not_floating = betti_numbers(esdf.layout, open);
    EXPECT_EQ(not_floating, (Betti{space.b0, space.b1, 0}));
    VoxelMask kernel = compute_kernel(esdf, open, basins);
    EXPECT_EQ(betti_numbers(esdf.layout, kernel), not_floating);
    open_shells(esdf, kernel, significant_peaks(esdf, basins, open));
    const Betti opened = betti_numbers(esdf.layout, kernel);
    EXPECT_EQ(opened.b0, space.b0);
    EXPECT_EQ(opened.b2, 0);
    EXPECT_GE(opened.b1, space.b1);

    const VoxelMask diagram = join_diagram(esdf, edges, kernel, radius, basins);
    const Betti joined = betti_numbers(esdf.layout, diagram);
    std::size_t peaks = 0, needed = 0;
    for (const VoxelId id : simple_voxels(esdf, diagram)) {
      if (basins.next[id] == kCentre) {
        ++peaks;
      } else {
        EXPECT_TRUE(widens_a_way(esdf, diagram, id, radius));
        ++needed;
      }
    }
    std::cout << path.filename().string() << ": space " << space << ", thick edges " << thick
              << ", opened " << opened << ", diagram " << joined << " of " << diagram.count()
              << " voxels; simple but kept: " << peaks << " peaks, " << needed
              << " that moves past them are narrower than\n";
    EXPECT_EQ(joined.b0, space.b0);
    EXPECT_GE(joined.b1, space.b1);
    EXPECT_EQ(joined.b2, 0);
  }
}

}  // namespace
}  // namespace ridgeway
