// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "fusion_speed.hpp"

#include <cmath>
#include <functional>

#include "common/clock.hpp"
#include "common/random.hpp"
#include "plain_fusion.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using detail::seconds_now;

struct Scan {
  DepthImage image;
  Eigen::Isometry3d T_world_camera;
};

/// A way to fuse: one scan after the other, then the map.
struct Integration {
  std::string name;
  std::function<void(const Scan&)> add;
  std::function<TsdfMap()> map;
};

FusionSpeed measure(const World& world, const std::vector<Scan>& scans,
                    const Integration& integration) {
  FusionSpeed result;
  result.integrator = integration.name;
  std::vector<double> times;
  for (const Scan& scan : scans) {
    const double begin = seconds_now();
    integration.add(scan);
    times.push_back(1e3 * (seconds_now() - begin));
  }
  result.milliseconds = spread_of(std::move(times));
  const TsdfMap map = integration.map();
  std::vector<double> errors;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const auto distance = static_cast<double>(map.distance[id]);
    if (!(map.weight[id] > 0.0f) || std::abs(distance) >= 0.99 * map.truncation) continue;
    const Point centre = to_world(map, centre_of(map.layout.index_of(id), map.voxel_size));
    const double exact = surface_distance(world, centre).distance;
    errors.push_back(std::abs(distance - exact) / map.voxel_size);
    result.mean_error += errors.back();
  }
  result.voxels = errors.size();
  result.mean_error /= static_cast<double>(std::max<std::size_t>(errors.size(), 1));
  result.error = spread_of(std::move(errors));
  return result;
}

}  // namespace

void FusionSpeedConfig::validate() const {
  FusionConfig{.voxel_size = voxel_size, .truncation = truncation}.validate();
  DepthSensor sensor;
  sensor.range_sigma = sigma;
  sensor.validate();
  poses.validate();
}

std::vector<FusionSpeed> run_fusion_speed(const World& world, const FusionSpeedConfig& config,
                                          const Progress& progress) {
  std::vector<FusionSpeed> results;
  run_fusion_speed(world, config, progress, results);
  return results;
}

void run_fusion_speed(const World& world, const FusionSpeedConfig& config, const Progress& progress,
                      std::vector<FusionSpeed>& results) {
  results.clear();
  config.validate();
  DepthSensor sensor;
  sensor.range_sigma = config.sigma;
  std::vector<Scan> scans;
  Random seeds(config.seed);
  for (const Eigen::Isometry3d& pose : sample_poses(world, config.poses)) {
    if (progress && !progress("scans", 0.0)) throw Cancelled();
    scans.push_back({render_depth(world, sensor, pose, seeds.bits()), pose});
  }

  FusionConfig fusion{.voxel_size = config.voxel_size, .truncation = config.truncation};
  TsdfFusion projective(fusion);
  fusion.integrator = Integrator::kRayCasting;
  TsdfFusion rays(fusion);
  const PoseSampling inside =
      sampling_inside(world);  // where there are no walls, cameras may be out
  const Box looked_at{inside.low.cwiseMin(config.poses.low),
                      inside.high.cwiseMax(config.poses.high)};
  detail::PlainVoxels plain_voxels(config.voxel_size, config.truncation, looked_at);
  detail::PlainRays plain_rays(config.voxel_size, config.truncation);
  const PinholeCamera& camera = sensor.camera;
  const auto way = [&](std::string name, auto& method) {
    return Integration{
        std::move(name),
        [&](const Scan& scan) { method.integrate(scan.image, camera, scan.T_world_camera); },
        [&] { return method.map(); }};
  };
  const std::vector<Integration> ways = {way("projective", projective), way("rays", rays),
                                         way("plain voxels", plain_voxels),
                                         way("plain rays", plain_rays)};
  for (const Integration& integration : ways) {
    const auto done = static_cast<double>(results.size()) / static_cast<double>(ways.size());
    if (progress && !progress(integration.name, done)) throw Cancelled();
    results.push_back(measure(world, scans, integration));
  }
}

}  // namespace ridgeway
