// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/basins.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "support/flood.hpp"
#include "support/random_maps.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

using testing::random_map;
using testing::regions_at;

constexpr double kRadii[] = {0.05, 0.1, 0.11, 0.15, 0.2, 0.25, 0.3};

/// Two labellings of voxels name the same sets.
void expect_same_partition(const std::vector<std::uint32_t>& a,
                           const std::vector<std::uint32_t>& b) {
  std::map<std::uint32_t, std::uint32_t> to_b, to_a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(to_b.try_emplace(a[i], b[i]).first->second, b[i]);
    ASSERT_EQ(to_a.try_emplace(b[i], a[i]).first->second, a[i]);
  }
}

TEST(Basins, TellExactlyWhatIsConnectedAtEveryRadius) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const EsdfMap esdf = compute_esdf(random_map(seed, 22), {.unknown = policy});
    const double smallest = kRadii[seed % 4];
    const Basins basins = find_basins(esdf, traversable_voxels(esdf, smallest), smallest);
    ASSERT_TRUE(
        std::is_sorted(basins.passes.begin(), basins.passes.end(),
                       [](const Pass& a, const Pass& b) { return a.clearance > b.clearance; }));
    for (const double radius : kRadii) {
      if (radius < smallest) continue;
      SCOPED_TRACE(std::to_string(seed) + " " + std::to_string(radius));
      const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
      DisjointSets sets(basins.peaks.size());
      for (const Pass& pass : basins.passes)
        if (pass.clearance >= threshold) sets.join(basins.basin[pass.from], basins.basin[pass.to]);
      const testing::Regions regions = regions_at(esdf, radius);
      std::vector<std::uint32_t> by_basin, by_flood;
      for (const VoxelId id : regions.voxels) {
        by_basin.push_back(sets.find(basins.basin[id]));
        by_flood.push_back(regions.label.at(id));
      }
      expect_same_partition(by_basin, by_flood);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Basins, ClimbWithoutADip) {
  std::size_t climbing = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const EsdfMap esdf = compute_esdf(random_map(seed, 22), {});
    const VoxelMask traversable = traversable_voxels(esdf, 0.05);
    const Basins basins = find_basins(esdf, traversable, 0.05);
    const FreeSpace space(esdf);
    for (const VoxelId id : traversable.members(esdf.layout)) {
      if (basins.next[id] == kCentre) continue;
      ++climbing;
      const VoxelId next = esdf.layout.neighbour(id, basins.next[id]);
      ASSERT_EQ(space.move_clearance(id, next, basins.next[id]), esdf.squared[id]);
      ASSERT_EQ(basins.basin[id], basins.basin[next]);
    }
  }
  EXPECT_GT(climbing, 0u);
}

TEST(Diagram, ConnectsWhatSpaceConnectsAndAttachesTheRest) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const double radius = seed % 2 == 0 ? 0.05 : 0.15;
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const EsdfMap esdf = compute_esdf(random_map(seed, 26), {.unknown = policy});
    const VoxelMask traversable = traversable_voxels(esdf, radius);
    VoxelMask edges = extract_edges(esdf, compute_gvd(esdf, traversable));
    thin(esdf.layout, edges);
    Basins basins = find_basins(esdf, traversable, radius);
    VoxelMask kernel = compute_kernel(esdf, traversable, basins);
    open_shells(esdf, kernel, significant_peaks(esdf, basins, traversable));
    const VoxelMask diagram = join_diagram(esdf, edges, kernel, radius, basins);
    // One piece of the diagram, by legal moves, in each region of space.
    const testing::Regions space = regions_at(esdf, radius);
    const testing::Regions pieces = regions_at(esdf, radius, &diagram);
    std::set<std::uint32_t> met;
    for (const VoxelId id : pieces.voxels) {
      if (pieces.first[pieces.label.at(id)] != id) continue;
      ASSERT_TRUE(met.insert(space.label.at(id)).second) << "two pieces in one region";
    }
    ASSERT_EQ(met.size(), space.first.size());
    // Every way leads to the diagram by legal moves.
    const FreeSpace free_space(esdf);
    for (VoxelId id : space.voxels)
      for (int steps = 0; !diagram.test(id); ++steps) {
        ASSERT_LT(steps, 10000);
        const int d = basins.next[id];
        ASSERT_NE(d, kCentre);
        const VoxelId next = esdf.layout.neighbour(id, d);
        ASSERT_TRUE(free_space.move_is_free(id, next, d, least_clearance(radius, esdf.voxel_size)));
        id = next;
      }
  }
}

TEST(Diagram, IsTheSameForAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const EsdfMap esdf = compute_esdf(random_map(seed, 50), {});
    const auto run = [&] {
      const VoxelMask traversable = traversable_voxels(esdf, 0.05);
      VoxelMask edges = extract_edges(esdf, compute_gvd(esdf, traversable));
      thin(esdf.layout, edges);
      Basins basins = find_basins(esdf, traversable, 0.05);
      const VoxelMask kernel = compute_kernel(esdf, traversable, basins);
      const VoxelMask diagram = join_diagram(esdf, edges, kernel, 0.05, basins);
      return std::pair(diagram, basins.next.values());
    };
    ASSERT_EQ(with_threads(1, run), with_threads(2, run));
  }
}

}  // namespace
}  // namespace ridgeway
