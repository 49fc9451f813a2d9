// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/exploration/frontiers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/random.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway {
namespace {

constexpr VoxelRange kWithin = {{-20, -20, -20}, {19, 19, 19}};

/// Free voxels of the range with an unknown one of it across a face.
std::set<VoxelIndex> brute_frontier(const EsdfMap& esdf, const std::set<VoxelIndex>& ignored) {
  std::set<VoxelIndex> frontier;
  const auto state = [&](const VoxelIndex& lattice) {
    const VoxelId id = esdf.layout.find(lattice - esdf.origin);
    return id == kNoVoxel ? VoxelState::kUnknown : esdf.state[id];
  };
  for (int z = kWithin.min.z; z <= kWithin.max.z; ++z)
    for (int y = kWithin.min.y; y <= kWithin.max.y; ++y)
      for (int x = kWithin.min.x; x <= kWithin.max.x; ++x) {
        const VoxelIndex v{x, y, z};
        if (state(v) != VoxelState::kFree) continue;
        for (int d = 0; d < 27; ++d) {
          const VoxelIndex next = v + offset_of(d);
          if (squared_length(d) == 1 && kWithin.contains(next) &&
              state(next) == VoxelState::kUnknown && !ignored.contains(next - esdf.origin))
            frontier.insert(v - esdf.origin);
        }
      }
  return frontier;
}

/// Sizes of the connected pieces of a set, of voxels for which `same` holds in pairs, ascending.
template <typename Same>
std::vector<std::size_t> piece_sizes(std::set<VoxelIndex> left, const Same& same) {
  std::vector<std::size_t> sizes;
  while (!left.empty()) {
    std::vector<VoxelIndex> stack = {*left.begin()};
    left.erase(left.begin());
    std::size_t size = 0;
    while (!stack.empty()) {
      const VoxelIndex v = stack.back();
      stack.pop_back();
      ++size;
      for (int d = 0; d < 27; ++d) {
        const VoxelIndex next = v + offset_of(d);
        if (same(v, next) && left.erase(next) > 0) stack.push_back(next);
      }
    }
    sizes.push_back(size);
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// Boxes and specks that come and go; the middle stays free.
std::vector<VoxelChange> random_changes(Random& random) {
  std::vector<VoxelChange> changes;
  const auto add = [&](const VoxelIndex& low, int side, VoxelState state) {
    for (int z = low.z; z < low.z + side; ++z)
      for (int y = low.y; y < low.y + side; ++y)
        for (int x = low.x; x < low.x + side; ++x) changes.push_back({{x, y, z}, state});
  };
  const auto place = [&] { return static_cast<int>(random.below(44)) - 22; };
  for (int i = 0; i < 4; ++i)
    add({place(), place(), place()}, 1 + static_cast<int>(random.below(9)),
        static_cast<VoxelState>(random.below(3)));
  add({-3, -3, -3}, 7, VoxelState::kFree);
  return changes;
}

TEST(Frontiers, FollowRandomChangesAsIfMadeAnew) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    LiveRoadmap live({.fusion = {.voxel_size = 0.1},
                      .build = {.min_clearance = 0.2, .max_distance = 1.0},
                      .origin = VoxelIndex{-5, 3, 7}});
    Frontiers frontiers(kWithin);
    std::set<VoxelIndex> ignored;
    for (int round = 0; round < 12; ++round) {
      live.set_voxels(random_changes(random));
      const std::shared_ptr<const Roadmap> now = live.snapshot();
      ASSERT_TRUE(now);
      frontiers.update(now);
      // By brute force.
      const std::set<VoxelIndex> expected = brute_frontier(now->esdf, ignored);
      EXPECT_EQ(frontiers.voxels(), expected.size());
      std::vector<std::size_t> parts, clusters;
      for (const FrontierPart& part : frontiers.parts()) {
        parts.push_back(part.voxels);
        EXPECT_TRUE(expected.contains(part.first));
        for (const VoxelIndex& target : part.targets) {
          const VoxelId id = now->esdf.layout.find(target);
          EXPECT_TRUE(id == kNoVoxel || now->esdf.state[id] == VoxelState::kUnknown);
        }
      }
      for (const FrontierCluster& cluster : frontiers.clusters())
        clusters.push_back(cluster.voxels);
      std::sort(parts.begin(), parts.end());
      std::sort(clusters.begin(), clusters.end());
      EXPECT_EQ(parts, piece_sizes(expected, [](const VoxelIndex& a, const VoxelIndex& b) {
                  return block_of(a) == block_of(b);
                }));
      EXPECT_EQ(clusters,
                piece_sizes(expected, [](const VoxelIndex&, const VoxelIndex&) { return true; }));
      // As from nothing, but for the update in which each part was made.
      Frontiers anew(kWithin);
      anew.ignore(std::vector<VoxelIndex>(ignored.begin(), ignored.end()));
      anew.update(now);
      ASSERT_EQ(anew.parts().size(), frontiers.parts().size());
      for (std::size_t i = 0; i < anew.parts().size(); ++i) {
        FrontierPart part = frontiers.parts()[i];
        part.version = anew.parts()[i].version;
        EXPECT_EQ(part, anew.parts()[i]);
      }
      // From the next update on.
      if (frontiers.parts().empty()) continue;
      const std::vector<VoxelIndex> vain =
          frontiers.parts()[random.below(frontiers.parts().size())].targets;
      frontiers.ignore(vain);
      ignored.insert(vain.begin(), vain.end());
    }
  }
}

TEST(Frontiers, ASquareHoleHasOneClusterThatLooksOut) {
  LiveRoadmap live({.fusion = {.voxel_size = 0.1}, .build = {.min_clearance = 0.2}});
  std::vector<VoxelChange> changes;  // a room of 12 voxels with a hole of 4 x 4 in the wall x = 12
  for (int z = -1; z <= 12; ++z)
    for (int y = -1; y <= 12; ++y)
      for (int x = -1; x <= 12; ++x) {
        const bool inside = x >= 0 && x < 12 && y >= 0 && y < 12 && z >= 0 && z < 12;
        const bool hole = x == 12 && y >= 4 && y < 8 && z >= 4 && z < 8;
        changes.push_back({{x, y, z}, inside || hole ? VoxelState::kFree : VoxelState::kOccupied});
      }
  live.set_voxels(changes);
  Frontiers frontiers;
  frontiers.update(live.snapshot());
  ASSERT_EQ(frontiers.clusters().size(), 1u);
  const FrontierCluster& cluster = frontiers.clusters()[0];
  EXPECT_EQ(cluster.voxels, 16u);
  EXPECT_NEAR((cluster.normal - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((to_world(live.snapshot()->esdf, cluster.centroid) - Point(1.25, 0.6, 0.6)).norm(),
              0.0, 1e-9);
  // What was looked at in vain is none.
  std::vector<VoxelIndex> targets;
  for (const FrontierPart& part : frontiers.parts())
    targets.insert(targets.end(), part.targets.begin(), part.targets.end());
  frontiers.ignore(targets);
  frontiers.update(live.snapshot());
  EXPECT_TRUE(frontiers.parts().empty());
  EXPECT_EQ(frontiers.ignored(), 16u);
}

/// Maps that are built again from more voxels count from another one.
TEST(Frontiers, WhatIsIgnoredStaysWhereItIsWhenTheOriginMoves) {
  const auto room_from = [](const VoxelIndex& origin) {
    LiveRoadmap live({.fusion = {.voxel_size = 0.1},
                      .build = {.min_clearance = 0.2, .max_distance = 2.0},
                      .origin = origin});
    std::vector<VoxelChange> changes;
    for (int z = 0; z < 10; ++z)
      for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x) changes.push_back({{x, y, z}, VoxelState::kFree});
    live.set_voxels(changes);
    return live.snapshot();
  };
  const auto targets_of = [](const Frontiers& frontiers, const VoxelIndex& origin) {
    std::set<VoxelIndex> targets;
    for (const FrontierPart& part : frontiers.parts())
      for (const VoxelIndex& target : part.targets) targets.insert(target + origin);
    return targets;
  };
  const VoxelIndex moved{-5, 3, 11};
  Frontiers frontiers;
  frontiers.update(room_from({}));
  const std::vector<VoxelIndex> ignored = {{-1, 4, 4}, {10, 9, 0}};
  frontiers.ignore(ignored);
  frontiers.update(room_from({}));
  const std::set<VoxelIndex> before = targets_of(frontiers, {});
  frontiers.update(room_from(moved));
  EXPECT_EQ(frontiers.ignored(), 2u);
  EXPECT_EQ(targets_of(frontiers, moved), before);
  EXPECT_EQ(before.count(ignored[0]) + before.count(ignored[1]), 0u);
}

}  // namespace
}  // namespace ridgeway
