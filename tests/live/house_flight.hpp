// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "files/read_file.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "sensing/poses.hpp"
#include "sensing/world_generators.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway::testing {

/// The bytes of a roadmap's file; none for no roadmap.
inline std::string bytes_of(const Roadmap* roadmap) {
  if (roadmap == nullptr) return {};
  const TemporaryFolder folder;
  save_roadmap(*roadmap, folder / "map.ridge");
  return read_file(folder / "map.ridge");
}

inline std::string batch_bytes(const OccupancyMap& map, const BuildConfig& config) {
  try {
    const BuildResult result = build_roadmap(map, config);
    return bytes_of(&result.roadmap);
  } catch (const InputError&) {
    return {};  // no voxel is traversable
  }
}

struct Scan {
  DepthImage image;
  Eigen::Isometry3d T_world_camera;
};

inline DepthSensor sensor_of_flight() {
  DepthSensor sensor;
  sensor.camera = {.width = 160, .height = 120, .fx = 80.0, .fy = 80.0, .cx = 79.5, .cy = 59.5};
  sensor.range_sigma = 0.01;
  return sensor;
}

inline std::vector<Scan> flight_through_house(std::size_t count) {
  const World world = make_house();
  std::vector<Scan> scans;
  for (const Eigen::Isometry3d& pose :
       sample_poses(world, {.low = {1, 1, 1}, .high = {14, 10, 4}, .count = count, .seed = 1}))
    scans.push_back({render_depth(world, sensor_of_flight(), pose, scans.size()), pose});
  return scans;
}

inline LiveConfig house_config() {
  return {.fusion = {.voxel_size = 0.2, .clear_radius = 0.4},
          .build = {.min_clearance = 0.3, .max_distance = 2.0, .tangent_pairs = 200}};
}

}  // namespace ridgeway::testing
