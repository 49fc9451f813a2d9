// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Maps that change: a door, and anything at random.
#include <algorithm>
#include <cmath>
#include <memory>

#include "common/random.hpp"
#include "common/require.hpp"
#include "live_flight.hpp"
#include "process_memory.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/planning/plan.hpp"
#include "sensing/poses.hpp"

namespace ridgeway {
namespace {

constexpr double kWall = 0.2;           // metres thick
constexpr int kLook = 16;               // scans in each room before anything happens
constexpr int kClosed = 2 * kLook + 8;  // the first scan of the closed door
constexpr int kOpen = kClosed + 40;     // and of the door that is open again
constexpr int kScans = kOpen + 40;
const Point kHere(2.5, 2.5, 1.25), kThere(7.5, 2.5, 1.25);

/// Two rooms of 5 x 5 x 2.5 m and a door of 1.2 m between them; a scan a second.
World two_rooms() {
  World world;
  world.name = "door";
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d inward = Eigen::Vector3d::Unit(axis);
    world.planes.push_back({inward, 0.0});
    world.planes.push_back({-inward, -Point(10.0, 5.0, 2.5)[axis]});
  }
  world.boxes.push_back({.centre = {5.0, 0.95, 1.25}, .size = {kWall, 1.9, 2.5}});
  world.boxes.push_back({.centre = {5.0, 4.05, 1.25}, .size = {kWall, 1.9, 2.5}});
  TimedSolids door;
  door.from = kClosed;
  door.until = kOpen;
  door.boxes.push_back({.centre = {5.0, 2.5, 1.25}, .size = {kWall, 1.2, 2.5}});
  world.timed.push_back(door);
  return world;
}

/// First all around in both rooms, then at the door.
Eigen::Isometry3d pose_at(int scan) {
  const double heading = 2.0 * M_PI * scan / kLook;
  if (scan < kLook) return level_pose(kThere, heading);
  if (scan < 2 * kLook) return level_pose(kHere, heading);
  return level_pose(kHere, 0.0);
}

/// Boxes and specks of any state.
std::vector<VoxelChange> random_set(Random& random) {
  const auto below = [&](int n) {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(n)));
  };
  std::vector<VoxelChange> changes;
  const auto fill = [&](int largest) {
    constexpr VoxelState kStates[] = {VoxelState::kUnknown, VoxelState::kFree, VoxelState::kFree,
                                      VoxelState::kOccupied};
    const VoxelState state = kStates[below(4)];
    const VoxelIndex low{below(26) - 12, below(22) - 9, below(20) - 11};
    const VoxelIndex size{1 + below(largest), 1 + below(largest), 1 + below(largest)};
    for (int z = low.z; z < std::min(low.z + size.z, 9); ++z)
      for (int y = low.y; y < std::min(low.y + size.y, 12); ++y)
        for (int x = low.x; x < std::min(low.x + size.x, 14); ++x)
          changes.push_back({{x, y, z}, state});
  };
  const int boxes = below(4), specks = below(12);
  for (int i = 0; i < boxes; ++i) fill(i == 0 ? 24 : 6);
  for (int i = 0; i < specks; ++i) fill(1);
  return changes;
}

}  // namespace

void DoorConfig::validate() const {
  FusionConfig{.voxel_size = voxel_size, .forget_after = forget_after}.validate();
  detail::require(sigma >= 0.0 && std::isfinite(sigma), "sigma", sigma, "give metres, 0 or more");
}

DoorResult run_door(const DoorConfig& config, const Progress& progress) {
  config.validate();
  DepthSensor sensor;
  sensor.range_sigma = config.sigma;
  const World world = two_rooms();
  const LiveConfig live_config = {
      .fusion = {.voxel_size = config.voxel_size, .forget_after = config.forget_after},
      .build = {.min_clearance = config.min_clearance,
                .max_distance = config.max_distance,
                .tangent_pairs = 0}};
  DoorResult result;
  result.flight.scans.reserve(kScans);
  const std::uint64_t before = detail::allocated_bytes();
  LiveRoadmap live(live_config);
  auto judge = std::make_unique<LiveJudge>(live_config.build, config.verify_every);
  Random seeds(config.seed);
  for (int scan = 0; scan < kScans; ++scan) {
    if (progress && !progress("door", static_cast<double>(scan) / kScans)) throw Cancelled();
    const Eigen::Isometry3d pose = pose_at(scan);
    const DepthImage image = render_depth(world_at(world, scan), sensor, pose, seeds.bits());
    result.flight.scans.push_back(judge->judge(live, live.integrate(image, sensor.camera, pose)));
    const std::shared_ptr<const Roadmap> now = live.snapshot();
    const bool has_path = now != nullptr && plan(*now, kHere, kThere).ok();
    if (scan == kClosed - 1) result.has_path_first = has_path;
    if (scan >= kClosed && scan < kOpen && !has_path && result.until_no_path < 0)
      result.until_no_path = scan - kClosed + 1;
    if (scan >= kOpen && has_path && result.until_path < 0) result.until_path = scan - kOpen + 1;
  }
  judge.reset();
  result.flight.memory_ratio = memory_ratio(live, live_config.build, before);
  return result;
}

void run_change_sets(std::size_t count, std::uint64_t seed, const Progress& progress,
                     ChangeSets& results) {
  constexpr std::size_t kOfOneMap = 20;
  results = {};
  for (std::size_t map = 0; results.done < count; ++map) {
    Random random(seed, map);
    const BuildConfig build = {
        .min_clearance = 0.1,
        .max_distance = map % 2 == 0 ? std::numeric_limits<double>::infinity() : 0.45,
        .tangent_pairs = 0};
    LiveRoadmap live({.build = build});
    LiveJudge judge(build, 1);
    for (std::size_t i = 0; i < kOfOneMap && results.done < count; ++i) {
      if (progress &&
          !progress("change", static_cast<double>(results.done) / static_cast<double>(count)))
        throw Cancelled();
      const std::vector<VoxelChange> changes = random_set(random);
      LiveScan scan;
      with_threads(static_cast<int>(1 + i % 2),
                   [&] { scan = judge.judge(live, live.set_voxels(changes)); });
      ++results.done;
      results.same += scan.is_same;
      results.without_roadmap += !scan.is_judged;
    }
  }
}

}  // namespace ridgeway
