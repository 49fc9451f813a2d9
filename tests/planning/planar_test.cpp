// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"
#include "support/random_maps.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

/// Squared distance in the plane from a point to the nearest voxel that is an obstacle, voxels.
double plane_distance(const OccupancyMap& flat, const Eigen::Vector2d& p, UnknownPolicy policy) {
  const VoxelRange known = known_range(flat);
  double best = std::numeric_limits<double>::infinity();
  for (int y = known.min.y - 9; y <= known.max.y + 9; ++y)
    for (int x = known.min.x - 9; x <= known.max.x + 9; ++x) {
      if (!is_obstacle(flat.at({x, y, kPlanarLayer}), policy)) continue;
      const double dx = std::max({x - p.x(), p.x() - x - 1.0, 0.0});
      const double dy = std::max({y - p.y(), p.y() - y - 1.0, 0.0});
      best = std::min(best, std::hypot(dx, dy));
    }
  return best;
}

TEST(Flatten, TakesWhateverIsBetweenTheHeightsForOneLayer) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    OccupancyMap map = testing::random_map(seed, 18);
    map.origin = {1000, -2000, 30};
    const VoxelRange known = known_range(map);
    const int first = known.min.z + 2, last = first + 3;
    const double s = map.voxel_size;
    OccupancyMap flat;
    try {
      flat = flatten(map, (first + 30) * s, (last + 31) * s);
    } catch (const InputError&) {
      continue;
    }
    EXPECT_TRUE(flat.planar);
    std::size_t free = 0;
    for (int y = known.min.y - 2; y <= known.max.y + 2; ++y)
      for (int x = known.min.x - 2; x <= known.max.x + 2; ++x) {
        int occupied = 0, unknown = 0;
        for (int z = first; z <= last; ++z) {
          occupied += map.at({x, y, z}) == VoxelState::kOccupied;
          unknown += map.at({x, y, z}) == VoxelState::kUnknown;
        }
        const VoxelState expected = occupied > 0  ? VoxelState::kOccupied
                                    : unknown > 0 ? VoxelState::kUnknown
                                                  : VoxelState::kFree;
        free += expected == VoxelState::kFree;
        const VoxelIndex world = map.origin + VoxelIndex{x, y, 0};
        for (int z = 0; z < kBlockSide; ++z)
          ASSERT_EQ(flat.at({world.x - flat.origin.x, world.y - flat.origin.y, z}), expected);
      }
    EXPECT_EQ(count_voxels(flat).free, free);  // a column counts once
    const double middle = (flat.origin.z + kPlanarLayer + 0.5) * s;
    EXPECT_GT(middle, (first + 30) * s);
    EXPECT_LT(middle, (last + 31) * s);
  }
  const OccupancyMap map = testing::random_map(1, 18);
  EXPECT_THROW(flatten(map, 1.0, 0.5), InputError);
  EXPECT_THROW(flatten(map, std::nan(""), 0.5), InputError);
  EXPECT_THROW(flatten(map, 500.0, 501.0), InputError);
}

TEST(Planar, DistancesAreThoseInThePlane) {
  int finite = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = seed % 2 == 0 ? UnknownPolicy::kObstacle : UnknownPolicy::kIgnore;
    const OccupancyMap map = testing::random_map(seed, 18);
    OccupancyMap flat;
    try {
      flat = flatten(map, known_bounds(map)->min.z() + 0.3, known_bounds(map)->min.z() + 0.5);
    } catch (const InputError&) {
      continue;
    }
    const EsdfMap esdf = compute_esdf(flat, {.unknown = policy});
    const FreeSpace space(esdf);
    std::mt19937 random(seed);
    std::vector<VoxelId> open;
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (esdf.layout.index_of(id).z == kPlanarLayer && esdf.is_open(id)) open.push_back(id);
    if (open.empty()) continue;
    for (int i = 0; i < 60; ++i) {
      const VoxelIndex v = esdf.layout.index_of(open[random() % open.size()]);
      const auto off = [&] { return static_cast<double>(random() % 1000) / 1000.0; };
      const Eigen::Vector2d p(v.x + off(), v.y + off());
      const double expected = plane_distance(flat, p, policy);
      const Point place(p.x() * 0.1, p.y() * 0.1, (kPlanarLayer + 0.5) * 0.1);
      if (std::isinf(expected))
        EXPECT_TRUE(std::isinf(space.distance(place)));
      else
        EXPECT_NEAR(space.distance(place), 0.1 * expected, 1e-9);
      if (expected * 0.1 > 0.01)
        EXPECT_TRUE(space.is_free(place, 0.1 * std::min(expected, 1e3) * (1 - 1e-6)));
      finite += std::isfinite(expected);
      if (std::isfinite(expected))
        EXPECT_FALSE(space.is_free(place, 0.1 * expected * (1 + 1e-6) + 1e-6));
      EXPECT_FALSE(space.is_free(place + Point(0, 0, 1e-3), 1e-3));  // out of the plane
    }
  }
  EXPECT_GT(finite, 0);
}

/// Whether moves between the eight neighbours in the plane join two voxels of a layer, with a
/// clearance found by looking along them.
bool plane_connects(const OccupancyMap& flat, const VoxelIndex& from, const VoxelIndex& to,
                    double radius) {
  std::map<std::pair<int, int>, bool> seen;
  std::vector<VoxelIndex> open{from};
  const auto fits = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    for (int k = 0; k <= 16; ++k)
      if (plane_distance(flat, a + (b - a) * (k / 16.0), UnknownPolicy::kObstacle) <
          radius * (1 - 1e-9))
        return false;
    return true;
  };
  seen[{from.x, from.y}] = true;
  while (!open.empty()) {
    const VoxelIndex v = open.back();
    open.pop_back();
    if (v == to) return true;
    for (int y = v.y - 1; y <= v.y + 1; ++y)
      for (int x = v.x - 1; x <= v.x + 1; ++x) {
        if (seen[{x, y}] || flat.at({x, y, kPlanarLayer}) != VoxelState::kFree) continue;
        if (!fits({v.x + 0.5, v.y + 0.5}, {x + 0.5, y + 0.5})) continue;
        seen[{x, y}] = true;
        open.push_back({x, y, kPlanarLayer});
      }
  }
  return false;
}

TEST(Planar, PathsStayInThePlaneAndAreFoundWhereThereAreSome) {
  int routes = 0, none = 0, by_graph = 0;
  for (unsigned seed = 0; seed < 14; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 20);
    Roadmap roadmap;
    OccupancyMap flat;
    try {
      flat = flatten(map, known_bounds(map)->min.z() + 0.4, known_bounds(map)->min.z() + 0.5);
      roadmap = build_roadmap(flat, {.min_clearance = 0.1, .tangent_pairs = 50}).roadmap;
    } catch (const InputError&) {
      continue;  // no room in that layer
    }
    const EsdfMap& esdf = roadmap.esdf;
    const CheckReport report = check_roadmap(roadmap, {.queries = 30});
    EXPECT_TRUE(report.is_clean());
    by_graph += static_cast<int>(report.graph_ok - report.fallbacks);
    std::vector<VoxelIndex> places;
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (esdf.layout.index_of(id).z == kPlanarLayer && esdf.is_open(id) &&
          esdf.squared[id] >= least_clearance(0.1, 0.1))
        places.push_back(esdf.layout.index_of(id));
    std::mt19937 random(seed);
    for (int i = 0; i < 4; ++i) {
      const VoxelIndex from = places[random() % places.size()],
                       to = places[random() % places.size()];
      Point start = to_world(esdf, centre_of(from, 0.1)), goal = to_world(esdf, centre_of(to, 0.1));
      start.z() += 0.7;  // heights do not count
      const PlanResult result = plan(roadmap, start, goal);
      const bool connected = plane_connects(flat, from, to, 1.0);
      ASSERT_EQ(result.ok(), connected);
      result.ok() ? ++routes : ++none;
      const double height = to_world(esdf, Point(0, 0, (kPlanarLayer + 0.5) * 0.1)).z();
      for (const Point& p : result.waypoints) ASSERT_NEAR(p.z(), height, 1e-8);
      for (std::size_t k = 1; k < result.waypoints.size(); ++k)
        for (int j = 0; j <= 20; ++j) {
          const Point p = to_local(esdf, result.waypoints[k - 1]) * (1 - j / 20.0) +
                          to_local(esdf, result.waypoints[k]) * (j / 20.0);
          ASSERT_GE(plane_distance(flat, p.head<2>() / 0.1, UnknownPolicy::kObstacle), 1 - 1e-7);
        }
    }
  }
  EXPECT_GT(routes, 10);
  EXPECT_GT(none, 3);
  EXPECT_GT(by_graph, 100);
}

TEST(Planar, AHallOfPillarsHasTheGraphOfItsPlane) {
  std::vector<Eigen::Vector2d> axes;
  const OccupancyMap map = testing::pillars(4, axes);  // 0.8 m high, floor and ceiling solid
  const OccupancyMap flat = flatten(map, 0.1, 0.7);
  // Larger than half the height: no sphere of that radius fits in the hall.
  EXPECT_THROW(build_roadmap(map, {.min_clearance = 0.4}), InputError);
  const BuildResult built = build_roadmap(flat, {.min_clearance = 0.2});
  const Roadmap& roadmap = built.roadmap;
  EXPECT_EQ(built.report.traversable_components, 1u);
  // As many loops as pillars: edges - vertices + 1.
  EXPECT_EQ(roadmap.graph.edges.size() + 1 - roadmap.graph.vertices.size(), axes.size());
  const CheckReport report = check_roadmap(roadmap, {.queries = 200});
  EXPECT_TRUE(report.is_clean());
  EXPECT_EQ(report.graph_ok, report.esdf_ok);
  EXPECT_GT(report.graph_ok, 180u);  // wider robots do not pass everywhere
  EXPECT_LT(report.length_ratio.p95, 1.05);
  EXPECT_LT(report.fallbacks, 10u);
  // What is above and below is not beside a path.
  const PlanResult path = plan(roadmap, Point(0.6, 0.6, 0), Point(7.4, 5.4, 0));
  ASSERT_TRUE(path.ok());
  EXPECT_GT(Surroundings(roadmap.esdf).along(path.waypoints, 0.2).unknown, 0.3);
  EXPECT_THROW(plan(roadmap, Point(1, 1, 0), Point(2, 2, 0), {.robot_height = 0.5}), InputError);
}

TEST(Planar, NoRouteIsExplainedInThePlane) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {40, 20, 9}, [](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.x == 40 || v.y == 20;
    const bool wall = v.x == 20 && (v.y < 8 || v.y > 11) && v.z < 5;  // open above
    return hull || wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const Roadmap low = build_roadmap(flatten(map, 0.2, 0.4), {.min_clearance = 0.3}).roadmap;
  const Roadmap high = build_roadmap(flatten(map, 0.6, 0.8), {.min_clearance = 0.3}).roadmap;
  const Point start(0.5, 1, 0), goal(3.5, 1, 0);
  EXPECT_TRUE(plan(high, start, goal).ok());
  EXPECT_EQ(plan(low, start, goal).status, PlanStatus::kNoRoute);
  const auto blocked = RouteBlocks(low).between(start, goal, 0.3);
  ASSERT_TRUE(blocked);
  EXPECT_NEAR(blocked->radius, 0.2, 0.051);
  EXPECT_EQ(blocked->by, Blocker::kObstacle);
  // All of it is in the layer.
  const double layer = (kPlanarLayer + 0.5) * 0.1;
  EXPECT_NEAR(to_local(low.esdf, *blocked->place).z(), layer, 1e-9);
  EXPECT_LT(blocked->start_component.volume, 2.0 * 2.0 * 0.1);
}

/// The layer of a planar map is no limit that anyone set.
TEST(Planar, NoLimitIsBlamedWhereThereIsNone) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {40, 20, 0}, [](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.x == 40 || v.y == 20;
    return hull ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const Roadmap roadmap = build_roadmap(flatten(map, 0.0, 0.1), {.min_clearance = 0.3}).roadmap;
  EXPECT_FALSE(has_flight_limits(roadmap.esdf, roadmap.esdf.limits));
  const auto blocked = RouteBlocks(roadmap).between({0.5, 1, 0}, {3.5, 1, 0}, 0.3);
  ASSERT_TRUE(blocked);
  EXPECT_NE(blocked->by, Blocker::kLimits);
  const std::string told =
      refusal([&] { build_roadmap(flatten(map, 0.0, 0.1), {.min_clearance = 2.5}); });
  EXPECT_EQ(told.find("limits"), std::string::npos) << told;
}

/// Blocks are allocated in the plane alone, whatever unknown space is taken for.
TEST(Planar, EveryPolicyIsSavedAndRead) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {40, 20, 0}, [](const VoxelIndex& v) {
    return v.x == 20 && v.y < 8 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const TemporaryFolder folder;
  for (const UnknownPolicy unknown :
       {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore, UnknownPolicy::kFree}) {
    SCOPED_TRACE(name_of(unknown));
    const Roadmap roadmap =
        build_roadmap(flatten(map, 0.0, 0.1), {.min_clearance = 0.3, .unknown = unknown}).roadmap;
    for (const BlockIndex& block : roadmap.esdf.layout.blocks()) EXPECT_EQ(block.z, 0);
    save_roadmap(roadmap, folder / "a.ridge");
    const Roadmap again = load_roadmap(folder / "a.ridge");
    EXPECT_EQ(again.esdf.squared.values().size(), roadmap.esdf.squared.values().size());
    EXPECT_TRUE(plan(again, {1.0, 0.5, 0.0}, {3.0, 0.5, 0.0}).ok());
  }
}

}  // namespace
}  // namespace ridgeway
