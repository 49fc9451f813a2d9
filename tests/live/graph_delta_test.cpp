// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What deltas say is what is different, and a path that they leave alone stays free.
#include "ridgeway/live/graph_delta.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "ridgeway/common/error.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "support/random_changes.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kRadius = 0.15;

std::vector<VoxelChange> box(const VoxelIndex& low, const VoxelIndex& high, VoxelState state) {
  std::vector<VoxelChange> changes;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) changes.push_back({{x, y, z}, state});
  return changes;
}

/// Two rooms of 4 x 4 x 2 m, a wall between them with a door of 1 m.
LiveRoadmap two_rooms() {
  LiveRoadmap live({.build = {.min_clearance = kRadius, .tangent_pairs = 100}});
  std::vector<VoxelChange> changes = box({0, 0, 0}, {80, 39, 19}, VoxelState::kFree);
  for (const VoxelChange& wall : box({40, 0, 0}, {40, 39, 19}, VoxelState::kOccupied))
    if (wall.voxel.y < 10 || wall.voxel.y > 19) changes.push_back(wall);
  live.set_voxels(changes);
  return live;
}

std::vector<VoxelChange> door(VoxelState state) { return box({40, 10, 0}, {40, 19, 19}, state); }

std::set<VoxelIndex> vertices_of(const Roadmap& roadmap) {
  std::set<VoxelIndex> voxels;
  for (const Vertex& vertex : roadmap.graph.vertices)
    voxels.insert(roadmap.esdf.origin + vertex.voxel);
  return voxels;
}

TEST(GraphDelta, NamesTheVerticesThatCameAndWent) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    LiveRoadmap live({.build = {.min_clearance = 0.1, .tangent_pairs = 0}});
    std::shared_ptr<const Roadmap> before;
    for (int step = 0; step < 8; ++step) {
      live.set_voxels(testing::random_changes(random, {-12, -9, -11}, {14, 12, 9}));
      const auto now = live.snapshot();
      if (before && now) {
        const GraphDelta delta = delta_between(*before, *now);
        std::set<VoxelIndex> voxels = vertices_of(*before);
        for (const VoxelIndex& gone : delta.gone_vertices) EXPECT_EQ(voxels.erase(gone), 1u);
        for (const VoxelIndex& came : delta.came_vertices) EXPECT_TRUE(voxels.insert(came).second);
        EXPECT_TRUE(voxels == vertices_of(*now));
        EXPECT_EQ(before->graph.edges.size() + delta.came_edges.size(),
                  now->graph.edges.size() + delta.gone_edges.size());
        EXPECT_TRUE(delta_between(*now, *now).is_empty());
      }
      before = now;
    }
  }
}

TEST(GraphDelta, WhatIsOfNoTwoMapsIsRefused) {
  const std::vector<Point> path = {{1.0, 1.5, 1.0}, {2.0, 1.5, 1.0}};
  try {
    may_be_invalid(path, kRadius, GraphDelta{});
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("delta"), 0u) << error.what();
  }
}

TEST(GraphDelta, PathsThatJustFitFarFromZeroAreFlown) {
  // Voxels first: the map's origin is then that of the world.
  const VoxelIndex far{4'567'890, 53'456'780, -1'230};
  const Point shift = 0.1 * Point(far.x, far.y, far.z);
  LiveRoadmap live({.fusion = {.voxel_size = 0.1}, .build = {.min_clearance = 0.2}});
  std::vector<VoxelChange> changes;
  for (int z = 0; z < 20; ++z)
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 30; ++x)
        changes.push_back({far + VoxelIndex{x, y, z}, VoxelState::kFree});
  live.set_voxels(changes);
  const auto now = live.snapshot();
  std::mt19937 random(1);
  const auto along = [&] { return std::uniform_real_distribution<double>(0.2, 1.8)(random); };
  int flown = 0;
  for (int i = 0; i < 40; ++i) {  // beside a wall, at the radius
    const Point start = shift + Point(along(), 0.2, along());
    const Point goal = shift + Point(along(), 0.2, along());
    const PlanResult path = plan(*now, start, goal);
    if (!path.ok()) continue;
    EXPECT_TRUE(fly_plan(now->esdf, path, {}).ok()) << i;
    ++flown;
  }
  EXPECT_GT(flown, 20);
}

TEST(GraphDelta, ADoorThatClosesAndOpensIsToldAtOnce) {
  LiveRoadmap live = two_rooms();
  const Point start(1.0, 1.5, 1.0), goal(7.0, 1.5, 1.0);
  const auto open = live.snapshot();
  const PlanResult path = plan(*open, start, goal);
  ASSERT_TRUE(path.ok());
  EXPECT_TRUE(still_safe(path.waypoints, kRadius, *open));

  live.set_voxels(door(VoxelState::kOccupied));
  const auto closed = live.snapshot();
  const GraphDelta delta = delta_between(*open, *closed);
  EXPECT_EQ(delta.closed.size(), 200u);
  EXPECT_FALSE(delta.gone_edges.empty());
  EXPECT_TRUE(may_be_invalid(path.waypoints, kRadius, delta));
  EXPECT_FALSE(still_safe(path.waypoints, kRadius, *closed));
  EXPECT_FALSE(plan(*closed, start, goal).ok());
  // A path elsewhere is left alone.
  const PlanResult other = plan(*open, start, {1.0, 3.0, 1.0});
  ASSERT_TRUE(other.ok());
  EXPECT_FALSE(may_be_invalid(other.waypoints, kRadius, delta));

  live.set_voxels(door(VoxelState::kFree));
  const auto again = live.snapshot();
  EXPECT_TRUE(delta_between(*closed, *again).closed.empty());
  EXPECT_TRUE(delta_between(*open, *again).is_empty());
  EXPECT_TRUE(plan(*again, start, goal).ok());
}

/// Where unknown space is no obstacle, one may turn up in it.
TEST(GraphDelta, ObstaclesInWhatWasUnknownAreTold) {
  for (const UnknownPolicy policy : {UnknownPolicy::kIgnore, UnknownPolicy::kFree}) {
    LiveRoadmap live({.fusion = {.voxel_size = 0.1},
                      .build = {.min_clearance = 0.3, .unknown = policy, .max_distance = 4.0}});
    std::vector<VoxelChange> changes;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 40; ++x) {
        for (int z = 0; z < 8; ++z) changes.push_back({{x, y, z}, VoxelState::kFree});
        changes.push_back({{x, y, -8}, VoxelState::kOccupied});
      }
    live.set_voxels(changes);
    const auto before = live.snapshot();
    const std::vector<Point> path = {{0.5, 0.75, 0.45}, {3.5, 0.75, 0.45}};
    ASSERT_TRUE(still_safe(path, 0.4, *before));
    live.set_voxels(std::vector<VoxelChange>{{{20, 7, 8}, VoxelState::kOccupied}});
    const auto now = live.snapshot();
    EXPECT_FALSE(still_safe(path, 0.4, *now));
    const GraphDelta delta = delta_between(*before, *now);
    EXPECT_EQ(delta.closed, std::vector<VoxelIndex>({{20, 7, 8}}));
    EXPECT_TRUE(may_be_invalid(path, 0.4, delta));
  }
}

TEST(GraphDelta, WhereUnknownSpaceIsFreeItsEndIsTold) {
  LiveRoadmap live(
      {.build = {.min_clearance = kRadius, .unknown = UnknownPolicy::kFree, .tangent_pairs = 0}});
  live.set_voxels(box({0, 0, 0}, {15, 15, 15}, VoxelState::kFree));
  live.set_voxels(box({60, 8, 8}, {60, 8, 8}, VoxelState::kFree));
  const auto before = live.snapshot();
  const std::vector<Point> path = {{0.8, 0.8, 0.8}, {5.0, 0.8, 0.8}};
  ASSERT_TRUE(still_safe(path, kRadius, *before));
  live.set_voxels(box({60, 8, 8}, {60, 8, 8}, VoxelState::kUnknown));
  const auto now = live.snapshot();
  EXPECT_FALSE(still_safe(path, kRadius, *now));
  EXPECT_TRUE(may_be_invalid(path, kRadius, delta_between(*before, *now)));
}

/// A planar map has one layer, which stands for whatever height a path says it is at.
TEST(GraphDelta, HeightsOfPathsSayNothingInAPlane) {
  const auto flat = [](VoxelState state_of_middle) {
    const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {31, 7, 7}, [&](const auto& v) {
      return v == VoxelIndex{16, 4, 4} ? state_of_middle : VoxelState::kFree;
    });
    return build_roadmap(flatten(map, 0.4, 0.5), {.min_clearance = kRadius}).roadmap;
  };
  const Roadmap before = flat(VoxelState::kFree), now = flat(VoxelState::kOccupied);
  const GraphDelta delta = delta_between(before, now);
  for (const double height : {-3.0, 0.45, 5.0}) {
    const std::vector<Point> path = {{0.8, 0.4, height}, {2.4, 0.4, height}};
    ASSERT_TRUE(still_safe(path, kRadius, before));
    ASSERT_FALSE(still_safe(path, kRadius, now));
    EXPECT_TRUE(may_be_invalid(path, kRadius, delta));
  }
}

TEST(GraphDelta, APathThatIsLeftAloneStaysFree) {
  int kept = 0, lost = 0;
  std::mt19937 random(5);
  const auto place = [&] {
    std::uniform_real_distribution<double> share(0.05, 0.95);
    return Point(8.1 * share(random), 4.0 * share(random), 2.0 * share(random));
  };
  LiveRoadmap live = two_rooms();
  for (int step = 0; step < 40; ++step) {
    const auto before = live.snapshot();
    std::vector<std::vector<Point>> paths;
    for (int i = 0; i < 6; ++i)
      if (const PlanResult path = plan(*before, place(), place()); path.ok())
        paths.push_back(path.waypoints);
    live.set_voxels(testing::random_changes(random, {0, 0, 0}, {81, 40, 20}));
    const auto now = live.snapshot();
    ASSERT_NE(now, nullptr);
    const GraphDelta delta = delta_between(*before, *now);
    for (const std::vector<Point>& path : paths) {
      const bool is_safe = still_safe(path, kRadius, *now);
      EXPECT_TRUE(is_safe || may_be_invalid(path, kRadius, delta));
      kept += !may_be_invalid(path, kRadius, delta);
      lost += !is_safe;
    }
  }
  EXPECT_GT(kept, 20);
  EXPECT_GT(lost, 5);
}

TEST(GraphDelta, RefusesMapsThatAreNotTheSame) {
  LiveRoadmap live = two_rooms();
  LiveRoadmap other({.build = {.min_clearance = kRadius}, .origin = VoxelIndex{1, 0, 0}});
  other.set_voxels(box({0, 0, 0}, {20, 20, 20}, VoxelState::kFree));
  EXPECT_THROW(delta_between(*live.snapshot(), *other.snapshot()), InputError);
  EXPECT_THROW(still_safe({}, kRadius, *live.snapshot()), InputError);
}

TEST(LiveRoadmap, IsPlannedOnWhileItIsUpdated) {
  LiveRoadmap live = two_rooms();
  std::atomic<bool> done = false;
  std::atomic<int> asked = 0, unsafe = 0;
  std::thread planner([&] {
    while (!done || asked == 0) {
      const auto now = live.snapshot();
      const PlanResult path = plan(*now, {1.0, 1.5, 1.0}, {7.0, 1.5, 1.0});
      unsafe += path.ok() && !still_safe(path.waypoints, kRadius, *now);
      ++asked;
    }
  });
  for (int step = 0; step < 12; ++step)
    live.set_voxels(door(step % 2 == 0 ? VoxelState::kOccupied : VoxelState::kFree));
  done = true;
  planner.join();
  EXPECT_EQ(unsafe, 0);
}

TEST(GraphDelta, RefusesPathsAndRadiiThatAreNone) {
  LiveRoadmap live = two_rooms();
  const auto before = live.snapshot();
  live.set_voxels(door(VoxelState::kOccupied));
  const auto now = live.snapshot();
  const GraphDelta delta = delta_between(*before, *now);
  const std::vector<Point> good{{1, 1.5, 1}, {7, 1.5, 1}};
  EXPECT_TRUE(may_be_invalid(good, 0.3, delta));
  for (const double radius : {-0.5, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(may_be_invalid(good, radius, delta), InputError);
    EXPECT_THROW(still_safe(good, radius, *now), InputError);
  }
  for (const std::vector<Point>& path :
       {std::vector<Point>{}, std::vector<Point>{{1, std::nan(""), 1}}, {{1e300, 1, 1}}}) {
    EXPECT_THROW(may_be_invalid(path, 0.3, delta), InputError);
    EXPECT_THROW(still_safe(path, 0.3, *now), InputError);
  }
}

/// What a path was planned for goes with it: the height of a cylinder, limits, and that escapes
/// keep no radius.
TEST(GraphDelta, PathsAreHeldAgainstNewerMapsAsTheyWerePlanned) {
  LiveRoadmap live = two_rooms();
  const auto open = live.snapshot();
  const Point start(0.5, 2.05, 1.0), goal(3.5, 2.05, 1.0);
  const PlanResult tall = plan(*open, start, goal, {.robot_height = 1.2});
  const PlanResult out = plan(*open, {0.08, 2.05, 1.0}, goal, {.escape = true});
  const PlanResult low = plan(
      *open, start, goal, {.limits = {.keep_out = {{Point(1.5, 0.0, 1.2), Point(2.5, 3.9, 2.0)}}}});
  ASSERT_TRUE(tall.ok() && out.ok() && low.ok());
  ASSERT_GT(out.escape_start.length, 0.0);
  for (const PlanResult& path : {tall, out, low}) EXPECT_TRUE(still_safe(path, *open));
  EXPECT_FALSE(still_safe(out.waypoints, kRadius, *open));

  live.set_voxels(box({20, 20, 5}, {20, 20, 5}, VoxelState::kOccupied));  // half a metre below
  const auto below = live.snapshot();
  const GraphDelta delta = delta_between(*open, *below);
  EXPECT_TRUE(may_be_invalid(tall, delta));
  EXPECT_FALSE(still_safe(tall, *below));
  EXPECT_FALSE(may_be_invalid(out, delta));
  EXPECT_TRUE(still_safe(out, *below));
  PlanResult raised = low;
  for (Point& p : raised.waypoints) p.z() = 1.3;
  EXPECT_FALSE(still_safe(raised, *below));  // through what was kept out

  live.set_voxels(box({0, 20, 9}, {0, 20, 9}, VoxelState::kOccupied));  // where it escapes from
  EXPECT_FALSE(still_safe(out, *live.snapshot()));
  EXPECT_TRUE(may_be_invalid(out, delta_between(*open, *live.snapshot())));

  EXPECT_THROW(still_safe(PlanResult{}, *below), InputError);
  EXPECT_THROW(may_be_invalid(PlanResult{}, delta), InputError);
  EXPECT_THROW(still_safe(given_plan(open->esdf, {start, goal}), *below), InputError);
}

}  // namespace
}  // namespace ridgeway
