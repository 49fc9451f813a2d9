// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live/live_window.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <vector>

namespace ridgeway {
namespace {

using detail::LiveWindow;
using States = std::map<VoxelIndex, VoxelState>;

constexpr double kWindowVoxel = 0.1, kReach = 2.5;

States states_of(const std::vector<VoxelChange>& changes) {
  States states;
  for (const VoxelChange& change : changes) states[change.voxel] = change.state;
  return states;
}

/// What waits, by voxel, and goes by the blocks that it lies in.
struct Model {
  States waiting;

  States take(const auto& counts) {
    States taken;
    for (auto it = waiting.begin(); it != waiting.end();) {
      if (!counts(block_of(it->first))) {
        ++it;
        continue;
      }
      taken.insert(*it);
      it = waiting.erase(it);
    }
    return taken;
  }
};

/// Of each voxel one at most, as a scan has them.
std::vector<VoxelChange> random_changes(std::mt19937& random) {
  std::uniform_int_distribution<int> along(-60, 60), few(0, 400), state(0, 2);
  States states;
  for (int i = few(random); i > 0; --i)
    states[{along(random), along(random), along(random) / 8}] =
        static_cast<VoxelState>(state(random));
  std::vector<VoxelChange> changes;
  for (const auto& [voxel, state_of_voxel] : states) changes.push_back({voxel, state_of_voxel});
  return changes;
}

/// Scans, changes of others and updates that fail, in any order.
TEST(LiveWindow, IsThatOfATableOfAllVoxels) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-6.0, 6.0);
  for (int run = 0; run < 20; ++run) {
    LiveWindow window(kReach, kWindowVoxel);
    Model model;
    for (int step = 0; step < 60; ++step) {
      const std::vector<VoxelChange> changes = random_changes(random);
      const Point sensor(at(random), at(random), 0.0);
      Model next = model;
      std::vector<VoxelChange> taken;
      States expected;
      if (random() % 4 == 0) {
        taken = window.take_with(changes);
        std::set<BlockIndex> blocks;
        for (const VoxelChange& change : changes) blocks.insert(block_of(change.voxel));
        expected = next.take([&](const BlockIndex& block) { return blocks.contains(block); });
        for (const VoxelChange& change : changes) expected[change.voxel] = change.state;
      } else {
        const auto is_near = [&](const BlockIndex& block) {
          const Point centre =
              8 * kWindowVoxel * Point(block.x + 0.5, block.y + 0.5, block.z + 0.5);
          return (centre - sensor).cwiseAbs().maxCoeff() <= kReach;
        };
        taken = window.take_near(changes, sensor);
        expected = next.take(is_near);
        for (const VoxelChange& change : changes)
          (is_near(block_of(change.voxel)) ? expected : next.waiting)[change.voxel] = change.state;
      }
      ASSERT_TRUE(states_of(taken) == expected);
      ASSERT_EQ(taken.size(), expected.size());  // of each voxel one
      if (random() % 5 == 0) continue;           // the update has failed: all is as it was
      window.keep();
      model = next;
      ASSERT_EQ(window.size(), model.waiting.size());
    }
    EXPECT_TRUE(states_of(window.take_all()) == model.waiting);
    window.keep();
    EXPECT_EQ(window.size(), 0u);
  }
}

TEST(LiveWindow, NoVoxelWaitsTwiceHoweverOftenItChanges) {
  LiveWindow window(kReach, kWindowVoxel);
  std::vector<VoxelChange> block;
  block.reserve(300);
  for (int voxel = 0; voxel < 300; ++voxel)
    block.push_back({voxel_of({50, 0, 0}, voxel), VoxelState::kFree});
  for (int i = 0; i < 40; ++i) {
    for (VoxelChange& change : block)
      change.state = i % 2 == 0 ? VoxelState::kFree : VoxelState::kOccupied;
    EXPECT_TRUE(window.take_near(block, Point::Zero()).empty());
    window.keep();
    EXPECT_EQ(window.size(), block.size());
  }
  EXPECT_TRUE(states_of(window.take_all()) == states_of(block));
}

}  // namespace
}  // namespace ridgeway
