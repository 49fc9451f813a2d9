// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Starts and goals where the voxel lattice does not tell all: slots too narrow for a voxel's
// centre, holes that only corners lead through, faces of what is known, places that are off by
// rounding.
#include <gtest/gtest.h>

#include "planning/layout_box.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

bool is_shell(const VoxelIndex& v, const VoxelIndex& last) {
  return v.x == 0 || v.y == 0 || v.z == 0 || v.x == last.x || v.y == last.y || v.z == last.z;
}

VoxelState solid_if(bool is_solid) { return is_solid ? VoxelState::kOccupied : VoxelState::kFree; }

/// A room, and beside it a slot two voxels wide: a robot fits on the face between them alone.
TEST(OddPlaces, ASlotWithoutACentreHasOneRoute) {
  const VoxelIndex last{39, 39, 19};
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, last, [&](const VoxelIndex& v) {
    return solid_if(is_shell(v, last) || (v.y >= 24 && v.y != 30 && v.y != 31));
  });
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.09}).roadmap;
  const Point start(0.5, 3.1, 1.0), goal(3.0, 3.1, 1.0);
  ASSERT_TRUE(plan(roadmap, start, goal).ok());
  const Alternatives routes = plan_alternatives(roadmap, start, goal, 3);
  ASSERT_TRUE(routes.ok());
  EXPECT_TRUE(routes.complete);
  ASSERT_EQ(routes.routes.size(), 1u);
  EXPECT_NEAR(routes.routes[0].length, 2.5, 1e-12);
}

/// Boxes to keep out of leave a hole of 4 cm on the way around a wall, too small for moves between
/// voxels: what corners find is not given up again where more is searched.
TEST(OddPlaces, WhatCornersFindIsKeptWhereVoxelsFindNothing) {
  const VoxelIndex last{59, 59, 19};
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, last, [&](const VoxelIndex& v) {
    return solid_if(is_shell(v, last) || (v.x >= 28 && v.x <= 31 && v.y < 45));
  });
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.3}).roadmap;
  const Point start(1.05, 1.05, 1.05), goal(4.85, 1.05, 1.05);
  const PlanResult quick = plan(roadmap, start, goal, {.quick = true});
  ASSERT_GE(quick.waypoints.size(), 3u);
  const Point hole = 0.5 * (quick.waypoints[1] + quick.waypoints[2]);
  const double x0 = hole.x() - 0.01, x1 = hole.x() + 0.01, half = 0.02;
  PlanConfig config;
  config.limits.keep_out = {
      {Point(x0, -1, -1), Point(x1, hole.y() - half, 5)},
      {Point(x0, hole.y() + half, -1), Point(x1, 9, 5)},
      {Point(x0, hole.y() - 0.03, -1), Point(x1, hole.y() + 0.03, hole.z() - half)},
      {Point(x0, hole.y() - 0.03, hole.z() + half), Point(x1, hole.y() + 0.03, 5)}};
  for (const double within : {0.0, 1.02, 1.0001}) {
    config.within = within;
    EXPECT_TRUE(plan(roadmap, start, goal, config).ok()) << within;
  }
  config.within = 0.0;
  config.prefer_clearance = 1.0;
  EXPECT_TRUE(plan(roadmap, start, goal, config).ok());
}

/// A place on the upper faces of what is known to be free is in it, as one on its lower faces is.
TEST(OddPlaces, FacesOfKnownSpaceBelongToIt) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {39, 39, 19}, [](const VoxelIndex& v) {
    return solid_if(v.x >= 18 && v.x <= 20 && v.y < 30 && v.y > 8);
  });
  for (const UnknownPolicy policy : {UnknownPolicy::kIgnore, UnknownPolicy::kFree}) {
    const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.2, .unknown = policy}).roadmap;
    const Point goal(3.0, 1.05, 1.05);
    for (const Point& place : {Point(1, 1, 0), Point(1, 1, 2), Point(0, 1, 1), Point(4, 1, 1),
                               Point(1, 4, 1), Point(4, 4, 2), Point(0, 0, 2)}) {
      EXPECT_TRUE(plan(roadmap, place, goal).ok()) << place.transpose();
      EXPECT_TRUE(plan(roadmap, goal, place).ok()) << place.transpose();
    }
  }
}

/// So near to a wall that its distance may be rounding there is nothing to escape along.
TEST(OddPlaces, ThereIsNoEscapeFromAFace) {
  const VoxelIndex last{39, 39, 19};
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, last, [&](const VoxelIndex& v) {
    return solid_if(is_shell(v, last) || v.x < 6);
  });
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.25}).roadmap;
  const PlanConfig escaping{.escape = true};
  for (const double x : {0.6, 0.6000000000000001, 0.6 + 1e-9})
    EXPECT_EQ(plan(roadmap, {x, 2, 1}, {3, 2, 1}, escaping).status, PlanStatus::kStartInCollision);
  EXPECT_TRUE(plan(roadmap, {0.61, 2, 1}, {3, 2, 1}, escaping).ok());
}

TEST(OddPlaces, AnEscapeToTheGoalComesOnce) {
  const VoxelIndex last{39, 39, 19};
  const OccupancyMap map = testing::make_map(
      0.1, {0, 0, 0}, last, [&](const VoxelIndex& v) { return solid_if(is_shell(v, last)); });
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.25}).roadmap;
  const Point start(0.15, 2.05, 1.05);
  const PlanResult out = plan(roadmap, start, {3, 2, 1}, {.escape = true});
  ASSERT_GE(out.waypoints.size(), 2u);
  const PlanResult there = plan(roadmap, start, out.waypoints[1], {.escape = true});
  ASSERT_TRUE(there.ok());
  EXPECT_EQ(there.waypoints, (std::vector<Point>{start, out.waypoints[1]}));
}

TEST(OddPlaces, AnEmptyLayoutMeetsNothing) {
  const detail::LayoutBox box{BlockLayout{}};
  EXPECT_FALSE(box.meets({0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(box.meets({-8, -8, -8}, {8, 8, 8}));
}

/// Heights play no part in a plane: not those of paths, not those of goals.
TEST(OddPlaces, HeightsPlayNoPartInAPlane) {
  const VoxelIndex last{59, 59, 7};
  const OccupancyMap walls = testing::make_map(0.1, {0, 0, 0}, last, [&](const VoxelIndex& v) {
    return solid_if(v.x == 0 || v.y == 0 || v.x == last.x || v.y == last.y ||
                    (v.x == 30 && v.y > 10));
  });
  const Roadmap roadmap = build_roadmap(flatten(walls, 0.0, 0.5), {.min_clearance = 0.3}).roadmap;
  const Surroundings around(roadmap.esdf);
  const PlanResult path = plan(roadmap, {1, 3, 0}, {5, 3, 0});
  ASSERT_TRUE(path.ok());
  const PathSurroundings own = around.along(path.waypoints, 0.3);
  for (const double height : {-7.0, 0.0, 5.0}) {
    std::vector<Point> moved = path.waypoints;
    for (Point& p : moved) p.z() = height;
    EXPECT_EQ(around.along(moved, 0.3).known, own.known) << height;
    EXPECT_EQ(given_plan(roadmap.esdf, moved).clearance, path.clearance) << height;
  }
  const std::vector<Point> goals = {{5, 5, 0}, {5, 3, 50}};
  EXPECT_EQ(plan_to_nearest(roadmap, {1, 3, 0}, goals).goal, 1u);
}

}  // namespace
}  // namespace ridgeway
