// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "flight_picture.hpp"

#include <algorithm>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway::cli {
namespace {

/// Speed, acceleration and clearance over time.
std::vector<Chart> charts_of(const EsdfMap& esdf, const std::vector<TrajectoryState>& states,
                             const TrajectoryConfig& config) {
  const FreeSpace space(esdf), robot(esdf, esdf.limits, config.radius, config.robot_height);
  const bool is_sphere = robot.is_for_sphere();
  Chart speed{"speed (m/s)", {}, {}, config.motion.max_speed, "limit"};
  Chart acceleration{"acceleration (m/s\u00b2)", {}, {}, config.motion.max_acceleration, "limit"};
  Chart clearance{"clearance (m)",
                  {},
                  {},
                  robot.inner_radius(config.radius),
                  is_sphere ? "robot's radius" : "sphere in the robot"};
  for (const TrajectoryState& state : states) {
    for (Chart* chart : {&speed, &acceleration, &clearance}) chart->times.push_back(state.time);
    speed.values.push_back(state.velocity.norm());
    acceleration.values.push_back(state.acceleration.norm());
    clearance.values.push_back(space.distance(to_local(esdf, state.position)));
  }
  return {speed, acceleration, clearance};
}

}  // namespace

void draw_flight(const Roadmap& roadmap, std::span<const Point> path, const TrajectoryResult& flown,
                 const TrajectoryConfig& config, const std::filesystem::path& out,
                 const std::string& title) {
  constexpr double kPoints = 1500.0;
  const auto states = flown.trajectory.sample(std::max(flown.duration / kPoints, 1e-3));
  std::vector<Point> curve;
  curve.reserve(states.size());
  for (const TrajectoryState& state : states) curve.push_back(state.position);
  PictureConfig picture;
  picture.title = title;
  picture.diagram = picture.graph = false;
  picture.raw_path.assign(path.begin(), path.end());
  picture.path_label = "trajectory";
  picture.raw_path_label = "path";
  picture.charts = charts_of(roadmap.esdf, states, config);
  draw_floor_plan(roadmap, curve, out, picture);
}

}  // namespace ridgeway::cli
