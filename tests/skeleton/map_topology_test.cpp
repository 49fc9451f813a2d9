// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The promises of every skeleton stage on real maps: the one that comes with the project, and all
// .bt and .ot files below the folder that the environment variable RIDGEWAY_MAPS names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/io/load_map.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "ridgeway/skeleton/kernel.hpp"
#include "ridgeway/skeleton/simple_point.hpp"
#include "ridgeway/skeleton/thinning.hpp"
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

/// Simple voxels that end no curve: none are left but those that a legal move needs.
std::size_t removable_voxels(const EsdfMap& esdf, const VoxelMask& voxels) {
  std::size_t removable = 0;
  for (const VoxelId id : voxels.members()) {
    const Cube27 cube = cube_around(esdf.layout, voxels, id);
    removable += is_simple(cube) && !is_curve_end(cube);
  }
  return removable;
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
    EXPECT_EQ(removable_voxels(esdf, edges), 0u);

    Basins basins = find_basins(esdf, traversable, radius);
    VoxelMask kernel = compute_kernel(esdf, traversable, basins);
    const Betti space = betti_numbers(esdf.layout, traversable);
    EXPECT_EQ(betti_numbers(esdf.layout, kernel), space);
    open_shells(esdf, kernel, significant_peaks(esdf, basins));
    const Betti opened = betti_numbers(esdf.layout, kernel);
    EXPECT_EQ(opened.b0, space.b0);
    EXPECT_EQ(opened.b2, 0);
    EXPECT_GE(opened.b1, space.b1);

    const VoxelMask diagram = join_diagram(esdf, edges, kernel, radius, basins);
    const Betti joined = betti_numbers(esdf.layout, diagram);
    std::cout << path.filename().string() << ": space " << space << ", thick edges " << thick
              << ", opened " << opened << ", diagram " << joined << ", "
              << removable_voxels(esdf, diagram) << " of " << diagram.count()
              << " voxels kept for legal moves alone\n";
    EXPECT_EQ(joined.b0, space.b0);
    EXPECT_GE(joined.b1, space.b1);
    EXPECT_EQ(joined.b2, 0);
  }
}

}  // namespace
}  // namespace ridgeway
