// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/plan.hpp"

#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/brute_force.hpp"
#include "support/flood.hpp"
#include "support/random_maps.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

using testing::Shape;

Roadmap build(const OccupancyMap& map, double min_clearance,
              UnknownPolicy policy = UnknownPolicy::kObstacle) {
  return build_roadmap(map, {.min_clearance = min_clearance, .unknown = policy}).roadmap;
}

Roadmap build_shape(const std::string& name) {
  const Shape shape = testing::test_shape(name);
  return build(shape.map(), shape.min_clearance);
}

/// Those of the obstacles that can be nearer than a distance to a point between two, voxel units.
std::vector<VoxelIndex> obstacles_beside(const Point& a, const Point& b, double distance,
                                         const std::vector<VoxelIndex>& obstacles) {
  const Point low = a.cwiseMin(b) - Point::Constant(distance + 1.0);
  const Point high = a.cwiseMax(b) + Point::Constant(distance);
  std::vector<VoxelIndex> beside;
  for (const VoxelIndex& v : obstacles)
    if (v.x >= low.x() && v.y >= low.y() && v.z >= low.z() && v.x <= high.x() && v.y <= high.y() &&
        v.z <= high.z())
      beside.push_back(v);
  return beside;
}

/// Every point of a path, densely, by brute force against every obstacle voxel of the map.
void expect_brute_clearance(const OccupancyMap& map, const std::vector<VoxelIndex>& obstacles,
                            UnknownPolicy policy, const PlanResult& result, double radius) {
  const double least = radius * (1 - 1e-8) / map.voxel_size;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i) {
    const Point a = result.waypoints[i - 1], b = result.waypoints[i];
    const auto beside = obstacles_beside(a / map.voxel_size, b / map.voxel_size, least, obstacles);
    const int pieces = static_cast<int>((b - a).norm() / (0.3 * map.voxel_size)) + 1;
    for (int k = 0; k <= pieces; ++k) {
      const Point p = a + (b - a) * k / pieces;
      ASSERT_GE(std::sqrt(testing::brute_squared_distance(p / map.voxel_size, beside)), least);
      if (policy == UnknownPolicy::kIgnore) {
        ASSERT_NE(map.at(voxel_at(p, map.voxel_size)), VoxelState::kOccupied);
      }
    }
  }
}

TEST(Plan, AnswersExactlyWhenFloodingDoesAndItsPathsHoldByBruteForce) {
  int routes = 0, none = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const OccupancyMap map = testing::random_map(seed, 22);
    std::optional<Roadmap> roadmap;
    try {
      roadmap = build(map, 0.1, policy);
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    const EsdfMap& esdf = roadmap->esdf;
    const std::vector<VoxelIndex> obstacles = testing::all_obstacles(map, policy);
    std::mt19937 random(seed);
    for (const double radius : {0.1, 0.125, 0.15, 0.2}) {
      const testing::Regions regions = testing::regions_at(esdf, radius);
      if (regions.voxels.empty()) continue;
      for (int i = 0; i < 12; ++i) {
        const VoxelId from = regions.voxels[random() % regions.voxels.size()];
        const VoxelId to = regions.voxels[random() % regions.voxels.size()];
        const Point start = centre_of(esdf.layout.index_of(from), esdf.voxel_size);
        const Point goal = centre_of(esdf.layout.index_of(to), esdf.voxel_size);
        const bool connected = regions.label.at(from) == regions.label.at(to);
        for (const Planner planner : {Planner::kGraph, Planner::kDiagram, Planner::kEsdf})
          for (const bool shorten : {true, false}) {
            const PlanResult result = plan(
                *roadmap, start, goal, {.planner = planner, .radius = radius, .shorten = shorten});
            ASSERT_EQ(result.unknown, policy);
            if (connected) {
              ASSERT_TRUE(result.ok());
              ASSERT_EQ(result.waypoints.front(), start);
              ASSERT_EQ(result.waypoints.back(), goal);
              ASSERT_GE(result.clearance, radius * (1 - 1e-9));
              ASSERT_NEAR(result.clearance, FreeSpace(esdf).clearance(result.waypoints), 1e-9);
              if (planner == Planner::kGraph)
                expect_brute_clearance(map, obstacles, policy, result, radius);
              if (HasFatalFailure()) return;
            } else if (!result.ok()) {
              ASSERT_EQ(result.status, PlanStatus::kNoRoute);
            } else {  // only a straight look may know more than the lattice
              ASSERT_EQ(result.waypoints.size(), 2u);
            }
          }
        ++(connected ? routes : none);
      }
    }
  }
  EXPECT_GT(routes, 300);
  EXPECT_GT(none, 50);
}

TEST(Plan, TestShapesHoldTheirContract) {
  for (const Shape& shape : testing::test_shapes()) {
    SCOPED_TRACE(shape.name);
    const BuildResult built = build_roadmap(shape.map(), {.min_clearance = shape.min_clearance});
    EXPECT_EQ(built.report.traversable_components, 1u);
    EXPECT_EQ(built.report.graph_components, 1u);
    const CheckReport report = check_roadmap(built.roadmap, {.queries = 60, .seed = 3});
    EXPECT_TRUE(report.is_clean());
    EXPECT_EQ(report.graph_ok, report.esdf_ok);
    EXPECT_GT(report.graph_ok, 10u);
    EXPECT_LE(report.length_ratio.max, 1.25);
  }
}

TEST(Plan, PassesADoorOfExactlyTheRobotsWidthAndNoNarrower) {
  // The door is 0.6 m: voxel centres of 0.25 .. 0.75 in y fit a radius of 0.3 with nothing to
  // spare.
  const Roadmap roadmap = build_shape("door_of_the_robots_width");
  const Point start(1.05, 1.55, 0.55), goal(5.05, 1.55, 0.55);
  const PlanResult fits = plan(roadmap, start, goal);
  ASSERT_TRUE(fits.ok());
  const PlanResult too_wide = plan(roadmap, start, goal, {.radius = 0.36});
  EXPECT_EQ(too_wide.status, PlanStatus::kNoRoute);
}

/// Whether a place sees the centre of a traversable voxel, up to `reach` voxels off on each axis.
bool sees_a_centre(const EsdfMap& esdf, const Point& place, double radius, int reach) {
  const FreeSpace space(esdf);
  const VoxelIndex home = voxel_at(place, esdf.voxel_size);
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Point centre = centre_of(home + VoxelIndex{x, y, z}, esdf.voxel_size);
        if (space.is_free(centre, radius) && space.is_free(place, centre, radius)) return true;
      }
  return false;
}

// Among specks a robot fits between places where no centre of a voxel beside it does.
TEST(Plan, BeginsWhereACentreIsInSightThoughNoneBesideItIsFree) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(1.0, 15.0);
  std::size_t farther = 0, alone = 0;
  for (int map = 0; map < 20; ++map) {
    const Roadmap roadmap = build(
        testing::make_map(1.0, {0, 0, 0}, {15, 15, 15},
                          [&](const VoxelIndex&) {
                            return random() % 50 == 0 ? VoxelState::kOccupied : VoxelState::kFree;
                          }),
        1.7);
    for (int i = 0; i < 2000; ++i) {
      const Point place(at(random), at(random), at(random));
      const Point local = to_local(roadmap.esdf, place);
      if (!FreeSpace(roadmap.esdf).is_free(local, 1.7)) continue;
      const bool is_refused =
          describe_place(roadmap, place).status == PlanStatus::kStartInCollision;
      EXPECT_EQ(is_refused, !sees_a_centre(roadmap.esdf, local, 1.7, 3)) << place.transpose();
      farther += !is_refused && !sees_a_centre(roadmap.esdf, local, 1.7, 1);
      alone += is_refused;
    }
  }
  EXPECT_GT(farther, 20u);
  EXPECT_GT(alone, 0u);
}

// A corridor whose axis fits the robot, but lies between the centres of voxels.
TEST(Plan, FliesStraightWhereNoCentreOfAVoxelFits) {
  const Roadmap roadmap = build(
      testing::make_map(0.1, {0, 0, 0}, {39, 11, 11},
                        [](const VoxelIndex& v) {
                          const bool is_corridor =
                              v.x > 0 && v.x < 39 && v.y > 2 && v.y < 9 && v.z > 2 && v.z < 9;
                          const bool is_room =
                              v.x > 0 && v.x < 12 && v.y > 0 && v.y < 11 && v.z > 0 && v.z < 11;
                          return is_corridor || is_room ? VoxelState::kFree : VoxelState::kOccupied;
                        }),
      0.28);
  const Point room(0.6, 0.6, 0.6), inside(3.0, 0.6, 0.6), end(3.4, 0.6, 0.6);
  for (const Planner planner : {Planner::kGraph, Planner::kEsdf, Planner::kDiagram})
    for (const auto& [from, to] : {std::pair(inside, end), std::pair(room, end)}) {
      const PlanResult result = plan(roadmap, from, to, {.planner = planner});
      ASSERT_TRUE(result.ok()) << name_of(result.status);
      EXPECT_NEAR(result.clearance, 0.3, 1e-9);
    }
  EXPECT_EQ(plan(roadmap, inside, Point(0.45, 0.45, 0.9)).status, PlanStatus::kStartInCollision);
}

TEST(Plan, NoWaypointComesTwice) {
  const Roadmap roadmap = build_shape("floating_box");
  const double s = roadmap.esdf.voxel_size;
  std::mt19937 random(8);
  int solved = 0;
  for (int i = 0; i < 200; ++i) {
    std::array<Point, 2> ends;  // centres of voxels, the same at times
    for (Point& end : ends)
      for (double& x : end) x = s * (static_cast<double>(random() % 40) + 0.5);
    if (i % 20 == 0) ends[1] = ends[0];
    for (const bool shorten : {false, true})
      for (const Planner planner : {Planner::kGraph, Planner::kEsdf, Planner::kDiagram}) {
        const PlanResult result =
            plan(roadmap, ends[0], ends[1], {.planner = planner, .shorten = shorten});
        if (!result.ok()) continue;
        ++solved;
        ASSERT_GE(result.waypoints.size(), 2u);
        if (ends[0] == ends[1]) continue;
        EXPECT_EQ(std::adjacent_find(result.waypoints.begin(), result.waypoints.end()),
                  result.waypoints.end());
      }
  }
  EXPECT_GT(solved, 100);
}

TEST(Plan, FliesStraightWhereStartAndGoalSeeEachOther) {
  const Roadmap roadmap = build_shape("in_sight_of_each_other");
  const Point start(0.62, 0.55, 0.6), goal(4.4, 0.61, 0.58);
  const PlanResult result = plan(roadmap, start, goal);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.waypoints.size(), 2u);
  EXPECT_NEAR(result.length, (goal - start).norm(), 1e-12);
}

TEST(Plan, KnowsHallsLargerThanMaxDistance) {
  const OccupancyMap hall =
      testing::make_map(0.1, {0, 0, 0}, {59, 59, 39}, [](const VoxelIndex& v) {
        const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 59 || v.y == 59 || v.z == 39;
        return wall ? VoxelState::kOccupied : VoxelState::kFree;
      });
  const BuildResult built = build_roadmap(hall, {.min_clearance = 0.3, .max_distance = 1.0});
  EXPECT_EQ(built.report.graph_components, 1u);
  const CheckReport report = check_roadmap(built.roadmap, {.queries = 100, .seed = 5});
  EXPECT_TRUE(report.is_clean());
  EXPECT_GT(report.graph_ok, 90u);  // a few start too close to a wall
  EXPECT_THROW(plan(built.roadmap, Point(3, 3, 2), Point(1, 1, 1), {.radius = 0.9}), InputError);
}

TEST(Plan, GivesTheOneReasonWhyThereIsNoPath) {
  const Roadmap roadmap = build_shape("floating_box");
  const Point good(0.6, 0.6, 0.6);
  const auto status = [&](const Point& a, const Point& b, double radius = 0.2) {
    return name_of(plan(roadmap, a, b, {.radius = radius}).status);
  };
  EXPECT_EQ(status(Point(-50, 0, 0), good), "start_outside_map");
  EXPECT_EQ(status(good, Point(1e300, 0, 0)), "goal_outside_map");
  EXPECT_EQ(status(Point(2, 2, 1.5), good), "start_in_collision");  // in the box
  EXPECT_EQ(status(good, Point(0.15, 2, 1)), "goal_in_collision");  // beside the wall
  EXPECT_EQ(status(good, good, 0.1), "radius_too_small");
  EXPECT_EQ(status(good, good), "ok");
  EXPECT_THROW(status(Point(std::nan(""), 0, 0), good), InputError);
  EXPECT_THROW(status(good, good, -0.3), InputError);
  EXPECT_THROW(status(good, good, std::nan("")), InputError);
  const OccupancyMap half = testing::make_map(
      0.1, {0, 0, 0}, {31, 15, 15},
      [](const VoxelIndex& v) { return v.x < 16 ? VoxelState::kFree : VoxelState::kUnknown; });
  const Roadmap half_known = build(half, 0.2);
  EXPECT_EQ(plan(half_known, Point(0.8, 0.8, 0.8), Point(2.5, 0.8, 0.8)).status,
            PlanStatus::kGoalUnknown);
}

TEST(Plan, IsSafeToCallFromManyThreadsAndRepeats) {
  const Roadmap roadmap = build_shape("ring_in_a_room");
  const auto work = [&](std::vector<PlanResult>& results) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> x(0.5, 3.9), z(0.4, 2.0);
    for (int i = 0; i < 100; ++i)
      results.push_back(plan(roadmap, Point(x(random), x(random), z(random)),
                             Point(x(random), x(random), z(random))));
  };
  std::vector<std::vector<PlanResult>> results(4);
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (auto& mine : results) threads.emplace_back([&] { work(mine); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 1; t < results.size(); ++t)
    for (std::size_t i = 0; i < results[0].size(); ++i) {
      ASSERT_EQ(results[t][i].status, results[0][i].status);
      ASSERT_EQ(results[t][i].waypoints, results[0][i].waypoints);
    }
}

TEST(Plan, EnumeratorsMadeByACastAreRefusedAndHaveNoName) {
  for (const int value : {10, 11, 200, 255}) {
    const auto planner = static_cast<Planner>(value);
    EXPECT_EQ(name_of(planner), "invalid");
    EXPECT_THROW(PlanConfig{.planner = planner}.validate(), InputError);
  }
  EXPECT_EQ(name_of(static_cast<PlanStatus>(12)), "invalid");
  EXPECT_EQ(name_of(static_cast<UnknownPolicy>(3)), "invalid");
  for (const char* name : {"graph", "informedrrtstar"})
    EXPECT_EQ(name_of(planner_named(name).value()), name);
  EXPECT_FALSE(planner_named("invalid"));
  // Paths that were given say so; nothing is planned that way.
  EXPECT_EQ(name_of(Planner::kGiven), "given");
  EXPECT_FALSE(planner_named("given"));
  EXPECT_THROW(PlanConfig{.planner = Planner::kGiven}.validate(), InputError);
}

}  // namespace
}  // namespace ridgeway
