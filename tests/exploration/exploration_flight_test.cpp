// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/exploration_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "files/read_file.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

SolidPlane plane(const Eigen::Vector3d& normal, double offset) { return {normal, offset}; }

/// Two rooms of 4 x 4 x 2.4 m with a door between them, of a width.
World two_rooms(double door) {
  World world;
  world.name = "two rooms";
  world.planes = {plane(Eigen::Vector3d::UnitX(), 0.0), plane(-Eigen::Vector3d::UnitX(), -8.2),
                  plane(Eigen::Vector3d::UnitY(), 0.0), plane(-Eigen::Vector3d::UnitY(), -4.0),
                  plane(Eigen::Vector3d::UnitZ(), 0.0), plane(-Eigen::Vector3d::UnitZ(), -2.4)};
  const double side = 4.0 - door;
  if (side > 0.0)
    world.boxes.push_back({Point(4.1, 0.5 * side, 1.2), Eigen::Vector3d(0.2, side, 2.4)});
  return world;
}

ExplorationFlightConfig quick_config() {
  ExplorationFlightConfig config;
  config.start = {1.3, 1.3, 1.2};
  config.radius = 0.2;
  config.voxel_size = 0.2;
  config.max_distance = 2.0;
  config.scan_rate = 3.0;
  config.longest = 150.0;
  config.sensor.camera = {.width = 80, .height = 60, .fx = 40, .fy = 40, .cx = 39.5, .cy = 29.5};
  config.sensor.range_sigma = 0.01;
  return config;
}

std::string bytes_of(const Roadmap& roadmap) {
  const TemporaryFolder folder;
  save_roadmap(roadmap, folder / "map.ridge");
  return read_file(folder / "map.ridge");
}

TEST(Exploration, MapsTwoRoomsWithoutTouchingAndComesBack) {
  const ExplorationFlightConfig config = quick_config();
  const ExplorationFlight flight = explore(two_rooms(1.4), config);
  EXPECT_TRUE(flight.is_complete) << name_of(flight.end);
  EXPECT_GE(flight.coverage, 0.99);
  EXPECT_EQ(flight.collisions, 0u);
  EXPECT_GE(flight.nearest, 0.0);
  EXPECT_LT((flight.samples.back().state.position - config.start).norm(), 1e-6);
  for (const ExplorationSample& sample : flight.samples) {
    EXPECT_LE(sample.state.velocity.norm(), config.explorer.motion.max_speed * (1.0 + 1e-6));
    EXPECT_LE(sample.state.acceleration.norm(),
              config.explorer.motion.max_acceleration * (1.0 + 1e-6));
  }
  EXPECT_LT(flight.seconds_to(0.9), flight.seconds);
}

/// Every place of every voxel that the drone gets to, at every heading, stepwise along each line of
/// sight.
TEST(Exploration, CompleteMeansThatNoPlaceSeesAFrontier) {
  ExplorationFlightConfig config = quick_config();
  config.sensor.range_sigma = 0.0;
  const ExplorationFlight flight = explore(two_rooms(1.4), config);
  ASSERT_TRUE(flight.is_complete);
  const EsdfMap& esdf = flight.roadmap->esdf;
  Frontiers frontiers(voxels_inside({Point::Zero(), Point(8.2, 4.0, 2.4)}, config.voxel_size));
  frontiers.update(flight.roadmap);
  const FieldOfView view = field_of_view(config.sensor);
  std::size_t looks = 0, seen = 0;
  for (const FrontierPart& part : frontiers.parts()) {
    if (frontiers.clusters()[part.cluster].voxels < config.explorer.least_frontier) continue;
    for (const VoxelIndex& target : part.targets)
      for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
        if (!esdf.is_open(id) || esdf.distance(id) < config.clearance()) continue;
        const Point from = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
        const Eigen::Vector3d way = centre_of(target, esdf.voxel_size) - from;
        const double level = std::hypot(way.x(), way.y());
        if (way.norm() > view.range || std::abs(way.z()) > level * std::tan(0.48 * view.vertical))
          continue;
        ++looks;
        bool is_clear = true;
        for (double t = 0.0; t < 1.0 && is_clear; t += 0.02 * esdf.voxel_size / way.norm()) {
          const VoxelIndex voxel = voxel_at(from + t * way, esdf.voxel_size);
          if (voxel == target) break;
          const VoxelId at = esdf.layout.find(voxel);
          is_clear = at != kNoVoxel && esdf.state[at] == VoxelState::kFree;
        }
        seen += is_clear;
      }
  }
  EXPECT_EQ(seen, 0u) << "of " << looks << " lines of sight";
}

TEST(Exploration, SameSeedSameBytesForAnyNumberOfThreads) {
  ExplorationFlightConfig config = quick_config();
  config.longest = 12.0;
  const auto fly = [&](int threads) {
    return with_threads(threads, [&] { return explore(two_rooms(1.4), config); });
  };
  const ExplorationFlight one = fly(1), two = fly(2);
  ASSERT_EQ(one.samples.size(), two.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    EXPECT_EQ(one.samples[i].state.position, two.samples[i].state.position);
    EXPECT_EQ(one.samples[i].state.yaw, two.samples[i].state.yaw);
  }
  EXPECT_EQ(bytes_of(*one.roadmap), bytes_of(*two.roadmap));
}

TEST(Exploration, ARecordingGivesTheSameMap) {
  ExplorationFlightConfig config = quick_config();
  config.longest = 8.0;
  std::vector<std::pair<DepthImage, Eigen::Isometry3d>> frames;
  const ExplorationFlight flight =
      explore(two_rooms(1.4), config, {},
              [&](const DepthImage& image, const Eigen::Isometry3d& T_world_camera) {
                frames.emplace_back(image, T_world_camera);
              });
  EXPECT_EQ(frames.size(), flight.samples.size());
  LiveRoadmap live({.fusion = {.voxel_size = config.voxel_size},
                    .build = {.min_clearance = config.clearance(), .max_distance = 2.0},
                    .origin = VoxelIndex{}});
  for (const auto& [image, pose] : frames) live.integrate(image, config.sensor.camera, pose);
  const OccupancyMap again = live.map();
  std::size_t different = 0;
  for (VoxelId id = 0; id < flight.map.layout.voxel_count(); ++id) {
    const VoxelIndex voxel = flight.map.layout.index_of(id) + flight.map.origin;
    const bool is_vouched_for =
        (centre_of(voxel, config.voxel_size) - config.start).norm() <= config.free_radius() + 1e-9;
    if (!is_vouched_for && flight.map.state[id] != again.at(voxel - again.origin)) ++different;
  }
  EXPECT_EQ(different, 0u);
}

/// All is seen at any heading, so the drone turns once, to the first, and never again.
TEST(Exploration, ALidarMapsWithoutTurningAndItsScansGiveTheSameMap) {
  ExplorationFlightConfig config = quick_config();
  config.lidar = {.rows = 16, .columns = 180, .range_sigma = 0.01};
  config.longest = 60.0;
  std::vector<std::pair<std::vector<Point>, Eigen::Isometry3d>> scans;
  const ExplorationFlight flight = explore(
      two_rooms(1.4), config, {}, {}, {},
      [&](std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor) {
        scans.emplace_back(std::vector<Point>(points.begin(), points.end()), T_world_sensor);
      });
  EXPECT_TRUE(flight.is_complete) << name_of(flight.end);
  EXPECT_GE(flight.coverage, 0.97);
  EXPECT_EQ(flight.collisions, 0u);
  EXPECT_GE(flight.nearest, 0.0);
  for (const ExplorationSample& sample : flight.samples) EXPECT_NEAR(sample.state.yaw, 0.0, 1e-9);
  ASSERT_EQ(scans.size(), flight.samples.size());
  LiveRoadmap live({.fusion = {.voxel_size = config.voxel_size},
                    .build = {.min_clearance = config.clearance(), .max_distance = 2.0},
                    .origin = VoxelIndex{}});
  for (const auto& [points, pose] : scans) live.integrate(points, pose);
  const OccupancyMap again = live.map();
  for (VoxelId id = 0; id < flight.map.layout.voxel_count(); ++id) {
    const VoxelIndex voxel = flight.map.layout.index_of(id) + flight.map.origin;
    if ((centre_of(voxel, config.voxel_size) - config.start).norm() > config.free_radius() + 1e-9)
      ASSERT_EQ(flight.map.state[id], again.at(voxel - again.origin));
  }
}

TEST(Exploration, ATooNarrowDoorIsNamed) {
  ExplorationFlightConfig config = quick_config();
  for (config.seed = 1; config.seed <= 6; ++config.seed) {
    SCOPED_TRACE(config.seed);
    const ExplorationFlight flight = explore(two_rooms(0.6), config);
    EXPECT_TRUE(flight.is_complete) << name_of(flight.end);
    EXPECT_EQ(flight.collisions, 0u);
    ASSERT_FALSE(flight.unseen.empty());
    for (const UnseenFrontier& frontier : flight.unseen) {
      ASSERT_EQ(frontier.reason, UnseenReason::kTooNarrow) << name_of(frontier.reason);
      EXPECT_LT((*frontier.door - Point(4.1, 3.7, frontier.door->z())).norm(), 0.8);
      EXPECT_LT(frontier.door_radius, config.clearance());
    }
  }
}

/// Short-sighted in one large room: from a place in the middle most is out of range, and known
/// space ends everywhere, but nothing is narrow.
TEST(Exploration, WhatIsLeftIsListedAndNoDoorIsInvented) {
  ExplorationFlightConfig config = quick_config();
  config.start = {3.1, 2.1, 1.2};
  config.sensor.max_range = 1.6;
  const ExplorationFlight flight = explore(two_rooms(4.0), config);
  ASSERT_NE(flight.end, ExplorationStatus::kStuck);
  EXPECT_LT(flight.coverage, 0.9);
  std::map<UnseenReason, std::size_t> voxels;
  for (const UnseenFrontier& frontier : flight.unseen) voxels[frontier.reason] += frontier.voxels;
  EXPECT_EQ(voxels[UnseenReason::kTooNarrow], 0u);
  EXPECT_EQ(flight.is_complete, voxels[UnseenReason::kNotVisited] == 0);
  Frontiers all(voxels_inside({Point::Zero(), Point(8.2, 4.0, 2.4)}, config.voxel_size));
  all.update(flight.roadmap);
  std::size_t left = 0;
  for (const FrontierCluster& cluster : all.clusters())
    if (cluster.voxels >= config.explorer.least_frontier) left += cluster.voxels;
  EXPECT_GT(left, 100u);
  std::size_t listed = 0;
  for (const auto& [reason, count] : voxels) listed += count;
  EXPECT_EQ(listed, left);
}

/// A block fills the room between the second scan and the third.
TEST(Exploration, WhatComesAndGoesBetweenScansIsHit) {
  World world = two_rooms(4.0);
  TimedSolids timed;
  timed.from = 2.2;
  timed.until = 3.8;
  timed.boxes = {{Point(4.1, 2.0, 1.2), Eigen::Vector3d(8.2, 4.0, 2.4)}};
  world.timed = {timed};
  ExplorationFlightConfig config = quick_config();
  config.scan_rate = 0.5;
  config.longest = 8.0;
  const ExplorationFlight flight = explore(world, config);
  EXPECT_GT(flight.collisions, 50u);
  EXPECT_LT(flight.nearest, 0.0);
}

TEST(Exploration, IsBackWhenTheBudgetEnds) {
  for (const double budget : {8.0, 17.0}) {
    ExplorationFlightConfig config = quick_config();
    config.budget = budget;
    const ExplorationFlight flight = explore(two_rooms(1.4), config);
    EXPECT_LE(flight.seconds, budget);
    EXPECT_GE(flight.seconds, 0.8 * budget);  // time is not left unused
    EXPECT_LT((flight.samples.back().state.position - config.start).norm(), 1e-6);
    EXPECT_GT(flight.coverage, 0.2);
    EXPECT_FALSE(flight.unseen.empty());
    for (const UnseenFrontier& frontier : flight.unseen) {  // there was no time to know
      EXPECT_NE(frontier.reason, UnseenReason::kOutOfView);
      EXPECT_NE(frontier.reason, UnseenReason::kTooNarrow);
    }
  }
}

/// The viewpoints that see most are too far off for the time that is left, nearer ones are not.
TEST(Exploration, TimeThatIsShortIsFlownToWhatIsNear) {
  World world;
  world.planes = {plane(Eigen::Vector3d::UnitX(), 0.0), plane(-Eigen::Vector3d::UnitX(), -10.0),
                  plane(Eigen::Vector3d::UnitY(), 0.0), plane(-Eigen::Vector3d::UnitY(), -8.0),
                  plane(Eigen::Vector3d::UnitZ(), 0.0), plane(-Eigen::Vector3d::UnitZ(), -3.0)};
  for (const auto& [x, y] : {std::pair(3.9, 4.3), std::pair(8.9, 3.8), std::pair(2.7, 0.6),
                             std::pair(4.1, 2.1), std::pair(5.6, 6.4), std::pair(5.1, 6.5),
                             std::pair(6.8, 6.6), std::pair(5.0, 0.6), std::pair(3.4, 7.2)})
    world.cylinders.push_back({{x, y, 1.5}, 0.04, 3.0});
  ExplorationFlightConfig config;
  config.start = {1.0, 1.0, 1.5};
  for (const double budget : {8.0, 12.0}) {
    config.budget = budget;
    const ExplorationFlight flight = explore(world, config);
    EXPECT_GE(flight.seconds, 0.7 * budget) << budget;
    EXPECT_LE(flight.seconds, budget);
    EXPECT_GT(flight.coverage, budget < 10.0 ? 0.75 : 0.9) << budget;
    EXPECT_LT((flight.samples.back().state.position - config.start).norm(), 1e-6);
  }
}

/// The flight home begins with a decision, which may come late.
TEST(Exploration, IsBackInTimeHoweverSeldomItDecides) {
  int left_home = 0;
  for (const double rate : {0.1, 0.3, 1.0})
    for (const double budget : {20.0, 30.0}) {
      SCOPED_TRACE(::testing::Message() << rate << " Hz, " << budget << " s");
      ExplorationFlightConfig config = quick_config();
      config.scan_rate = rate;
      config.budget = budget;
      const ExplorationFlight flight = explore(two_rooms(1.4), config);
      const auto is_home = [&](const ExplorationSample& sample) {
        return (sample.state.position - config.start).norm() < 1e-6;
      };
      // Of samples that are seconds apart the first at home from which on it stays there.
      const auto away = std::find_if_not(flight.samples.rbegin(), flight.samples.rend(), is_home);
      EXPECT_TRUE(is_home(flight.samples.back()));
      left_home += away != flight.samples.rend();
      if (away != flight.samples.rend()) EXPECT_LT(away->state.time, budget);
    }
  EXPECT_GE(left_home, 3);
}

TEST(Exploration, BaselinesFlySafely) {
  for (const ExplorationPlanner planner :
       {ExplorationPlanner::kFrontier, ExplorationPlanner::kNextBest,
        ExplorationPlanner::kOffline}) {
    ExplorationFlightConfig config = quick_config();
    config.planner = planner;
    config.longest = 40.0;
    const ExplorationFlight flight = explore(two_rooms(1.4), config);
    EXPECT_EQ(flight.collisions, 0u);
    EXPECT_GE(flight.nearest, 0.0);
    EXPECT_GT(flight.coverage, 0.6);
    EXPECT_TRUE(config.is_by_explorer() || !flight.is_complete);
    EXPECT_TRUE(config.is_by_explorer() || flight.end_name() != "complete");
  }
}

TEST(Exploration, RefusesWhatCannotBeFlown) {
  const auto refused = [](const World& world, const ExplorationFlightConfig& config,
                          const std::string& word) {
    try {
      explore(world, config);
      ADD_FAILURE() << "flew: " << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  const World world = two_rooms(1.4);
  ExplorationFlightConfig config = quick_config();
  config.start = {4.1, 1.0, 1.2};
  refused(world, config, "inside an obstacle");
  config.start = {0.1, 1.0, 1.2};
  refused(world, config, "from an obstacle");
  config.start = {0.4, 1.0, 1.2};
  refused(world, config, "free space around it");
  refused(world, config, "margin and voxel size 0.75 m at least");
  config.start = {-3.0, 1.0, 1.2};
  refused(world, config, "outside");
  refused(world, config, "between 0,0,0 and 8.2,4,2.4");
  config = quick_config();
  config.sensor.max_range = 0.3;
  refused(world, config, "max_range");
  config.lidar = {.max_range = 0.3};
  refused(world, config, "max_range");
  config = quick_config();
  config.sensor.max_range = config.free_radius() + config.voxel_size;
  refused(world, config, "nothing new is seen");
  config = quick_config();
  config.forget_after = 256;
  refused(world, config, "forget_after");
  config = quick_config();
  config.budget = 1.0;
  refused(world, config, "budget");
  config = quick_config();
  config.radius = std::numeric_limits<double>::quiet_NaN();
  refused(world, config, "radius");
  World open = world;
  open.planes.clear();
  open.boxes.clear();
  refused(open, quick_config(), "");
}

}  // namespace
}  // namespace ridgeway
