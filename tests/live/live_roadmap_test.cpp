// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// The contract: after every update the snapshot has the bytes of a batch build of the same map.
#include "ridgeway/live/live_roadmap.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <random>
#include <thread>

#include "house_flight.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "support/random_changes.hpp"
#include "support/refusal.hpp"

namespace ridgeway {
namespace {

using testing::batch_bytes;
using testing::bytes_of;
using testing::flight_through_house;
using testing::house_config;
using testing::Scan;
using testing::sensor_of_flight;

BuildConfig small_build(UnknownPolicy unknown, double max_distance) {
  return {
      .min_clearance = 0.1, .unknown = unknown, .max_distance = max_distance, .tangent_pairs = 40};
}

/// How many change sets: RIDGEWAY_CHANGE_SETS asks for another number.
unsigned sets(unsigned usual) {
  const char* asked = std::getenv("RIDGEWAY_CHANGE_SETS");
  return asked != nullptr ? static_cast<unsigned>(std::strtoul(asked, nullptr, 10)) : usual;
}

struct Sets {
  UnknownPolicy unknown;
  double max_distance;
  unsigned count;
};

class LiveRoadmapAfter : public ::testing::TestWithParam<Sets> {};

TEST_P(LiveRoadmapAfter, RandomChangeSetsHasTheBytesOfABatchBuild) {
  constexpr int kSteps = 10;
  const BuildConfig build = small_build(GetParam().unknown, GetParam().max_distance);
  std::size_t with_roadmap = 0, removed = 0;
  for (unsigned seed = 0; seed < GetParam().count / kSteps; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    LiveRoadmap live({.build = build});
    for (int step = 0; step < kSteps; ++step) {
      SCOPED_TRACE(step);
      const auto changes = testing::random_changes(random, {-12, -9, -11}, {14, 12, 9});
      UpdateReport report;
      with_threads(1 + step % 2, [&] { report = live.set_voxels(changes); });
      const auto snapshot = live.settled();
      EXPECT_EQ(report.has_roadmap, snapshot != nullptr);
      EXPECT_TRUE(bytes_of(snapshot.get()) == batch_bytes(live.map(), build));
      with_roadmap += snapshot != nullptr;
      removed += report.in_batch;
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(with_roadmap, GetParam().count / 2);
  EXPECT_GT(removed, 0u);
}

INSTANTIATE_TEST_SUITE_P(Policies, LiveRoadmapAfter,
                         ::testing::Values(Sets{UnknownPolicy::kObstacle,
                                                std::numeric_limits<double>::infinity(), sets(400)},
                                           Sets{UnknownPolicy::kObstacle, 0.45, sets(400)},
                                           Sets{UnknownPolicy::kIgnore,
                                                std::numeric_limits<double>::infinity(), 60},
                                           Sets{UnknownPolicy::kFree, 0.45, 60}));

TEST(LiveRoadmap, KeepsTheLimitsOfFlightsAsABatchBuildDoes) {
  BuildConfig build = small_build(UnknownPolicy::kObstacle, 1.0);
  build.limits.keep_in.min.z() = -0.3;
  build.limits.keep_out = {{Point(-0.2, -0.2, -1.0), Point(0.3, 0.25, 1.0)}};
  std::size_t with_roadmap = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    LiveRoadmap live({.build = build});
    for (int step = 0; step < 6; ++step) {
      live.set_voxels(testing::random_changes(random, {-12, -9, -11}, {14, 12, 9}));
      const auto snapshot = live.snapshot();
      ASSERT_TRUE(bytes_of(snapshot.get()) == batch_bytes(live.map(), build)) << step;
      if (snapshot == nullptr) continue;
      ++with_roadmap;
      ASSERT_TRUE(snapshot->esdf.limits.any());
      for (const Vertex& vertex : snapshot->graph.vertices)
        ASSERT_TRUE(snapshot->esdf.limits.allow(vertex.position));
    }
  }
  EXPECT_GT(with_roadmap, 15u);
}

/// Rooms so far apart that nothing in one can be as wide as what is between them.
TEST(LiveRoadmap, OfRoomsThatChangeInTurnHasTheBytesOfABatchBuild) {
  const BuildConfig build = small_build(UnknownPolicy::kObstacle, 1.0);
  constexpr int kRooms = 5, kApart = 60;
  std::size_t kept = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    LiveRoadmap live({.build = build});
    for (int step = 0; step < 16; ++step) {
      SCOPED_TRACE(step);
      // Later rooms come in front of those that are there, too.
      const int room = static_cast<int>(random() % kRooms) - kRooms / 2;
      const VoxelIndex at{kApart * room, 7 * room, 0};
      const auto before = live.snapshot();
      UpdateReport report;
      with_threads(1 + step % 2, [&] {
        report = live.set_voxels(testing::random_changes(random, at + VoxelIndex{-12, -9, -11},
                                                         at + VoxelIndex{14, 12, 9}));
      });
      const auto now = live.settled();
      ASSERT_TRUE(bytes_of(now.get()) == batch_bytes(live.map(), build));
      if (now == nullptr || report.changed_voxels == 0) continue;
      const BuildReport whole = build_roadmap(live.map(), build).report;
      EXPECT_EQ(report.build.traversable_components, whole.traversable_components);
      EXPECT_EQ(report.build.graph_components, whole.graph_components);
      EXPECT_EQ(report.build.diagram_voxels, whole.diagram_voxels);
      EXPECT_EQ(report.build.kernel_voxels, whole.kernel_voxels);
      if (before == nullptr || report.in_batch) continue;
      for (const Vertex& vertex : before->graph.vertices)
        kept += std::abs(vertex.voxel.x - at.x) > kApart / 2 ? 1u : 0u;
    }
  }
  EXPECT_GT(kept, 200u);
}

/// The inside of a ball that is just so wide that a site is not near, but for something at its
/// centre that goes and comes back.
TEST(LiveRoadmap, ThatGrowsWiderThanNearSitesGoHasTheBytesOfABatchBuild) {
  const BuildConfig build = {.min_clearance = 4.0, .tangent_pairs = 0};
  constexpr int kBall = 129;
  std::vector<VoxelChange> changes;
  for (int z = -kBall; z <= kBall; ++z)
    for (int y = -kBall; y <= kBall; ++y)
      for (int x = -kBall; x <= kBall; ++x)
        if (x * x + y * y + z * z <= kBall * kBall)
          changes.push_back({{x, y, z}, VoxelState::kFree});
  changes.push_back({{0, 0, 0}, VoxelState::kOccupied});
  LiveRoadmap live({.build = build});
  live.set_voxels(changes);
  EXPECT_TRUE(live.snapshot()->esdf.site.has_near_only());
  for (const auto state : {VoxelState::kFree, VoxelState::kOccupied}) {
    const UpdateReport report = live.set_voxels(std::vector<VoxelChange>{{{0, 0, 0}, state}});
    EXPECT_EQ(report.in_batch, state == VoxelState::kFree);
    EXPECT_FALSE(live.snapshot()->esdf.site.has_near_only());
    EXPECT_TRUE(bytes_of(live.snapshot().get()) == batch_bytes(live.map(), build));
  }
}

TEST(LiveRoadmap, DoesNotDependOnOrderAndGroupingOfChanges) {
  const BuildConfig build = small_build(UnknownPolicy::kObstacle, 1.0);
  std::mt19937 random(3);
  std::vector<VoxelChange> changes;
  for (int i = 0; i < 12; ++i) {
    const auto more = testing::random_changes(random, {-12, -9, -11}, {14, 12, 9});
    changes.insert(changes.end(), more.begin(), more.end());
  }
  LiveRoadmap at_once({.build = build});
  at_once.set_voxels(changes);
  ASSERT_NE(at_once.snapshot(), nullptr);
  const std::vector<VoxelChange> all = testing::changes_to(at_once.map());
  const std::string expected = bytes_of(at_once.settled().get());
  for (const std::size_t group : {std::size_t{97}, changes.size() / 3}) {
    LiveRoadmap live({.build = build});
    std::vector<VoxelChange> shuffled = all;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (std::size_t i = 0; i < shuffled.size(); i += group)
      live.set_voxels(std::span(shuffled).subspan(i, std::min(group, shuffled.size() - i)));
    EXPECT_TRUE(bytes_of(live.settled().get()) == expected) << group;
  }
}

/// A thread that waits for the loops of one update must not begin another one.
TEST(LiveRoadmap, TakesUpdatesThatAreTasksOfOneArena) {
  constexpr int kThreads = 4, kUpdates = 150;
  const tbb::global_control as_many(tbb::global_control::max_allowed_parallelism, kThreads);
  LiveRoadmap live(testing::house_config());
  tbb::task_arena arena(kThreads);
  std::atomic<int> done = 0;
  arena.execute([&] {
    tbb::task_group updates;
    for (int k = 0; k < kUpdates; ++k)
      updates.run([&, k] {
        std::mt19937 random(static_cast<unsigned>(k));
        live.set_voxels(testing::random_changes(random, {-20, -20, -20}, {30, 30, 30}));
        ++done;
      });
    updates.wait();
  });
  EXPECT_EQ(done, kUpdates);
}

TEST(LiveRoadmap, TakesUpdatesOfSeveralThreadsOneAfterTheOther) {
  const BuildConfig build = small_build(UnknownPolicy::kObstacle, 1.0);
  std::mt19937 random(4);
  LiveRoadmap at_once({.build = build});
  at_once.set_voxels(testing::random_changes(random, {-12, -9, -11}, {14, 12, 9}));
  ASSERT_NE(at_once.snapshot(), nullptr);
  const std::vector<VoxelChange> all = testing::changes_to(at_once.map());
  constexpr std::size_t kThreads = 3, kGroup = 211;
  LiveRoadmap live({.build = build, .origin = at_once.map().origin});
  const auto update = [&](std::size_t mine) {
    for (std::size_t i = mine * kGroup; i < all.size(); i += kThreads * kGroup)
      live.set_voxels(std::span(all).subspan(i, std::min(kGroup, all.size() - i)));
  };
  std::vector<std::thread> threads;
  for (std::size_t mine = 0; mine < kThreads; ++mine) threads.emplace_back(update, mine);
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(bytes_of(live.settled().get()) == bytes_of(at_once.settled().get()));
}

TEST(LiveRoadmap, OfEveryScanOfAFlightHasTheBytesOfABatchBuild) {
  const LiveConfig config = house_config();
  LiveRoadmap live(config);
  TsdfFusion fusion(config.fusion);
  for (const Scan& scan : flight_through_house(12)) {
    const UpdateReport report =
        live.integrate(scan.image, sensor_of_flight().camera, scan.T_world_camera);
    fusion.integrate(scan.image, sensor_of_flight().camera, scan.T_world_camera);
    EXPECT_FALSE(report.in_batch);
    EXPECT_GT(report.changed_voxels, 0u);
    const OccupancyMap map = live.map();
    EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(map, config.build));
    // And the map is that of fusion, counted from another voxel.
    const OccupancyMap fused = occupancy_of(fusion.map());
    EXPECT_EQ(count_voxels(fused).free, count_voxels(map).free);
    for (const VoxelChange& known : testing::changes_to(fused))
      ASSERT_EQ(map.at(known.voxel - map.origin), known.state);
  }
}

TEST(LiveRoadmap, SnapshotsStayAsTheyAreWhileTheMapGoesOn) {
  LiveRoadmap live(house_config());
  std::vector<std::shared_ptr<const Roadmap>> snapshots;
  std::vector<std::string> bytes;
  for (const Scan& scan : flight_through_house(4)) {
    live.integrate(scan.image, sensor_of_flight().camera, scan.T_world_camera);
    snapshots.push_back(live.snapshot());
    bytes.push_back(bytes_of(snapshots.back().get()));
  }
  for (std::size_t i = 0; i < snapshots.size(); ++i)
    EXPECT_TRUE(bytes_of(snapshots[i].get()) == bytes[i]);
}

TEST(LiveRoadmap, AnUpdateThatChangesNothingKeepsTheSnapshot) {
  LiveRoadmap live({.build = small_build(UnknownPolicy::kObstacle, 1.0)});
  std::mt19937 random(3);
  live.set_voxels(testing::random_changes(random, {-12, -9, -11}, {14, 12, 9}));
  const auto before = live.snapshot();
  const UpdateReport report = live.set_voxels(testing::changes_to(live.map()));
  EXPECT_EQ(report.changed_voxels, 0u);
  EXPECT_EQ(live.snapshot(), before);
}

/// Free by the policy, as nothing is known to be: the one voxel that is known is occupied.
TEST(LiveRoadmap, OfOneObstacleInFreeUnknownSpaceHasTheBytesOfABatchBuild) {
  const BuildConfig build = small_build(UnknownPolicy::kFree, 1.0);
  LiveRoadmap live({.build = build});
  live.set_voxels(std::vector<VoxelChange>{{{0, 0, 0}, VoxelState::kOccupied}});
  const auto settled = live.settled();
  ASSERT_NE(settled, nullptr);
  EXPECT_TRUE(bytes_of(settled.get()) == batch_bytes(live.map(), build));
}

TEST(LiveRoadmap, RefusesBadInputByNameAndStaysAsItWas) {
  const std::vector<Scan> scans = flight_through_house(2);
  const PinholeCamera camera = sensor_of_flight().camera;
  LiveRoadmap live(house_config());
  live.integrate(scans[0].image, camera, scans[0].T_world_camera);
  const auto snapshot = live.snapshot();
  const std::vector<VoxelChange> map = testing::changes_to(live.map());

  const auto refused = [&](const std::string& name, const auto& update) {
    try {
      update();
      ADD_FAILURE() << name << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
    EXPECT_EQ(live.snapshot(), snapshot);
    EXPECT_TRUE(testing::changes_to(live.map()) == map);
  };
  Eigen::Isometry3d sheared = scans[1].T_world_camera;
  sheared.linear() *= 1.1;
  refused("frame 2", [&] { live.integrate(scans[1].image, camera, sheared); });
  Eigen::Isometry3d nowhere = scans[1].T_world_camera;
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  refused("frame 2", [&] { live.integrate(scans[1].image, camera, nowhere); });
  Eigen::Isometry3d far = scans[1].T_world_camera;
  far.translation().x() = 1e12;
  refused("frame 2", [&] { live.integrate(scans[1].image, camera, far); });
  refused("frame 2", [&] { live.integrate(DepthImage{}, camera, scans[1].T_world_camera); });
  const std::vector<VoxelChange> beyond = {{{0, 0, 0}, VoxelState::kOccupied},
                                           {{0, kMaxVoxelIndex + 1, 0}, VoxelState::kFree}};
  refused("change 1", [&] { live.set_voxels(beyond); });
  const std::vector<VoxelChange> nothing_known = {{{0, 0, 0}, static_cast<VoxelState>(7)}};
  refused("change 0", [&] { live.set_voxels(nothing_known); });

  // And goes on as if nothing had been.
  live.integrate(scans[1].image, camera, scans[1].T_world_camera);
  LiveRoadmap other(house_config());
  for (const Scan& scan : scans) other.integrate(scan.image, camera, scan.T_world_camera);
  EXPECT_TRUE(bytes_of(live.settled().get()) == bytes_of(other.settled().get()));
}

}  // namespace
}  // namespace ridgeway
