// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_flight.hpp"

#include <bit>
#include <cmath>
#include <utility>

#include "common/random.hpp"
#include "common/require.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/world_map.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
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
    const Point share(random.uniform(), random.uniform(), random.uniform());
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

/// What each stage makes of a field, as masks on its layout.
struct StageMasks {
  VoxelMask traversable, gvd, thick_edges, edges, kernel, diagram;
};

StageMasks masks_of(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  StageMasks stages;
  stages.traversable = traversable_voxels(esdf, roadmap.min_clearance);
  stages.gvd = compute_gvd(esdf, stages.traversable);
  stages.thick_edges = extract_edges(esdf, stages.gvd);
  stages.edges = stages.thick_edges;
  thin(esdf.layout, stages.edges);
  const Basins basins = find_basins(esdf, stages.traversable, roadmap.min_clearance);
  stages.kernel = compute_kernel(esdf, stages.traversable, basins);
  stages.diagram = roadmap.diagram.voxels;
  return stages;
}

/// `before` is of a layout to which blocks were added since.
StageChange change_of(const VoxelMask& before, const VoxelMask& now) {
  StageChange change;
  for (std::uint32_t slot = 0; slot < now.block_count(); ++slot) {
    std::size_t changed = 0;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t old = slot < before.block_count() ? before.block(slot)[z] : 0;
      change.voxels += static_cast<std::size_t>(std::popcount(now.block(slot)[z]));
      changed += static_cast<std::size_t>(std::popcount(old ^ now.block(slot)[z]));
    }
    change.changed += changed;
    change.blocks += changed > 0;
  }
  return change;
}

bool is_same(const Roadmap& a, const Roadmap& b) {
  if (a.graph.edges.size() != b.graph.edges.size() ||
      a.graph.vertices.size() != b.graph.vertices.size())
    return false;
  for (VoxelId id = 0; id < a.esdf.layout.voxel_count(); ++id) {
    const VoxelId same = b.esdf.layout.find(a.esdf.layout.index_of(id));
    if (same == kNoVoxel || a.esdf.squared[id] != b.esdf.squared[same] ||
        a.esdf.site[id] != b.esdf.site[same] || a.esdf.state[id] != b.esdf.state[same] ||
        a.diagram.voxels.test(id) != b.diagram.voxels.test(same) ||
        a.attach.next[id] != b.attach.next[same])
      return false;
  }
  return a.esdf.layout.block_count() == b.esdf.layout.block_count();
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

std::vector<LiveScan> run_live_flight(const World& world, const LiveFlightConfig& config,
                                      const Progress& progress) {
  std::vector<LiveScan> results;
  run_live_flight(world, config, progress, results);
  return results;
}

void run_live_flight(const World& world, const LiveFlightConfig& config, const Progress& progress,
                     std::vector<LiveScan>& results) {
  results.clear();
  config.validate();
  DepthSensor sensor;
  sensor.range_sigma = config.sigma;
  const LiveConfig live_config = {
      .fusion = {.voxel_size = config.voxel_size},
      .build = {.min_clearance = config.min_clearance, .max_distance = config.max_distance}};
  LiveRoadmap live(live_config);
  StageMasks before;
  Random seeds(config.seed);
  for (const Eigen::Isometry3d& pose : forward_flight(world, config)) {
    const auto done = static_cast<double>(results.size()) / static_cast<double>(config.scans);
    if (progress && !progress("fly", done)) throw Cancelled();
    LiveScan scan;
    scan.update =
        live.integrate(render_depth(world, sensor, pose, seeds.bits()), sensor.camera, pose);
    if (const auto now = live.snapshot()) {
      const OccupancyMap map = live.map();
      scan.known_voxels = count_voxels(map).known();
      scan.map_blocks = map.layout.block_count();
      const BuildResult batch = build_roadmap(map, live_config.build);
      scan.batch = batch.report.seconds;
      scan.is_same = is_same(*now, batch.roadmap);
      const StageMasks stages = masks_of(*now);
      for (auto [change, mask] : {std::pair(&LiveScan::traversable, &StageMasks::traversable),
                                  {&LiveScan::gvd, &StageMasks::gvd},
                                  {&LiveScan::thick_edges, &StageMasks::thick_edges},
                                  {&LiveScan::edges, &StageMasks::edges},
                                  {&LiveScan::kernel, &StageMasks::kernel},
                                  {&LiveScan::diagram, &StageMasks::diagram}})
        scan.*change = change_of(before.*mask, stages.*mask);
      before = stages;
    }
    results.push_back(scan);
  }
}

}  // namespace ridgeway
