// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/brute_force.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

const FlightLimits kNoLimits;

/// How far an upright cylinder, voxels, is from sharing volume with a cube: negative where it does.
double gap(const Point& centre, double radius, double half, const VoxelIndex& cube) {
  const double dx = std::max({cube.x - centre.x(), centre.x() - cube.x - 1.0, 0.0});
  const double dy = std::max({cube.y - centre.y(), centre.y() - cube.y - 1.0, 0.0});
  const double above = std::max(cube.z - centre.z() - half, centre.z() - half - cube.z - 1.0);
  return std::max(std::hypot(dx, dy) - radius, above);
}
double gap(const Point& centre, double radius, double half, const std::vector<VoxelIndex>& cubes) {
  double least = std::numeric_limits<double>::infinity();
  for (const VoxelIndex& cube : cubes) least = std::min(least, gap(centre, radius, half, cube));
  return least;
}

/// Segments that were free, and that were not.
struct Counts {
  int free = 0, shut = 0;

  /// Asks at many places of the way, by all cubes; what only just fits or does not is passed over.
  void expect_as_brute_force(const FreeSpace& space, const Point& a, const Point& b, double radius,
                             double height, const std::vector<VoxelIndex>& cubes) {
    constexpr int kPieces = 200;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kPieces; ++k)
      least = std::min(
          least, gap((a + (b - a) * k / kPieces) / 0.1, radius / 0.1, 0.5 * height / 0.1, cubes));
    const double step = (b - a).norm() / 0.1 / kPieces;
    if (least > step + 1e-6) {
      EXPECT_TRUE(space.is_free(a, b, radius)) << radius << " " << height << " " << a.transpose();
      ++free;
    } else if (least < -1e-6) {
      EXPECT_FALSE(space.is_free(a, b, radius)) << radius << " " << height << " " << a.transpose();
      ++shut;
    }
  }
};

TEST(Cylinder, IsFreeWhereItSharesNoVolumeWithAnObstacleOnTheWay) {
  Counts counts;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 14);
    const EsdfMap esdf = compute_esdf(map);
    const auto cubes = testing::all_obstacles(map, UnknownPolicy::kObstacle);
    std::vector<VoxelId> open;
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (esdf.is_open(id) && esdf.squared[id] > 4) open.push_back(id);
    if (open.empty()) continue;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
      const double radius = 0.05 + 0.3 * unit(random), height = 0.05 + 0.5 * unit(random);
      const FreeSpace space(esdf, kNoLimits, radius, height);
      const Point a = centre_of(esdf.layout.index_of(open[random() % open.size()]), 0.1);
      Point along(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
      if (i % 4 == 0) along.z() = 0.0;
      if (i % 4 == 1) along.x() = along.y() = 0.0;
      if (i % 7 == 0) along.setZero();
      const Point b = a + 0.8 * along;
      const Point reach(radius + 0.2, radius + 0.2, 0.5 * height + 0.2);
      std::vector<VoxelIndex> near;  // all that can be touched on the way
      for (const VoxelIndex& cube : cubes)
        if (((centre_of(cube, 0.1) - a.cwiseMin(b)).array() > -reach.array()).all() &&
            ((centre_of(cube, 0.1) - a.cwiseMax(b)).array() < reach.array()).all())
          near.push_back(cube);
      counts.expect_as_brute_force(space, a, b, radius, height, near);
    }
  }
  EXPECT_GT(counts.free, 150);
  EXPECT_GT(counts.shut, 500);
}

TEST(Cylinder, IsFreeOrNotHoweverManyBlocksItPassesThrough) {
  Counts counts;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<VoxelIndex> cubes;
    const OccupancyMap map =
        testing::make_map(0.1, {0, 0, 0}, {63, 63, 63}, [&](const VoxelIndex& v) {
          if (random() % 8000 != 0) return VoxelState::kFree;
          cubes.push_back(v);
          return VoxelState::kOccupied;
        });
    const double far = seed % 2 == 0 ? std::numeric_limits<double>::infinity() : 1.2;
    const EsdfMap esdf = compute_esdf(map, {.unknown = UnknownPolicy::kFree, .max_distance = far});
    std::uniform_real_distribution<double> unit(0.0, 1.0), place(1.0, 5.4);
    for (int i = 0; i < 200; ++i) {
      const double radius = 0.1 + 0.9 * unit(random), height = 0.1 + 3.9 * unit(random);
      const FreeSpace space(esdf, kNoLimits, radius, height);
      const Point a(place(random), place(random), place(random));
      Point b = a + Point(unit(random) - 0.5, unit(random) - 0.5, i % 3 == 0 ? 0.0 : unit(random));
      if (i % 5 == 0) b = a;
      counts.expect_as_brute_force(space, a, b, radius, height, cubes);
    }
  }
  EXPECT_GT(counts.free, 500);
  EXPECT_GT(counts.shut, 500);
}

TEST(Cylinder, TouchingIsNoCollision) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {40, 20, 12}, [](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 40 || v.y == 20 || v.z == 12;
    return hull ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const EsdfMap esdf = compute_esdf(map);  // free from 0.1 to 1.2 in z, to 2 in y
  const Point a(1.5, 1.05, 0.65), b(2.5, 1.05, 0.65);
  EXPECT_TRUE(FreeSpace(esdf, kNoLimits, 0.95, 1.1).is_free(a, b, 0.95));
  EXPECT_FALSE(FreeSpace(esdf, kNoLimits, 0.95, 1.1002).is_free(a, b, 0.95));
  EXPECT_FALSE(FreeSpace(esdf, kNoLimits, 0.9501, 1.1).is_free(a, b, 0.9501));
  EXPECT_FALSE(FreeSpace(esdf, kNoLimits, 0.95, 1.1).is_free(a, b + Point(0, 0, 0.001), 0.95));
}

/// A flood over voxels by the gaps of the cylinder at their centres and between them.
bool connects(const EsdfMap& esdf, const FreeSpace& space, double radius, VoxelId from,
              VoxelId to) {
  std::set<VoxelId> seen{from};
  std::vector<VoxelId> open{from};
  while (!open.empty()) {
    const VoxelId here = open.back();
    open.pop_back();
    if (here == to) return true;
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf.layout.neighbour(here, d);
      if (next == kNoVoxel || seen.contains(next) ||
          !space.is_free(centre_of(esdf.layout.index_of(here), esdf.voxel_size),
                         centre_of(esdf.layout.index_of(next), esdf.voxel_size), radius))
        continue;
      seen.insert(next);
      open.push_back(next);
    }
  }
  return false;
}

TEST(Cylinder, PlansExactlyWhereVoxelsAreConnectedForIt) {
  int routes = 0, none = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const double radius = seed % 2 == 0 ? 0.22 : 0.11, height = seed % 2 == 0 ? 0.22 : 0.48;
    Roadmap roadmap;
    try {
      roadmap =
          build_roadmap(testing::random_map(seed, 20), {.min_clearance = 0.1, .tangent_pairs = 50})
              .roadmap;
    } catch (const InputError&) {
      continue;
    }
    const EsdfMap& esdf = roadmap.esdf;
    const FreeSpace space(esdf, kNoLimits, radius, height);
    std::vector<VoxelId> places;
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (esdf.is_open(id) &&
          space.is_free(centre_of(esdf.layout.index_of(id), esdf.voxel_size), radius))
        places.push_back(id);
    if (places.empty()) continue;
    std::mt19937 random(seed);
    for (int i = 0; i < 5; ++i) {
      const VoxelId from = places[random() % places.size()], to = places[random() % places.size()];
      const Point start = centre_of(esdf.layout.index_of(from), esdf.voxel_size);
      const Point goal = centre_of(esdf.layout.index_of(to), esdf.voxel_size);
      const bool expected =
          space.is_free(start, goal, radius) || connects(esdf, space, radius, from, to);
      for (const Planner planner : {Planner::kGraph, Planner::kEsdf, Planner::kThetaStar}) {
        const PlanResult result = plan(
            roadmap, start, goal, {.planner = planner, .radius = radius, .robot_height = height});
        ASSERT_EQ(result.ok(), expected) << name_of(planner);
        result.ok() ? ++routes : ++none;
        for (std::size_t k = 1; k < result.waypoints.size(); ++k)
          ASSERT_TRUE(space.is_free(result.waypoints[k - 1], result.waypoints[k], radius));
      }
    }
  }
  EXPECT_GT(routes, 60);
  EXPECT_GT(none, 10);
}

/// A room 6 x 4 x 2 m with a wall at x = 3; what is open in it goes by its place.
template <typename Open>
Roadmap room_with_wall(const Open& open, double min_clearance) {
  const OccupancyMap map =
      testing::make_map(0.1, {0, 0, 0}, {61, 41, 21}, [&](const VoxelIndex& v) {
        const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 61 || v.y == 41 || v.z == 21;
        const bool wall = (v.x == 30 || v.x == 31) && !open(v);
        return hull || wall ? VoxelState::kOccupied : VoxelState::kFree;
      });
  return build_roadmap(map, {.min_clearance = min_clearance}).roadmap;
}

TEST(Cylinder, GoesWhereNoSphereOfItsRadiusGoes) {
  // A slit 0.4 m high and 2 m wide: a flat robot passes, a sphere of its radius does not.
  const Roadmap slit = room_with_wall(
      [](const VoxelIndex& v) { return v.z >= 5 && v.z < 9 && v.y >= 10 && v.y < 30; }, 0.15);
  const Point start(1, 2, 0.7), goal(5, 2, 0.7);
  EXPECT_EQ(plan(slit, start, goal, {.radius = 0.4}).status, PlanStatus::kNoRoute);
  const PlanResult flat = plan(slit, start, goal, {.radius = 0.4, .robot_height = 0.3});
  ASSERT_TRUE(flat.ok());
  EXPECT_EQ(flat.answered_by, Planner::kGraph);
  EXPECT_GE(flat.clearance, 0.15 * (1 - 1e-9));
  // A slit 0.5 m wide and 2 m high: a slim and tall one passes; lying across it would not.
  const Roadmap tall =
      room_with_wall([](const VoxelIndex& v) { return v.y >= 18 && v.y < 23; }, 0.2);
  EXPECT_TRUE(
      plan(tall, Point(1, 2, 1.1), Point(5, 2, 1.1), {.radius = 0.24, .robot_height = 1.6}).ok());
  EXPECT_EQ(
      plan(tall, Point(1, 2, 1.1), Point(5, 2, 1.1), {.radius = 0.26, .robot_height = 1.6}).status,
      PlanStatus::kNoRoute);
  EXPECT_EQ(plan(tall, start, goal, {.radius = 0.24, .robot_height = 1.6}).status,
            PlanStatus::kStartInCollision);  // it would stand in the floor
}

/// A hall 8 x 8 x 2 m with thin walls that hang or stand, of which spheres pass each, above or
/// below.
Roadmap hall_of_low_walls(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<VoxelRange> walls;
  for (int i = 0; i < 16; ++i) {
    const int x = 1 + below(75), y = 1 + below(75);
    const VoxelIndex low = {x, y, i % 4 == 0 ? 1 : 9};
    walls.push_back({low, low + (i % 2 == 0 ? VoxelIndex{1, 20, 11} : VoxelIndex{20, 1, 11})});
  }
  const OccupancyMap map =
      testing::make_map(0.1, {0, 0, 0}, {81, 81, 21}, [&](const VoxelIndex& v) {
        const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 81 || v.y == 81 || v.z == 21;
        const bool wall = std::any_of(walls.begin(), walls.end(),
                                      [&](const VoxelRange& range) { return range.contains(v); });
        return hull || wall ? VoxelState::kOccupied : VoxelState::kFree;
      });
  return build_roadmap(map, {.min_clearance = 0.3}).roadmap;
}

TEST(Cylinder, PathsAreNearShortestWhereSpheresPassBelow) {
  for (const unsigned seed : {1u, 4u, 7u, 10u}) {
    const CheckReport report =
        check_roadmap(hall_of_low_walls(seed), {.queries = 150, .seed = seed, .robot_height = 1.4});
    EXPECT_TRUE(report.is_clean());
    EXPECT_GT(report.graph_ok, 50u) << seed;
    EXPECT_LE(report.length_ratio.max, 1.15) << seed;
  }
}

TEST(Cylinder, ChecksAlternativesAndBadHeights) {
  const Roadmap doors = room_with_wall(
      [](const VoxelIndex& v) { return (v.y >= 5 && v.y < 15) || (v.y >= 26 && v.y < 36); }, 0.2);
  const CheckReport report = check_roadmap(doors, {.queries = 60, .robot_height = 1.0});
  EXPECT_TRUE(report.is_clean());
  EXPECT_EQ(report.graph_ok, 60u);
  EXPECT_LT(report.fallbacks, 12u);
  const Alternatives routes = plan_alternatives(doors, Point(1, 2, 1.1), Point(5, 2.1, 1.1), 3,
                                                {.radius = 0.3, .robot_height = 1.0});
  ASSERT_TRUE(routes.ok());
  EXPECT_EQ(routes.routes.size(), 2u);
  const Point a(1, 2, 1.1), b(5, 2, 1.1);
  EXPECT_EQ(plan(doors, a, b, {.radius = 0.4, .robot_height = 0.3}).status,
            PlanStatus::kRadiusTooSmall);  // the graph is for spheres of 0.2
  EXPECT_THROW(check_roadmap(doors, {.queries = 1, .robot_height = 0.3}), InputError);
  for (const double height : {-1.0, std::nan(""), 1e300})
    EXPECT_THROW(plan(doors, a, b, {.robot_height = height}), InputError);
  EXPECT_THROW(plan(doors, a, b, {.escape = true, .robot_height = 1.0}), InputError);
}

}  // namespace
}  // namespace ridgeway
