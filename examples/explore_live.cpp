// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// example_explore_live WORLD X,Y,Z: the planner against a live roadmap. A robot with a camera
// looks, asks what to do, and follows the trajectory that it gets until the next image. Simulated
// here: with a real robot render_depth() is its camera, and state_at() its state estimation.
#include <cstdio>
#include <exception>
#include <numbers>

#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/live/live_roadmap.hpp"

namespace {

Eigen::Isometry3d camera_pose(const ridgeway::FlightState& state) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = state.position;
  pose.linear() = (Eigen::AngleAxisd(state.yaw, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();  // x right, y down, z forward
  return pose;
}

ridgeway::FlightState state_at(const ridgeway::Trajectory& flying, double since, double time) {
  const ridgeway::TrajectoryState at = flying.at(time - since);
  return {time, at.position, at.velocity, at.acceleration, at.yaw};
}

}  // namespace

int main(int argc, char** argv) try {
  ridgeway::Point start;
  if (argc != 3 || std::sscanf(argv[2], "%lf,%lf,%lf", &start.x(), &start.y(), &start.z()) != 3) {
    std::fprintf(stderr, "usage: example_explore_live WORLD X,Y,Z\n");
    return 1;
  }
  const ridgeway::World world = ridgeway::load_world(argv[1]);
  ridgeway::DepthSensor sensor;
  sensor.camera = {.width = 160, .height = 120, .fx = 80, .fy = 80, .cx = 79.5, .cy = 59.5};
  constexpr double kVoxel = 0.2, kClearance = 0.5;
  ridgeway::LiveRoadmap live({.fusion = {.voxel_size = kVoxel},
                              .build = {.min_clearance = kClearance, .max_distance = 3.0}});
  std::vector<ridgeway::VoxelChange> free;  // around the start, as somebody has looked
  for (int z = -5; z <= 5; ++z)
    for (int y = -5; y <= 5; ++y)
      for (int x = -5; x <= 5; ++x)
        if (x * x + y * y + z * z <= 25)
          free.push_back({ridgeway::voxel_at(start, kVoxel) + ridgeway::VoxelIndex{x, y, z},
                          ridgeway::VoxelState::kFree});
  live.set_voxels(free);

  ridgeway::Explorer explorer({.view = ridgeway::field_of_view(sensor), .home = start});
  ridgeway::Trajectory flying;
  ridgeway::TrajectorySegment stand;
  stand.coefficients.col(0).head<3>() = start;
  flying.segments = {stand};
  double since = 0.0;
  for (double time = 0.0; time < 600.0; time += 0.25) {
    const ridgeway::FlightState state = state_at(flying, since, time);
    const Eigen::Isometry3d pose = camera_pose(state);
    live.integrate(ridgeway::render_depth(world, sensor, pose), sensor.camera, pose);
    const ridgeway::ExplorationStep step = explorer.decide(live.snapshot(), state);
    if (!step.trajectory.segments.empty()) {
      flying = step.trajectory;
      since = time;
      std::printf("%.2f s: %zu frontiers, %.1f s to fly\n", time, step.frontiers,
                  flying.duration());
    }
    if (step.status == ridgeway::ExplorationStatus::kComplete ||
        step.status == ridgeway::ExplorationStatus::kStuck) {
      std::printf("%.2f s: %s\n", time, std::string(ridgeway::name_of(step.status)).c_str());
      return 0;
    }
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
