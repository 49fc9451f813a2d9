// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Every trajectory along the paths of random queries, before an independent judge: on a maze, the
// bundled scan, random maps, and the tree below the folder that RIDGEWAY_MAPS names.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "experiments/flight_judge.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "sensing/world_generators.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

struct Tally {
  int flown = 0, not_smooth = 0;
  std::vector<double> ratios;  ///< over the time of a trapezoidal profile without corners
  double median_ratio() {
    std::sort(ratios.begin(), ratios.end());
    return ratios.empty() ? 0.0 : ratios[ratios.size() / 2];
  }
};

double length_of(const std::vector<Point>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// Flies the paths of a roadmap's random queries.
void fly(const OccupancyMap& map, const BuildConfig& build, std::size_t queries, Tally& tally,
         Smoothness smoothness = Smoothness::kSnap) {
  const Roadmap roadmap = build_roadmap(map, build).roadmap;
  const FlightJudge judge(map, build.unknown);
  const CheckReport report = check_roadmap(roadmap, {.queries = queries, .seed = 5});
  for (const CheckedPath& path : report.paths) {
    SCOPED_TRACE(tally.flown);
    TrajectoryConfig config{.radius = path.radius};
    config.smoothness = smoothness;
    const TrajectoryResult result = plan_trajectory(roadmap.esdf, path.waypoints, config);
    ASSERT_TRUE(result.ok()) << name_of(result.status);
    const FlightVerdict verdict =
        judge.judge(result, path.waypoints.front(), path.waypoints.back(), config);
    ASSERT_EQ(verdict.complaint, "") << name_of(result.step);
    ASSERT_TRUE(config.motion.hold(result.peaks));
    ASSERT_GE(result.clearance, config.radius * (1.0 - 1e-9));
    ASSERT_LE(result.duration, result.stop_and_go_duration * (1.0 + 1e-12));
    ASSERT_NEAR(result.duration, result.trajectory.duration(), 1e-9);
    const double v = config.motion.max_speed, a = config.motion.max_acceleration;
    const double length = length_of(path.waypoints);
    if (length >= v * v / a) tally.ratios.push_back(result.duration / (length / v + v / a));
    ++tally.flown;
    tally.not_smooth += result.step != TrajectoryStep::kSmooth;
  }
}

OccupancyMap maze(int cells) {
  const World world = make_maze({.cells = cells, .seed = 3});
  const double side = 3.0 * cells + 0.5;
  return occupancy_of(world, 0.1, {{-0.4, -0.4, -0.2}, {side, side, 2.7}});
}

TEST(TrajectoryOnMaps, HoldsInAMaze) {
  const OccupancyMap map = maze(6);
  Tally tally;
  fly(map, {.min_clearance = 0.3}, 50, tally);
  EXPECT_GE(tally.flown, 30);
  EXPECT_LE(tally.median_ratio(), 1.35);
}

TEST(TrajectoryOnMaps, HoldsOnTheBundledScan) {
  const OccupancyMap map = load_map(fs::path(RIDGEWAY_DATA_DIR) / "fr_079.bt");
  Tally tally;
  fly(map, {.min_clearance = 0.3}, 30, tally);
  EXPECT_GE(tally.flown, 15);
  EXPECT_LE(tally.median_ratio(), 1.35);
}

TEST(TrajectoryOnMaps, HoldsBesideTheUnknownWhereItIsIgnored) {
  OccupancyMap map = maze(4);
  std::mt19937 random(6);
  const std::size_t voxels = map.layout.voxel_count();
  for (int i = 0; i < 600; ++i) {  // cubes that nobody has seen
    const VoxelIndex corner = map.layout.index_of(static_cast<VoxelId>(random() % voxels));
    for (int k = 0; k < 5 * 5 * 5; ++k) {
      const VoxelId id = map.layout.find(corner + VoxelIndex{k % 5, k / 5 % 5, k / 25});
      if (id != kNoVoxel) map.state[id] = VoxelState::kUnknown;
    }
  }
  Tally tally;
  fly(map, {.min_clearance = 0.3, .unknown = UnknownPolicy::kIgnore}, 80, tally);
  EXPECT_GE(tally.flown, 20);
  EXPECT_GT(tally.not_smooth, 0);
}

TEST(TrajectoryOnMaps, HoldsOnRandomMapsWithEveryPolicyAndDerivative) {
  Tally tally;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    try {
      fly(testing::random_map(seed, 30), {.min_clearance = 0.1, .unknown = policy}, 8, tally,
          seed % 2 == 0 ? Smoothness::kJerk : Smoothness::kSnap);
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.flown, 100);
  EXPECT_GT(tally.not_smooth, 5);  // the later steps are seen too
}

TEST(TrajectoryOnMaps, HoldsAroundTheTree) {
  const char* folder = std::getenv("RIDGEWAY_MAPS");
  if (folder == nullptr) GTEST_SKIP() << "RIDGEWAY_MAPS names no folder";
  Tally tally;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename() == "tree.bt")
      fly(load_map(entry.path()), {.min_clearance = 0.3}, 40, tally);
  if (tally.flown == 0) GTEST_SKIP() << "no tree.bt";
  EXPECT_LE(tally.median_ratio(), 1.35);
}

}  // namespace
}  // namespace ridgeway
