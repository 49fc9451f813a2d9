// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Snapshots share what is the same in them, and leave nothing behind.
#include <gtest/gtest.h>
#include <malloc.h>

#include <deque>
#include <random>
#include <string>

#include "house_flight.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "support/random_changes.hpp"

namespace ridgeway {
namespace {

using testing::bytes_of;
using testing::flight_through_house;
using testing::house_config;
using testing::sensor_of_flight;

/// Blocks that two fields have in the same memory, of those that have the same values. Not quite
/// all: what an update changes in two steps may come out as it was.
template <typename Value>
double share_of_memory(const VoxelField<Value>& a, const VoxelField<Value>& b) {
  std::size_t same = 0, shared = 0;
  for (std::uint32_t slot = 0; slot < std::min(a.size(), b.size()) / kBlockVoxels; ++slot) {
    same += std::equal(a.block(slot), a.block(slot) + kBlockVoxels, b.block(slot));
    shared += a.block(slot) == b.block(slot);
  }
  return static_cast<double>(shared) / static_cast<double>(same);
}

const SiteField::Near& near_sites(const Roadmap& roadmap) {
  return *roadmap.esdf.site.visit([](const auto& field) -> const SiteField::Near* {
    if constexpr (std::is_same_v<decltype(field), const SiteField::Near&>) return &field;
    return nullptr;
  });
}

TEST(Snapshots, ShareTheMemoryOfBlocksThatAreTheSame) {
  LiveRoadmap live(house_config());
  std::shared_ptr<const Roadmap> before;
  const auto scans = flight_through_house(6);
  for (const auto& scan : scans) {
    live.integrate(scan.image, sensor_of_flight().camera, scan.T_world_camera);
    const auto now = live.snapshot();
    if (before) {
      EXPECT_GT(share_of_memory(before->esdf.squared, now->esdf.squared), 0.95);
      EXPECT_GT(share_of_memory(near_sites(*before), near_sites(*now)), 0.95);
      EXPECT_GT(share_of_memory(before->esdf.state, now->esdf.state), 0.95);
      EXPECT_GT(share_of_memory(before->attach.next, now->attach.next), 0.99);
    }
    before = now;
  }
  // And what is learnt goes to a roadmap with the same fields.
  const auto settled = live.settled();
  EXPECT_FALSE(before->is_settled);
  EXPECT_TRUE(before->tangents.empty());
  EXPECT_TRUE(settled->is_settled);
  EXPECT_EQ(share_of_memory(before->esdf.squared, settled->esdf.squared), 1.0);
  EXPECT_EQ(live.snapshot(), settled);
  EXPECT_EQ(live.settled(), settled);
}

/// Without a tangent graph there is still the cell graph to be made.
TEST(Snapshots, SettleWithoutATangentGraphToo) {
  LiveRoadmap live({.fusion = {.voxel_size = 0.2},
                    .build = {.min_clearance = 0.3, .max_distance = 4.0, .tangent_pairs = 0}});
  std::vector<VoxelChange> changes;
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 30; ++x) changes.push_back({{x, y, z}, VoxelState::kFree});
  live.set_voxels(changes);
  EXPECT_FALSE(live.snapshot()->is_settled);
  const auto settled = live.settled();
  EXPECT_TRUE(settled->is_settled);
  EXPECT_EQ(
      settled->cells.cells.size(),
      build_roadmap(live.map(), {.min_clearance = 0.3, .max_distance = 4.0, .tangent_pairs = 0})
          .roadmap.cells.cells.size());
  EXPECT_FALSE(settled->cells.cells.empty());
}

TEST(Snapshots, ChangesAreCountedByVoxelAndNothingFixesNoOrigin) {
  LiveRoadmap live({.fusion = {.voxel_size = 0.2}, .build = {.min_clearance = 0.3}});
  live.catch_up();
  live.set_voxels({});
  const VoxelIndex far{250'000'000, 0, 0};
  live.integrate(std::vector<Point>{{1.0, 0.0, 0.0}},
                 Eigen::Isometry3d(Eigen::Translation3d(0.2 * (far.x + 0.5), 0.1, 0.1)));
  EXPECT_EQ(live.map().origin, far);
  const VoxelChange there{far + VoxelIndex{30, 0, 0}, VoxelState::kFree};
  const VoxelChange away{there.voxel, VoxelState::kUnknown};
  EXPECT_EQ(live.set_voxels(std::vector{there, there}).changed_voxels, 1u);
  const UpdateReport nothing = live.set_voxels(std::vector{away, there});
  EXPECT_EQ(nothing.changed_voxels, 0u);
  EXPECT_EQ(live.set_voxels(std::vector{away}).version, nothing.version + 1);
}

TEST(Snapshots, ALiveRoadmapTakesNoMoreThanTwoOfABatchBuild) {
  const auto taken = [] { return mallinfo2().uordblks + mallinfo2().hblkhd; };
  const World world = make_house();
  const std::vector<VoxelChange> changes =
      testing::changes_to(occupancy_of(world, 0.1, {{0.0, 0.0, 0.0}, {15.0, 10.0, 5.0}}));
  const BuildConfig build = {.min_clearance = 0.3, .max_distance = 4.0, .tangent_pairs = 0};
  const std::size_t before = taken();
  LiveRoadmap live({.build = build});
  live.set_voxels(std::span(changes).first(changes.size() / 2));
  live.set_voxels(changes);
  const std::size_t of_live = taken() - before;
  const OccupancyMap map = live.map();
  const std::size_t between = taken();
  const BuildResult batch = build_roadmap(map, build);
  const std::size_t of_batch = taken() - between;
  RecordProperty("live", std::to_string(of_live));
  RecordProperty("batch", std::to_string(of_batch));
  EXPECT_LE(of_live, 2 * of_batch) << of_batch;
}

TEST(Snapshots, AThousandThatAreTakenAndDroppedLeaveNothing) {
  LiveRoadmap live({.build = {.min_clearance = 0.1, .max_distance = 0.6, .tangent_pairs = 0}});
  std::mt19937 random(4);
  for (int i = 0; i < 12; ++i)
    live.set_voxels(testing::random_changes(random, {-12, -9, -11}, {14, 12, 9}));
  std::vector<VoxelChange> closed, open;
  for (int z = -6; z < 6; ++z)
    for (int y = -6; y < 6; ++y) {
      closed.push_back({{0, y, z}, VoxelState::kOccupied});
      open.push_back({{0, y, z}, VoxelState::kFree});
    }
  std::deque<std::shared_ptr<const Roadmap>> held;
  const auto take = [&](int count) {
    for (int i = 0; i < count; ++i) {
      live.set_voxels(i % 2 == 0 ? closed : open);
      held.push_back(live.snapshot());
      if (held.size() > 5) held.pop_front();
    }
    std::string last = bytes_of(held.back().get());
    held.clear();
    return last;
  };
  const std::string expected = take(100);
  const std::size_t before = mallinfo2().uordblks;
  const std::string now = take(1000);
  const std::size_t after = mallinfo2().uordblks;
  EXPECT_TRUE(now == expected);
  EXPECT_LT(static_cast<double>(after), 1.01 * static_cast<double>(before) + 20'000.0);
}

}  // namespace
}  // namespace ridgeway
