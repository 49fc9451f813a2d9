// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/exploration/explorer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ridgeway/common/error.hpp"
#include "ridgeway/live/live_roadmap.hpp"

namespace ridgeway {
namespace {

constexpr double kExplorerVoxel = 0.2;

LiveRoadmap live_for_explorers() {
  return LiveRoadmap({.fusion = {.voxel_size = kExplorerVoxel},
                      .build = {.min_clearance = 0.5, .max_distance = 2.0},
                      .origin = VoxelIndex{}});
}

/// A layer of voxels across a room of 12 x 6 x 3 m, at an x, up to a y.
std::vector<VoxelChange> layer(int x, int end_y, VoxelState state) {
  std::vector<VoxelChange> changes;
  for (int z = 0; z < 15; ++z)
    for (int y = 0; y < end_y; ++y) changes.push_back({{x, y, z}, state});
  return changes;
}

/// That room, free, between a wall at x = 0 and unknown space on the other sides.
std::vector<VoxelChange> room_behind_a_wall() {
  std::vector<VoxelChange> changes = layer(-1, 30, VoxelState::kOccupied);
  for (int x = 0; x < 60; ++x) {
    const std::vector<VoxelChange> free = layer(x, 30, VoxelState::kFree);
    changes.insert(changes.end(), free.begin(), free.end());
  }
  return changes;
}

/// That room with walls, floor and ceiling, so that all is seen.
std::vector<VoxelChange> closed_room() {
  std::vector<VoxelChange> changes;
  for (int z = -1; z <= 15; ++z)
    for (int y = -1; y <= 30; ++y)
      for (int x = -1; x <= 60; ++x) {
        const bool is_wall = x < 0 || x == 60 || y < 0 || y == 30 || z < 0 || z == 15;
        changes.push_back({{x, y, z}, is_wall ? VoxelState::kOccupied : VoxelState::kFree});
      }
  return changes;
}

FlightState state_at(const Trajectory& trajectory, double time) {
  const TrajectoryState at = trajectory.at(time);
  return {.time = time,
          .position = at.position,
          .velocity = at.velocity,
          .acceleration = at.acceleration,
          .yaw = at.yaw};
}

/// At one end of the closed room.
TEST(ExplorerConfig, AStrategyThatIsNoneIsRefused) {
  ExplorerConfig config;
  EXPECT_NO_THROW(config.validate());
  config.strategy = static_cast<ExplorationStrategy>(9);
  EXPECT_THROW(config.validate(), InputError);
}

ExplorerConfig with_a_home() {
  ExplorerConfig config;
  config.home = Point(1.1, 3.1, 1.5);
  return config;
}

/// What an explorer with a home does at the other end of the closed room.
ExplorationStep way_home(Explorer& explorer, const LiveRoadmap& live) {
  ExplorationStep home = explorer.decide(live.snapshot(), {.position = {10.1, 3.1, 1.5}});
  EXPECT_EQ(home.status, ExplorationStatus::kReturn) << name_of(home.status);
  return home;
}

/// A robot at rest at a place that the map has nearer to an obstacle than the robot's radius.
TEST(Explorer, GoesOnFromWhereItDoesNotFitAnyMore) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(room_behind_a_wall());
  for (const double from_wall : {0.6, 0.3}) {
    Explorer explorer({});
    const ExplorationStep step =
        explorer.decide(live.snapshot(), {.position = {from_wall, 3.1, 1.5}});
    EXPECT_EQ(step.status, ExplorationStatus::kFly) << name_of(step.status) << ", " << from_wall;
    EXPECT_FALSE(step.trajectory.segments.empty()) << from_wall;
  }
}

/// Before it was given any trajectory.
TEST(Explorer, BeginsWithTheMotionThatARobotHas) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(room_behind_a_wall());
  Explorer explorer({});
  const Eigen::Vector3d velocity(0.5, 0.1, 0.0);
  const ExplorationStep step =
      explorer.decide(live.snapshot(), {.position = {5.1, 3.1, 1.5}, .velocity = velocity});
  ASSERT_EQ(step.status, ExplorationStatus::kFly) << name_of(step.status);
  EXPECT_TRUE(step.trajectory.at(0.0).velocity.isApprox(velocity, 1e-9));
}

/// A flight that begins with another velocity than the robot's is verified in vain.
TEST(Explorer, RefusesAMotionBeyondItsLimits) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(room_behind_a_wall());
  const MotionLimits limits;
  const auto decide = [&](double speed, double acceleration) {
    return Explorer({}).decide(live.snapshot(), {.position = {5.1, 3.1, 1.5},
                                                 .velocity = {speed, 0.0, 0.0},
                                                 .acceleration = {acceleration, 0.0, 0.0}});
  };
  EXPECT_THROW(decide(1.2 * limits.max_speed, 0.0), InputError);
  EXPECT_THROW(decide(0.1, 1.2 * limits.max_acceleration), InputError);
  EXPECT_NO_THROW(decide(0.1, 1.05 * limits.max_acceleration));
}

/// It is in doubt of its way out only where something turns up there.
TEST(Explorer, TheWayOutOfWhereItDoesNotFitIsFlownToItsEnd) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(room_behind_a_wall());
  Explorer explorer({});
  const ExplorationStep out = explorer.decide(live.snapshot(), {.position = {0.3, 3.1, 1.5}});
  ASSERT_EQ(out.status, ExplorationStatus::kFly);
  for (const double time : {0.1, 0.2, 0.4, 0.6}) {
    const ExplorationStep next = explorer.decide(live.snapshot(), state_at(out.trajectory, time));
    EXPECT_FALSE(next.was_in_doubt) << time;
    EXPECT_EQ(next.status, ExplorationStatus::kKeep) << time << ", " << name_of(next.status);
  }
  live.set_voxels(layer(7, 30, VoxelState::kOccupied));
  EXPECT_TRUE(explorer.decide(live.snapshot(), state_at(out.trajectory, 0.8)).was_in_doubt);
}

/// It is not leaving a place, so what turns up beside it is as bad as what turns up before it.
TEST(Explorer, ItIsInDoubtWhereSomethingTurnsUpBesideIt) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(closed_room());
  Explorer explorer(with_a_home());
  const ExplorationStep home = way_home(explorer, live);
  const FlightState flying = state_at(home.trajectory, 2.0);
  const VoxelIndex here = voxel_at(flying.position, kExplorerVoxel);
  EXPECT_FALSE(explorer.decide(live.snapshot(), flying).was_in_doubt);
  live.set_voxels(std::vector<VoxelChange>{{here + VoxelIndex{0, 2, 0}, VoxelState::kOccupied}});
  EXPECT_TRUE(explorer.decide(live.snapshot(), flying).was_in_doubt);
}

/// On its way home a robot meets a wall that leaves no room to brake along its way.
TEST(Explorer, OnItsWayHomeItIsNotStuckWhileItFlies) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(closed_room());
  Explorer explorer(with_a_home());
  const ExplorationStep home = way_home(explorer, live);
  const FlightState fast = state_at(home.trajectory, 2.0);
  ASSERT_GT(fast.velocity.norm(), 1.5);
  const int wall = voxel_at(fast.position, kExplorerVoxel).x - 5;
  live.set_voxels(layer(wall, 30, VoxelState::kOccupied));
  const ExplorationStep blocked = explorer.decide(live.snapshot(), fast);
  EXPECT_TRUE(blocked.was_in_doubt);
  EXPECT_EQ(blocked.status, ExplorationStatus::kKeep) << name_of(blocked.status);
  live.set_voxels(layer(wall, 30, VoxelState::kFree));
  live.set_voxels(layer(wall - 15, 18, VoxelState::kOccupied));  // with a way around it
  const ExplorationStep around = explorer.decide(live.snapshot(), state_at(home.trajectory, 2.1));
  EXPECT_EQ(around.status, ExplorationStatus::kReturn) << name_of(around.status);
}

/// A wall turns up where a stop takes nearly all the room that is left.
TEST(Explorer, BrakesInWhatRoomThereIs) {
  int stopped = 0;
  for (const int room : {8, 9, 10, 11, 12, 13}) {  // voxels
    LiveRoadmap live = live_for_explorers();
    live.set_voxels(closed_room());
    ExplorerConfig config = with_a_home();
    config.motion.max_jerk = 8.0;
    Explorer explorer(config);
    const ExplorationStep home = way_home(explorer, live);
    const FlightState fast = state_at(home.trajectory, 2.0);
    ASSERT_GT(fast.velocity.norm(), 1.5);
    live.set_voxels(
        layer(voxel_at(fast.position, kExplorerVoxel).x - room, 30, VoxelState::kOccupied));
    const ExplorationStep step = explorer.decide(live.snapshot(), fast);
    EXPECT_TRUE(step.was_in_doubt);
    EXPECT_EQ(step.is_braking, !step.trajectory.segments.empty());
    stopped += step.is_braking ? 1 : 0;
    if (step.is_braking) {
      EXPECT_LT(step.trajectory.at(step.trajectory.duration()).velocity.norm(), 1e-9);
    }
  }
  EXPECT_EQ(stopped, 3);
}

/// Free space with a room beyond a door, which has an end that nothing is known of.
std::vector<VoxelChange> two_rooms() {
  std::vector<VoxelChange> changes = closed_room();
  for (VoxelChange& change : changes)
    if (change.voxel.x == 30 && (change.voxel.y < 8 || change.voxel.y > 21))
      change.state = VoxelState::kOccupied;
    else if (change.voxel.x == 60)
      change.state = VoxelState::kUnknown;
  return changes;
}

TEST(Explorer, EndsWhereADoorClosesOnAllThatIsLeftToSee) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(two_rooms());
  Explorer explorer({});
  FlightState state{.position = {1.1, 2.1, 1.5}};
  ExplorationStep step = explorer.decide(live.snapshot(), state);
  ASSERT_EQ(step.status, ExplorationStatus::kFly) << name_of(step.status);
  for (int y = 8; y < 22; ++y) {
    std::vector<VoxelChange> door;
    door.reserve(15);
    for (int z = 0; z < 15; ++z) door.push_back({{30, y, z}, VoxelState::kOccupied});
    live.set_voxels(door);
  }
  Trajectory flying = step.trajectory;
  double since = 0.0;
  for (int i = 1; i < 100 && step.status != ExplorationStatus::kComplete; ++i) {
    const double time = 0.25 * i;
    state = state_at(flying, std::min(time - since, flying.duration()));
    state.time = time;
    step = explorer.decide(live.snapshot(), state);
    if (step.trajectory.segments.empty()) continue;
    flying = step.trajectory;
    since = time;
  }
  EXPECT_EQ(step.status, ExplorationStatus::kComplete) << name_of(step.status);
}

TEST(Explorer, ClocksBeginWhenTheyLikeAndRunForwards) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(room_behind_a_wall());
  Explorer explorer({});
  FlightState state{.time = -3.0, .position = {3.1, 3.1, 1.5}};
  const ExplorationStep step = explorer.decide(live.snapshot(), state);
  EXPECT_EQ(step.status, ExplorationStatus::kFly) << name_of(step.status);
  state = state_at(step.trajectory, 0.5);
  state.time = -2.5;
  explorer.decide(live.snapshot(), state);
  state = state_at(step.trajectory, 0.4);
  state.time = -2.6;
  EXPECT_THROW(explorer.decide(live.snapshot(), state), InputError);
}

TEST(Explorer, AnyNumberOfRaysIsTaken) {
  ExplorerConfig config;
  config.most_rays = 0;
  EXPECT_THROW(Explorer{config}, InputError);
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(closed_room());
  config.most_rays = std::size_t{1} << 62;
  Explorer explorer(config);
  EXPECT_EQ(explorer.decide(live.snapshot(), {.position = {3.1, 3.1, 1.5}}).status,
            ExplorationStatus::kComplete);
}

/// What cannot be gone to says nothing about what could be seen.
TEST(Explorer, IsStuckNotDoneWhereItHasNoWayToAnywhere) {
  for (const bool has_home : {false, true}) {
    LiveRoadmap live = live_for_explorers();
    std::vector<VoxelChange> panels = room_behind_a_wall();
    for (int z = 0; z < 15; ++z)  // 0.4 m to both sides of it
      for (int x = 0; x < 26; ++x)
        for (const int y : {12, 13, 17, 18}) panels.push_back({{x, y, z}, VoxelState::kOccupied});
    live.set_voxels(panels);
    ExplorerConfig config;
    FlightState state{.position = {2.1, 3.1, 1.5}};
    if (has_home) config.home = state.position;
    Explorer explorer(config);
    ExplorationStep step;
    for (; state.time < 20.0; state.time += 0.25) {
      step = explorer.decide(live.snapshot(), state);
      if (step.status != ExplorationStatus::kKeep) break;
    }
    EXPECT_EQ(step.status, ExplorationStatus::kStuck) << name_of(step.status);
    EXPECT_GT(step.frontiers, 0u);
    for (const UnseenFrontier& left : explorer.unseen())
      EXPECT_EQ(left.reason, UnseenReason::kNotVisited) << name_of(left.reason);
  }
}

TEST(Explorer, RefusesToKeepMoreThanTrajectoriesDo) {
  LiveRoadmap live = live_for_explorers();
  live.set_voxels(room_behind_a_wall());
  ExplorerConfig config;
  config.kept_clearance = 0.6;
  Explorer explorer(config);
  EXPECT_THROW(explorer.decide(live.snapshot(), {.position = {3.1, 3.1, 1.5}}), InputError);
  config.kept_clearance = 0.5;
  Explorer other(config);
  EXPECT_NO_THROW(other.decide(live.snapshot(), {.position = {3.1, 3.1, 1.5}}));
  config.period = -1.0;
  EXPECT_THROW(Explorer{config}, InputError);
}

}  // namespace
}  // namespace ridgeway
