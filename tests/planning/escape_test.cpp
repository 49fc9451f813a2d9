// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "planning/escape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/brute_force.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kEscapeVoxel = 0.1, kEscapeRadius = 0.2;

/// A room with a few boxes in it; a corner of it is unknown.
OccupancyMap room_with_boxes(unsigned seed, int boxes = 3) {
  std::mt19937 random(seed);
  std::vector<VoxelIndex> corners;
  corners.reserve(static_cast<std::size_t>(boxes));
  for (int i = 0; i < boxes; ++i)
    corners.push_back({static_cast<int>(random() % 20) + 2, static_cast<int>(random() % 20) + 2,
                       static_cast<int>(random() % 8) + 1});
  return testing::make_map(kEscapeVoxel, {0, 0, 0}, {25, 25, 13}, [&](const VoxelIndex& v) {
    bool solid = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 25 || v.y == 25 || v.z == 13;
    for (const VoxelIndex& c : corners)
      solid |=
          v.x >= c.x && v.x < c.x + 3 && v.y >= c.y && v.y < c.y + 3 && v.z >= c.z && v.z < c.z + 4;
    if (solid) return VoxelState::kOccupied;
    return v.x > 22 && v.y > 22 ? VoxelState::kUnknown : VoxelState::kFree;
  });
}

/// Along the leg from a too close place `end` to `place`, by brute force: in known-free voxels, and
/// never nearer to an obstacle than a moment before.
void expect_rising_leg(const OccupancyMap& map, const std::vector<VoxelIndex>& obstacles,
                       const Point& end, const Point& place, const Escape& escape) {
  EXPECT_NEAR(escape.length, (place - end).norm(), 1e-12);
  EXPECT_LE(escape.length, 2.0 * kEscapeRadius);
  const auto distance = [&](const Point& p) {
    return kEscapeVoxel * std::sqrt(testing::brute_squared_distance(p / kEscapeVoxel, obstacles));
  };
  EXPECT_NEAR(distance(end), escape.clearance, 1e-9);
  EXPECT_GE(distance(place), kEscapeRadius * (1.0 - 1e-9));
  constexpr int kSteps = 97;
  double last = distance(end);
  for (int k = 0; k <= kSteps; ++k) {
    const Point p = end + (place - end) * (static_cast<double>(k) / kSteps);
    EXPECT_EQ(map.at(voxel_at(p, kEscapeVoxel)), VoxelState::kFree);
    EXPECT_GE(distance(p), last - 1e-9);
    last = distance(p);
  }
}

TEST(Escape, LegsRiseInKnownFreeSpaceAndTheRestIsVerified) {
  int escaped = 0, refused = 0, plain = 0;
  for (unsigned seed = 0; seed < 14; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = seed % 2 == 0 ? UnknownPolicy::kObstacle : UnknownPolicy::kIgnore;
    const OccupancyMap map = room_with_boxes(seed);
    const std::vector<VoxelIndex> obstacles = testing::all_obstacles(map, policy);
    const Roadmap roadmap =
        build_roadmap(map, {.min_clearance = kEscapeRadius, .unknown = policy}).roadmap;
    const FreeSpace space(roadmap.esdf);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.0, 2.6), z(0.0, 1.4);
    for (int i = 0; i < 25; ++i) {
      const Point start(x(random), x(random), z(random)), goal(x(random), x(random), z(random));
      const PlanResult without = plan(roadmap, start, goal);
      const PlanResult result = plan(roadmap, start, goal, {.escape = true});
      if (without.ok()) {  // nothing to escape from
        EXPECT_EQ(result.waypoints, without.waypoints);
        EXPECT_EQ(result.escape_start.length + result.escape_goal.length, 0.0);
        ++plain;
        continue;
      }
      if (!result.ok()) {
        ++refused;
        continue;
      }
      ++escaped;
      ASSERT_EQ(result.waypoints.front(), start);
      ASSERT_EQ(result.waypoints.back(), goal);
      std::span<const Point> rest = result.waypoints;
      if (result.escape_start.length > 0.0) {
        expect_rising_leg(map, obstacles, start, rest[1], result.escape_start);
        rest = rest.subspan(1);
      }
      if (result.escape_goal.length > 0.0) {
        expect_rising_leg(map, obstacles, goal, rest[rest.size() - 2], result.escape_goal);
        rest = rest.first(rest.size() - 1);
      }
      EXPECT_GE(space.clearance(rest), kEscapeRadius * (1.0 - 1e-9));
      EXPECT_NEAR(result.clearance, space.clearance(rest), 1e-9);
      double length = 0.0;
      for (std::size_t k = 1; k < result.waypoints.size(); ++k)
        length += (result.waypoints[k] - result.waypoints[k - 1]).norm();
      EXPECT_NEAR(result.length, length, 1e-12);
    }
  }
  EXPECT_GT(escaped, 70);
  EXPECT_GT(refused, 50);
  EXPECT_GT(plain, 20);
}

TEST(Escape, NeverLeavesAnObstacleOrTheUnknown) {
  const Roadmap roadmap =
      build_roadmap(room_with_boxes(0), {.min_clearance = kEscapeRadius}).roadmap;
  const Point good(1.25, 1.25, 0.7);
  const auto status = [&](const Point& start) {
    return plan(roadmap, start, good, {.escape = true}).status;
  };
  EXPECT_EQ(status(Point(0.05, 1.2, 0.7)), PlanStatus::kStartInCollision);  // in the wall
  EXPECT_EQ(status(Point(0.1, 1.2, 0.7)), PlanStatus::kStartInCollision);   // touches it
  EXPECT_EQ(status(Point(2.45, 2.45, 0.7)), PlanStatus::kStartUnknown);
  EXPECT_EQ(status(Point(-9, 0, 0)), PlanStatus::kStartOutsideMap);
}

/// The plain form of the search: every voxel of the map, nearest first, until one will do.
std::optional<Point> nearest_place(const EsdfMap& esdf, const Point& point, double radius) {
  const FreeSpace space(esdf);
  if (space.distance(point) <= 0.0) return std::nullopt;
  std::vector<std::tuple<double, VoxelIndex>> places;
  for (const VoxelId id : testing::traversable_places(esdf, radius)) {
    const VoxelIndex voxel = esdf.layout.index_of(id);
    const double distance = (centre_of(voxel, 1.0) - point / esdf.voxel_size).norm();
    if (distance > 0.0 && distance <= 2.0 * radius / esdf.voxel_size)
      places.emplace_back(distance, voxel);
  }
  std::sort(places.begin(), places.end());
  for (const auto& [distance, voxel] : places) {
    const Point place = centre_of(voxel, esdf.voxel_size);
    if (!space.is_known_free(point, place)) continue;
    const int steps = 1 + static_cast<int>(distance * 32.0);
    bool rises = space.clearance(point, place) >= space.distance(point) - 1e-9;
    for (double k = 1.0, last = space.distance(point); rises && k <= steps; ++k) {
      const double here = space.distance(point + (place - point) * (k / steps));
      rises = here >= last - 1e-9;
      last = here;
    }
    const double before_end = 1.0 - std::min(1e-3 / distance, 0.5);
    if (rises && space.distance(point + (place - point) * ((steps - 1.0) / steps)) <=
                     space.distance(point + (place - point) * before_end) + 1e-9)
      return place;
  }
  return std::nullopt;
}

TEST(Escape, LeadsToTheNearestPlaceThatALookAtEveryVoxelFinds) {
  int found = 0, none = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = seed % 2 == 0 ? UnknownPolicy::kObstacle : UnknownPolicy::kIgnore;
    const EsdfMap esdf = compute_esdf(room_with_boxes(seed), {.unknown = policy});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.0, 2.6), z(0.0, 1.4);
    for (int i = 0; i < 25; ++i) {
      const Point point(x(random), x(random), z(random));
      for (const double radius : {0.1, 0.2, 0.33, 0.6}) {
        const std::optional<Point> expected = nearest_place(esdf, point, radius);
        const detail::EscapeResult escape =
            detail::find_escape(esdf, point, radius, detail::Deadline::never());
        ASSERT_EQ(escape.status == detail::SearchStatus::kFound, expected.has_value());
        if (expected) {
          EXPECT_EQ(escape.place, *expected);
        }
        ++(expected ? found : none);
      }
    }
  }
  EXPECT_GT(found, 400);
  EXPECT_GT(none, 100);
}

TEST(Escape, LooksNoFartherThanTheMapHoweverLargeTheRadius) {
  for (const UnknownPolicy policy : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore}) {
    const Roadmap roadmap =
        build_roadmap(room_with_boxes(1), {.min_clearance = kEscapeRadius, .unknown = policy})
            .roadmap;
    for (const double radius : {50.0, 1e3, 1e6, 1e9, 1e12, 1e300}) {
      const PlanResult result = plan(roadmap, Point(0.15, 0.95, 0.7), Point(1.25, 1.25, 0.7),
                                     {.radius = radius, .escape = true});
      EXPECT_EQ(result.status, PlanStatus::kStartInCollision) << radius;
    }
  }
}

TEST(Escape, IsSoughtWithinTheTimeLimit) {
  const Roadmap roadmap =
      build_roadmap(room_with_boxes(0, 0), {.min_clearance = kEscapeRadius}).roadmap;
  const Point close(0.15, 0.95, 0.7), free(1.25, 1.25, 0.7);
  for (const auto& [start, goal] : {std::pair(close, free), std::pair(free, close)}) {
    EXPECT_TRUE(plan(roadmap, start, goal, {.escape = true}).ok());
    EXPECT_EQ(plan(roadmap, start, goal, {.time_limit = 1e-9, .escape = true}).status,
              PlanStatus::kTimeout);
  }
}

TEST(Escape, GoesOutAndBackFromOnePlace) {
  const Roadmap roadmap =
      build_roadmap(room_with_boxes(0, 0), {.min_clearance = kEscapeRadius}).roadmap;
  const Point place(0.15, 0.95, 0.7);
  const PlanResult result = plan(roadmap, place, place, {.escape = true});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.waypoints.size(), 3u);
  EXPECT_NEAR(result.length, 2.0 * result.escape_start.length, 1e-12);
}

TEST(Escape, BackToTheSamePlaceHasNoBound) {
  const Roadmap roadmap =
      build_roadmap(room_with_boxes(0, 0), {.min_clearance = kEscapeRadius}).roadmap;
  const Point close(0.15, 0.95, 0.7), free(1.25, 1.25, 0.7);
  EXPECT_TRUE(std::isinf(plan(roadmap, close, close, {.escape = true}).within));
  EXPECT_EQ(plan(roadmap, free, free, {.escape = true}).within, 1.0);
  const std::vector<Point> back{close, close};
  EXPECT_TRUE(std::isinf(plan_via(roadmap, back, {.escape = true}).plan.within));
}

}  // namespace
}  // namespace ridgeway
