// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// A map that is moved by whole voxels, however far, gives the same roadmap and the same answers but
// for that shift: random maps, the bundled scan, a cloud, a fused map.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/live/graph_delta.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "ridgeway/sensing/depth_camera.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "sensing/poses.hpp"
#include "support/lattice.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"
#include "support/shifted_map.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

using testing::bytes_but_for_the_origin;
using testing::moved_map;
using testing::shifts_of;

/// One map at two places.
struct Shifted {
  Roadmap near, far;

  Point shift(const Point& point_near) const {
    return to_world(far.esdf, to_local(near.esdf, point_near));
  }

  /// The same points but for the shift, and what the world's coordinates round.
  void expect_same(const std::vector<Point>& points_near,
                   const std::vector<Point>& points_far) const {
    ASSERT_EQ(points_near.size(), points_far.size());
    for (std::size_t i = 0; i < points_near.size(); ++i) {
      const Point expected = shift(points_near[i]);
      const double rounding = 1e-15 * std::max(1.0, expected.cwiseAbs().maxCoeff());
      ASSERT_LE((points_far[i] - expected).cwiseAbs().maxCoeff(), rounding);
    }
  }

  void expect_same(const PlanResult& a, const PlanResult& b) const {
    ASSERT_EQ(a.status, b.status);
    EXPECT_EQ(a.answered_by, b.answered_by);
    EXPECT_EQ(a.length, b.length);
    EXPECT_EQ(a.clearance, b.clearance);
    expect_same(a.waypoints, b.waypoints);
  }
};

using Ends = std::pair<Point, Point>;

/// Centres of traversable voxels, in the near map's world.
std::vector<Ends> draw_ends(const Roadmap& roadmap, std::size_t count, unsigned seed) {
  const std::vector<VoxelId> places =
      testing::traversable_places(roadmap.esdf, roadmap.min_clearance);
  std::mt19937 random(seed);
  const auto place = [&] {
    return testing::centre_in_world(roadmap.esdf, places[random() % places.size()]);
  };
  std::vector<Ends> ends;
  for (std::size_t i = 0; i < count && !places.empty(); ++i) {
    const Point start = place();
    ends.emplace_back(start, place());
  }
  return ends;
}

void expect_same_plans(Shifted& maps, const Ends& ends, const PlanConfig& config) {
  const Ends far = {maps.shift(ends.first), maps.shift(ends.second)};
  const PlanResult a = plan(maps.near, ends.first, ends.second, config);
  const PlanResult b = plan(maps.far, far.first, far.second, config);
  maps.expect_same(a, b);
  if (!b.ok()) return;
  EXPECT_EQ(b.waypoints.front(), far.first);
  EXPECT_EQ(b.waypoints.back(), far.second);
}

/// The same reason why there is no route.
void expect_same_blocks(Shifted& maps, const std::optional<BlockedRoute>& a,
                        const std::optional<BlockedRoute>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->radius, b->radius);
  EXPECT_EQ(a->by, b->by);
  EXPECT_EQ(a->start_number, b->start_number);
  EXPECT_EQ(a->goal_number, b->goal_number);
  ASSERT_EQ(a->place.has_value(), b->place.has_value());
  if (a->place) maps.expect_same(std::vector<Point>{*a->place}, {*b->place});
}

/// All ways to ask, on a few queries. Some are between places where the robot does not fit.
void expect_same_answers(Shifted& maps, unsigned seed, std::size_t queries) {
  const double radius = maps.near.min_clearance;
  const RouteBlocks near_blocks(maps.near), far_blocks(maps.far);
  const Surroundings near_around(maps.near.esdf), far_around(maps.far.esdf);
  for (const Ends& ends : draw_ends(maps.near, queries, seed)) {
    for (const Planner planner :
         {Planner::kGraph, Planner::kDiagram, Planner::kEsdf, Planner::kThetaStar})
      expect_same_plans(maps, ends, {.planner = planner});
    expect_same_plans(maps, ends, {.radius = 1.25 * radius});
    expect_same_plans(maps, ends, {.radius = 1.25 * radius, .escape = true});
    expect_same_plans(maps, ends, {.shorten = false});
    expect_same_plans(maps, ends, {.prefer_clearance = 1.0});
    const Ends far = {maps.shift(ends.first), maps.shift(ends.second)};
    const Alternatives a = plan_alternatives(maps.near, ends.first, ends.second, 3);
    const Alternatives b = plan_alternatives(maps.far, far.first, far.second, 3);
    ASSERT_EQ(a.routes.size(), b.routes.size());
    for (std::size_t i = 0; i < a.routes.size(); ++i) maps.expect_same(a.routes[i], b.routes[i]);
    EXPECT_EQ(distances_to_goals(maps.near, ends.first, std::vector<Point>{ends.second}),
              distances_to_goals(maps.far, far.first, std::vector<Point>{far.second}));
    const auto goal = plan_to_nearest(maps.near, ends.first, std::vector<Point>{ends.second});
    const auto goal_far = plan_to_nearest(maps.far, far.first, std::vector<Point>{far.second});
    maps.expect_same(goal.plan, goal_far.plan);
    expect_same_blocks(maps, near_blocks.between(ends.first, ends.second, radius),
                       far_blocks.between(far.first, far.second, radius));
    const PathSurroundings beside = near_around.along(goal.plan.waypoints, radius);
    const PathSurroundings beside_far = far_around.along(goal_far.plan.waypoints, radius);
    const double rounding = 4e-15 * maps.shift(ends.first).cwiseAbs().maxCoeff();
    if (!goal.plan.ok()) continue;
    if (std::isfinite(beside.known)) {
      EXPECT_NEAR(beside.known, beside_far.known, rounding);
    }
    EXPECT_NEAR(beside.unknown, beside_far.unknown, rounding);
  }
}

void expect_same_parts(Shifted& maps) {
  const ComponentReport a = report_components(maps.near), b = report_components(maps.far);
  ASSERT_EQ(a.components.size(), b.components.size());
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    EXPECT_EQ(a.components[i].voxels, b.components[i].voxels);
    maps.expect_same(std::vector<Point>{a.components[i].widest}, {b.components[i].widest});
  }
  ASSERT_EQ(a.joins.size(), b.joins.size());
  for (std::size_t i = 0; i < a.joins.size(); ++i)
    maps.expect_same(std::vector<Point>{a.joins[i].place}, {b.joins[i].place});
}

void expect_same_check(Shifted& maps, std::size_t queries) {
  const CheckReport a = check_roadmap(maps.near, {.queries = queries, .seed = 3});
  const CheckReport b = check_roadmap(maps.far, {.queries = queries, .seed = 3});
  EXPECT_TRUE(b.is_clean());
  ASSERT_EQ(a.paths.size(), b.paths.size());
  for (std::size_t i = 0; i < a.paths.size(); ++i)
    maps.expect_same(a.paths[i].waypoints, b.paths[i].waypoints);
}

/// Paths that plan() gives are flown, and planned on from each waypoint, wherever they are, though
/// the world rounds their waypoints.
void expect_flights(Shifted& maps, unsigned seed, std::size_t queries) {
  TrajectoryConfig config{.radius = maps.far.min_clearance};
  for (const Ends& ends : draw_ends(maps.near, queries, seed)) {
    const PlanResult path = plan(maps.far, maps.shift(ends.first), maps.shift(ends.second));
    if (!path.ok()) continue;
    for (const Point& waypoint : path.waypoints) {
      const PlanResult rest = plan(maps.far, waypoint, path.waypoints.back());
      ASSERT_TRUE(rest.ok()) << name_of(rest.status);
      EXPECT_EQ(rest.waypoints.front(), waypoint);
    }
    const TrajectoryResult flown = plan_trajectory(maps.far.esdf, path.waypoints, config);
    ASSERT_TRUE(flown.ok());
    EXPECT_TRUE(still_safe(path, maps.far));
    EXPECT_TRUE(still_safe(flown.trajectory, config, maps.far.esdf));
    const double rounding = 1e-15 * path.waypoints.front().cwiseAbs().maxCoeff();
    EXPECT_GE(flown.clearance, config.radius * (1.0 - 2e-9) - rounding);
    EXPECT_LE((flown.trajectory.at(0.0).position - path.waypoints.front()).norm(), 2 * rounding);
    EXPECT_LE((flown.trajectory.at(flown.duration).position - path.waypoints.back()).norm(),
              1e-9 + 2 * rounding);
  }
}

TEST(FarMap, RandomMapsGiveTheSameRoadmapAndAnswersButForTheShift) {
  const TemporaryFolder folder;
  std::size_t maps_with_room = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const double voxel_size = seed % 2 == 0 ? 0.1 : 0.25;
    const OccupancyMap map = testing::random_map(seed, 22, voxel_size);
    const BuildConfig config{
        .min_clearance = (seed % 3 == 0 ? 1.5 : 1.3) * voxel_size,
        .unknown = seed % 4 == 3 ? UnknownPolicy::kIgnore : UnknownPolicy::kObstacle};
    Shifted maps;
    try {
      maps.near = build_roadmap(moved_map(map, {}), config).roadmap;
    } catch (const InputError&) {
      continue;  // no room for the robot
    }
    ++maps_with_room;
    const std::string bytes = bytes_but_for_the_origin(maps.near, folder);
    for (const VoxelIndex& shift : shifts_of(map)) {
      SCOPED_TRACE(shift.x);
      maps.far = build_roadmap(moved_map(map, shift), config).roadmap;
      ASSERT_EQ(maps.far.esdf.origin, maps.near.esdf.origin + shift);
      ASSERT_TRUE(bytes_but_for_the_origin(maps.far, folder) == bytes);
      save_roadmap(maps.far, folder / "far.ridge");
      maps.far = load_roadmap(folder / "far.ridge");
      ASSERT_EQ(maps.far.esdf.origin, maps.near.esdf.origin + shift);
      expect_same_answers(maps, seed, 3);
      expect_same_parts(maps);
      expect_flights(maps, seed, 2);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(maps_with_room, 15u);
}

TEST(FarMap, TheBundledScanGivesTheSameRoadmapAndAnswersButForTheShift) {
  const TemporaryFolder folder;
  const std::filesystem::path file = std::filesystem::path(RIDGEWAY_DATA_DIR) / "fr_079.bt";
  const BuildConfig config{.min_clearance = 0.3};
  const OccupancyMap map = load_map(file);
  Shifted maps;
  maps.near = build_roadmap(map, config).roadmap;
  const std::string bytes = bytes_but_for_the_origin(maps.near, folder);
  const std::vector<VoxelIndex> shifts = shifts_of(map);
  for (const VoxelIndex& shift : {shifts[0], shifts[2], shifts[3], shifts[4]}) {
    SCOPED_TRACE(shift.x);
    LoadConfig loading;
    loading.transform.translation() = Point(shift.x, shift.y, shift.z) * map.voxel_size;
    maps.far = build_roadmap(load_map(file, loading), config).roadmap;
    ASSERT_EQ(maps.far.esdf.origin, maps.near.esdf.origin + shift);
    ASSERT_TRUE(bytes_but_for_the_origin(maps.far, folder) == bytes);
    save_roadmap(maps.far, folder / "far.ridge");
    maps.far = load_roadmap(folder / "far.ridge");
    expect_same_answers(maps, 1, 1);
    expect_same_check(maps, 12);
    expect_flights(maps, 2, 4);
    if (HasFatalFailure()) return;
  }
}

TEST(FarMap, LoadingAndItsEditsMoveWithTheMap) {
  const TemporaryFolder folder;
  std::mt19937 random(4);
  std::string text = "voxel 40 30 20\n", cloud;
  for (int i = 0; i < 400; ++i) {
    const int x = static_cast<int>(random() % 40), y = static_cast<int>(random() % 30);
    text +=
        std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(random() % 20) + '\n';
    cloud += std::to_string(0.1 * x) + ' ' + std::to_string(0.1 * y) + " 1.0\n";  // on faces
  }
  write_whole(folder / "a.3dmap", text);
  write_whole(folder / "a.xyz", cloud);
  const VoxelIndex metres = {465'000, -5'300'000, 1'000'003};  // whole voxels of every size
  const std::filesystem::path scan = std::filesystem::path(RIDGEWAY_DATA_DIR) / "fr_079.bt";
  const std::vector<std::pair<std::filesystem::path, double>> cases = {{folder / "a.3dmap", 0.1},
                                                                       {folder / "a.xyz", 0.1},
                                                                       {folder / "a.xyz", 0.2},
                                                                       {folder / "a.xyz", 0.25},
                                                                       {scan, 0.1},
                                                                       {scan, 0.2},
                                                                       {scan, 0.25},
                                                                       {scan, 0.125}};
  for (const auto& [file, voxel_size] : cases) {
    SCOPED_TRACE(file.filename().string() + " at " + std::to_string(voxel_size));
    LoadConfig config{.voxel_size = voxel_size,
                      .bounds = Box{{0.4, 0.35, 0.0}, {3.3, 2.51, 1.9}},
                      .exclude = {Box{{-9.0, 1.0, 0.5}, {2.0, 1.0, 0.7}}},
                      .isolated_below = 2};
    const OccupancyMap near = load_map(file, config);
    const Point by(metres.x, metres.y, metres.z);
    config.transform.translation() = by;
    for (Box* box : {&*config.bounds, &config.exclude[0]}) {
      box->min += by;
      box->max += by;
    }
    const OccupancyMap far = load_map(file, config);
    const auto voxels = [size = voxel_size](int m) {
      return static_cast<int>(std::lround(m / size));
    };
    EXPECT_EQ(far.origin,
              near.origin + (VoxelIndex{voxels(metres.x), voxels(metres.y), voxels(metres.z)}));
    EXPECT_TRUE(far.layout == near.layout);
    EXPECT_TRUE(far.state.values() == near.state.values());
  }
}

TEST(FarMap, FusionMovesWithItsPoses) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.0});
  world.boxes.push_back({{2.0, 0.7, 0.1}, {0.5, 0.4, 0.3}});
  const DepthSensor sensor;
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting}) {
    std::vector<TsdfMap> maps;
    for (const double shift : {0.0, 465'000.0, -99'000'000.0}) {
      TsdfFusion fusion({.voxel_size = 0.125, .clear_radius = 0.3, .integrator = integrator});
      for (const double y : {0.0, 0.375, -0.5}) {
        const Eigen::Isometry3d pose = level_pose({0.0, y, 0.0}, 0.3 * y);
        Eigen::Isometry3d far = pose;
        far.translation() += Point(shift, -shift, shift);
        fusion.integrate(render_depth(world, sensor, pose), sensor.camera, far);
      }
      maps.push_back(fusion.map());
      const int voxels = static_cast<int>(shift / 0.125);
      EXPECT_EQ(maps.back().origin, (VoxelIndex{voxels, -voxels, voxels}));
      EXPECT_TRUE(maps.back().layout == maps.front().layout);
      EXPECT_TRUE(maps.back().distance.values() == maps.front().distance.values());
      EXPECT_TRUE(maps.back().weight.values() == maps.front().weight.values());
    }
  }
}

TEST(FarMap, BeyondTheLimitMapsAreRefused) {
  const std::filesystem::path file = std::filesystem::path(RIDGEWAY_DATA_DIR) / "fr_079.bt";
  const OccupancyMap map = load_map(file);
  for (const VoxelIndex& beyond :
       {shifts_of(map)[4] + VoxelIndex{1, 0, 0}, shifts_of(map)[5] - VoxelIndex{0, 0, 1},
        VoxelIndex{0, 1'000'000'000, 0}, VoxelIndex{0, -2'000'000'000, 0}}) {
    LoadConfig loading;
    loading.transform.translation() = Point(beyond.x, beyond.y, beyond.z) * map.voxel_size;
    try {
      load_map(file, loading);
      FAIL() << "was not refused";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("1e9 voxels"), std::string::npos) << error.what();
    }
  }
}

TEST(FarMap, PlacesThatJustFitAreFoundWhereverTheMapLies) {
  // A corridor as wide as the robot: only the centres of its voxels fit.
  const OccupancyMap corridor =
      testing::make_map(0.1, {0, 0, 0}, {30, 2, 2}, [](const VoxelIndex& v) {
        const bool inside = v.y == 1 && v.z == 1 && v.x > 0 && v.x < 30;
        return inside ? VoxelState::kFree : VoxelState::kOccupied;
      });
  for (const VoxelIndex& shift : shifts_of(corridor)) {
    const Roadmap roadmap =
        build_roadmap(moved_map(corridor, shift), {.min_clearance = 0.05}).roadmap;
    const auto centre = [&](int x) { return centre_of(VoxelIndex{x, 1, 1} + shift, 0.1); };
    const PlanResult path = plan(roadmap, centre(1), centre(29));
    ASSERT_TRUE(path.ok()) << name_of(path.status);
    EXPECT_NEAR(path.length, 2.8, 1e-6);
    TrajectoryConfig config{.radius = 0.05};
    const TrajectoryResult flown = plan_trajectory(roadmap.esdf, path.waypoints, config);
    EXPECT_TRUE(flown.ok());
    EXPECT_TRUE(still_safe(path, roadmap));
    EXPECT_TRUE(still_safe(flown.trajectory, config, roadmap.esdf));
  }
}

}  // namespace
}  // namespace ridgeway
