// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/tunnels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

namespace ridgeway {
namespace {

TEST(Tunnels, AreOneConnectedMineClosedByRock) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const OccupancyMap map =
        make_tunnels({.length = 500.0, .voxel_size = 0.5, .radius = 3.0, .seed = seed});
    const VoxelCounts counts = count_voxels(map);
    // 500 m of 3 m radius, a third more or less.
    const double volume = 0.125 * static_cast<double>(counts.free);
    EXPECT_GT(volume, 500.0 * M_PI * 4.0);
    EXPECT_LT(volume, 600.0 * M_PI * 16.0);
    const VoxelRange range = known_range(map);
    for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
      if (map.state[id] != VoxelState::kFree) continue;
      for (const VoxelIndex& step :
           {VoxelIndex{1, 0, 0}, VoxelIndex{-1, 0, 0}, VoxelIndex{0, 1, 0}, VoxelIndex{0, -1, 0},
            VoxelIndex{0, 0, 1}, VoxelIndex{0, 0, -1}})
        ASSERT_NE(map.at(map.layout.index_of(id) + step), VoxelState::kUnknown) << "a leak";
    }
    EXPECT_TRUE(range.contains({0, 0, 0}));
    const BuildResult built = build_roadmap(map, {.min_clearance = 1.0});
    EXPECT_EQ(built.report.traversable_components, 1u);
    EXPECT_GE(built.roadmap.graph.edges.size(), 4u);
  }
}

TEST(Tunnels, AreTheSameForAnyNumberOfThreads) {
  const TunnelConfig config{.length = 200.0, .voxel_size = 0.4, .seed = 7};
  const OccupancyMap one = with_threads(1, [&] { return make_tunnels(config); });
  const OccupancyMap two = with_threads(2, [&] { return make_tunnels(config); });
  EXPECT_EQ(one.origin, two.origin);
  EXPECT_TRUE(one.state.values() == two.state.values());
}

TEST(Tunnels, RefuseWhatIsNoMine) {
  for (const TunnelConfig& bad : {TunnelConfig{.length = 0.0}, TunnelConfig{.length = std::nan("")},
                                  TunnelConfig{.voxel_size = 0.0}, TunnelConfig{.voxel_size = 1.1},
                                  TunnelConfig{.radius = -1.0}, TunnelConfig{.roughness = 2.0}})
    EXPECT_THROW(make_tunnels(bad), InputError);
  EXPECT_THROW(make_tunnels({.length = 1e6, .voxel_size = 0.01}), InputError);  // memory
}

}  // namespace
}  // namespace ridgeway
