// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "common/random.hpp"
#include "common/require.hpp"
#include "live_queries.hpp"
#include "process_memory.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/planning/plan.hpp"
#include "sensing/poses.hpp"

namespace ridgeway {
namespace {

/// Level poses along paths between random places, looking where they go.
std::vector<Eigen::Isometry3d> forward_flight(const World& world, const LiveFlightConfig& config) {
  constexpr double kTruth = 0.1, kBody = 0.4;
  constexpr int kMostLegs = 10000;
  const PoseSampling inside = sampling_inside(world);
  const Roadmap truth = build_roadmap(occupancy_of(world, kTruth, {inside.low, inside.high}),
                                      {.min_clearance = kBody})
                            .roadmap;
  Random random(config.seed);
  const auto place = [&]() -> Point {
    Point share;  // in an order of our own: that of arguments is the compiler's choice
    for (const int axis : {2, 1, 0}) share[axis] = random.uniform();
    return inside.low + share.cwiseProduct(inside.high - inside.low);
  };
  std::vector<Eigen::Isometry3d> poses;
  Point at = place();
  double left = 0.0;  // of the way to the next scan
  for (int leg = 0; leg < kMostLegs && poses.size() < config.scans; ++leg) {
    const Point to = place();
    const PlanResult path = plan(truth, at, to);
    if (path.status == PlanStatus::kStartInCollision || path.status == PlanStatus::kStartUnknown)
      at = to;
    if (path.status != PlanStatus::kOk) continue;
    for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
      const Eigen::Vector3d step = path.waypoints[i + 1] - path.waypoints[i];
      for (; left < step.norm() && poses.size() < config.scans; left += config.spacing)
        poses.push_back(level_pose(path.waypoints[i] + left * step.normalized(),
                                   std::atan2(step.y(), step.x())));
      left -= step.norm();
    }
    at = to;
  }
  if (poses.size() < config.scans)
    throw InputError(world.name, "has hardly any ways between its places",
                     "give a world with free space in it");
  return poses;
}

/// Copies of the world's exact map, one behind the other along x, none of them near it.
std::vector<VoxelChange> copies_of(const World& world, const LiveFlightConfig& config) {
  std::vector<VoxelChange> changes;
  if (config.copies == 0) return changes;
  const PoseSampling inside = sampling_inside(world);
  const OccupancyMap map = occupancy_of(world, config.voxel_size, {inside.low, inside.high});
  const VoxelRange known = known_range(map);
  const int step = known.max.x - known.min.x + 8 * kBlockSide;
  for (std::size_t copy = 1; copy <= config.copies; ++copy)
    for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
      if (map.state[id] != VoxelState::kUnknown) {
        VoxelIndex voxel = map.origin + map.layout.index_of(id);
        voxel.x += step * static_cast<int>(copy);
        changes.push_back({voxel, map.state[id]});
      }
  return changes;
}

}  // namespace

void LiveFlightConfig::validate() const {
  BuildConfig{.min_clearance = min_clearance, .max_distance = max_distance}.validate();
  FusionConfig{.voxel_size = voxel_size}.validate();
  detail::require(spacing > 0.0 && std::isfinite(spacing), "spacing", spacing, "give metres");
  DepthSensor sensor;
  sensor.range_sigma = sigma;
  sensor.validate();
}

std::optional<double> memory_ratio(const LiveRoadmap& live, const BuildConfig& build,
                                   std::uint64_t before) {
  const std::uint64_t with_live = detail::allocated_bytes();
  const Roadmap batch = build_roadmap(live.map(), build).roadmap;
  const std::uint64_t with_both = detail::allocated_bytes();
  if (with_live <= before || with_both <= with_live) return std::nullopt;
  return static_cast<double>(with_live - before) / static_cast<double>(with_both - with_live);
}

void run_live_flight(const World& world, const LiveFlightConfig& config, const Progress& progress,
                     LiveFlight& results) {
  results = {};
  config.validate();
  DepthSensor sensor;
  sensor.range_sigma = config.sigma;
  const std::vector<Eigen::Isometry3d> poses = forward_flight(world, config);
  const LiveConfig live_config = {
      .fusion = {.voxel_size = config.voxel_size},
      .build = {.min_clearance = config.min_clearance,
                .max_distance = config.max_distance,
                .tangent_pairs = config.tangent_pairs},
      .origin = voxel_at(poses.front().translation(), config.voxel_size)};
  results.scans.reserve(poses.size());
  const std::uint64_t before = detail::allocated_bytes();
  LiveRoadmap live(live_config);
  if (const std::vector<VoxelChange> copies = copies_of(world, config); !copies.empty())
    live.set_voxels(copies);
  auto judge = std::make_unique<LiveJudge>(live_config.build, config.verify_every);
  Random seeds(config.seed);
  constexpr std::size_t kAsFastAsItCan = std::numeric_limits<std::size_t>::max();
  {
    LiveQueryLoad load(live, config.queries ? kAsFastAsItCan : 0, config.seed, results.queries);
    for (const Eigen::Isometry3d& pose : poses) {
      const auto done =
          static_cast<double>(results.scans.size()) / static_cast<double>(config.scans);
      if (progress && !progress("fly", done)) throw Cancelled();
      const DepthImage image = render_depth(world, sensor, pose, seeds.bits());
      results.scans.push_back(judge->judge(live, live.integrate(image, sensor.camera, pose)));
    }
    load.ask_again();
  }
  judge.reset();
  results.memory_ratio = memory_ratio(live, live_config.build, before);
}

}  // namespace ridgeway
