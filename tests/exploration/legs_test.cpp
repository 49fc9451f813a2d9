// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration/legs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exploration/ray_walk.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway {
namespace {

constexpr double kLegsVoxel = 0.2;

/// A free room of 12 x 6 x 3 m, half of it unknown, or with a wall across most of it, where that is
/// asked for.
Roadmap room(bool half_unknown = false, bool is_divided = false) {
  OccupancyBuilder voxels(kLegsVoxel);
  for (int z = -1; z <= 15; ++z)
    for (int y = -1; y <= 30; ++y)
      for (int x = -1; x <= 60; ++x) {
        const bool is_wall = x < 0 || x == 60 || y < 0 || y == 30 || z < 0 || z == 15 ||
                             (is_divided && x == 30 && y < 20);
        if (half_unknown && x >= 30) continue;
        voxels.set({x, y, z}, is_wall ? VoxelState::kOccupied : VoxelState::kFree);
      }
  return build_roadmap(std::move(voxels).finish(), {.min_clearance = 0.4, .tangent_pairs = 0})
      .roadmap;
}

const MotionLimits kLimits = {.max_speed = 2.0, .max_acceleration = 2.0};

TEST(Legs, AStopIsPassedWithoutAHaltAndTheNextOneIsReached) {
  const Roadmap roadmap = room();
  const std::vector<Viewpoint> stops = {{{6.1, 3.1, 1.5}, 0.4}, {{10.9, 3.1, 1.5}, -0.4}};
  const FlightState state = {.position = {1.1, 3.1, 1.5}};
  const auto passing = detail::fly_past(roadmap, kLimits, stops, state, 1.0);
  ASSERT_TRUE(passing);
  const TrajectoryState at = passing->trajectory.at(passing->time);
  EXPECT_LT((at.position - stops[0].position).norm(), 1.0);
  EXPECT_NEAR(at.yaw, stops[0].yaw, 1e-6);
  EXPECT_GT(at.velocity.norm(), 1.5);
  const TrajectoryState end = passing->trajectory.at(passing->trajectory.duration());
  EXPECT_LT((end.position - stops[1].position).norm(), 1e-6);
  EXPECT_LT(end.velocity.norm(), 1e-6);
  EXPECT_NEAR(end.yaw, stops[1].yaw, 1e-6);
  EXPECT_TRUE(find_doubts(roadmap.esdf, passing->trajectory, roadmap.min_clearance).empty());
  MotionPeaks peaks = find_peaks(passing->trajectory);
  EXPECT_TRUE(kLimits.hold(peaks));
}

TEST(Legs, AStopIsNotPassedBeforeTheRobotHasTurned) {
  const Roadmap roadmap = room();
  const std::vector<Viewpoint> stops = {{{2.1, 3.1, 1.5}, std::numbers::pi},
                                        {{9.1, 3.1, 1.5}, 0.0}};
  const FlightState state = {.position = {1.1, 3.1, 1.5}, .velocity = {1.9, 0.0, 0.0}};
  EXPECT_FALSE(detail::fly_past(roadmap, kLimits, stops, state, 1.0));
  const auto halting = detail::fly_to_rest(roadmap, kLimits, stops[0], state);
  ASSERT_TRUE(halting);
  const TrajectoryState end = halting->at(halting->duration());
  EXPECT_LT((end.position - stops[0].position).norm(), 1e-6);
  EXPECT_NEAR(std::abs(end.yaw), std::numbers::pi, 1e-6);
}

TEST(Legs, FromAMotionTheWayOnTakesNoLongerThanFromRest) {
  const Roadmap roadmap = room();
  for (const double y : {1.1, 3.1, 4.9}) {
    const Viewpoint stop = {{9.1, y, 1.5}, 0.0};
    const FlightState rest = {.position = {3.1, 3.1, 1.5}};
    FlightState moving = rest;
    moving.velocity = {1.8, 0.0, 0.0};
    const auto slow = detail::fly_to_rest(roadmap, kLimits, stop, rest);
    const auto quick = detail::fly_to_rest(roadmap, kLimits, stop, moving);
    ASSERT_TRUE(slow && quick);
    EXPECT_LT(quick->duration(), slow->duration()) << y;
  }
}

/// Where it stands too near to a wall, which it may leave if it rests.
TEST(Legs, AMotionThatIsNoneIsRest) {
  const Roadmap roadmap = room();
  const Viewpoint stop = {{9.1, 3.1, 1.5}, 0.0};
  FlightState state = {.position = {0.3, 3.1, 1.5}};
  const auto at_rest = detail::fly_to_rest(roadmap, kLimits, stop, state);
  state.velocity = {1e-12, 0.0, 0.0};
  state.acceleration = {0.0, 1e-11, 0.0};
  const auto hardly_moving = detail::fly_to_rest(roadmap, kLimits, stop, state);
  ASSERT_TRUE(at_rest && hardly_moving);
  EXPECT_EQ(at_rest->duration(), hardly_moving->duration());
}

TEST(RayWalk, UnknownSpaceIsAsDeepAsThereIs) {
  const Roadmap roadmap = room(true);
  FrontierPart part;
  part.normal = {1.0, 0.0, 0.0};
  for (int y = 5; y < 10; ++y) part.targets.push_back({30, y, 7});
  const auto local = [&](VoxelIndex voxel) { return voxel - roadmap.esdf.origin; };
  for (VoxelIndex& target : part.targets) target = local(target);
  const VoxelRange within = {{0, 0, 0}, {59, 29, 14}};
  EXPECT_NEAR(detail::depth_behind(roadmap.esdf, within, part, 2.0), 10.0, 1e-9);
  EXPECT_NEAR(detail::depth_behind(roadmap.esdf, within, part, 50.0), 30.0, 1e-9);
  part.normal = {-1.0, 0.0, 0.0};  // into what is known
  EXPECT_NEAR(detail::depth_behind(roadmap.esdf, within, part, 50.0), 1.0, 1e-9);
  part.normal = {0.1, 0.0, 0.0};  // it faces all sides
  EXPECT_NEAR(detail::depth_behind(roadmap.esdf, within, part, 50.0), 1.0, 1e-9);
}

TEST(Legs, WhatTheWayToRestTakesAtMostIsKnownWithoutIt) {
  const Roadmap roadmap = room(false, true);
  for (const Point& from : {Point(1.1, 1.1, 1.5), Point(3.3, 2.1, 1.1)})
    for (const Point& to : {Point(9.1, 5.1, 1.5), Point(6.3, 1.3, 1.9), from}) {
      const auto flown =
          detail::fly_to_rest(roadmap, kLimits, {to, 0.3}, {.position = from, .yaw = 0.3});
      const double most = detail::most_seconds_to_rest(roadmap, kLimits, from, to);
      ASSERT_EQ(flown.has_value(), std::isfinite(most));
      if (flown) EXPECT_LE(flown->duration(), most + 1e-9);
    }
}

}  // namespace
}  // namespace ridgeway
