// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "explore_options.hpp"

#include <numbers>

#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {

ExplorationFlightConfig ExploreSettings::flight() const {
  ExplorationFlightConfig flight = config;
  DepthSensor& sensor = flight.sensor;
  if (camera == "stereo") sensor = stereo_sensor();
  sensor.camera.width = width;
  sensor.camera.height = 3 * width / 4;
  sensor.camera.fx = sensor.camera.fy = 0.5 * width;
  sensor.camera.cx = 0.5 * (sensor.camera.width - 1);
  sensor.camera.cy = 0.5 * (sensor.camera.height - 1);
  sensor.range_sigma = sigma;
  sensor.max_range = max_range;
  for (const Option& option : of_lidars)
    if (option.is_given() && camera != "lidar")
      throw InputError(option.name(), "is of a lidar, and the camera is " + camera,
                       "leave it out, or give --camera lidar");
  if (camera == "lidar")
    flight.lidar = {.rows = rows,
                    .columns = 4 * width,
                    .vertical = vertical_angle * std::numbers::pi / 180.0,
                    .max_range = max_range,
                    .range_sigma = sigma};
  for (const Option& option : of_frontiers)
    if (option.is_given() && planner == "nbvp")
      throw InputError(option.name(), "is of planners that look for frontiers",
                       "leave it out, or give --planner ridgeway or frontier");
  flight.bounds = bounds;
  flight.explorer.motion.max_yaw_rate = max_yaw_rate * std::numbers::pi / 180.0;
  if (planner == "frontier") flight.planner = ExplorationPlanner::kFrontier;
  if (planner == "nbvp") flight.planner = ExplorationPlanner::kNextBest;
  if (planner == "offline") flight.planner = ExplorationPlanner::kOffline;
  return flight;
}

void add_explore_settings(Command& command, ExploreSettings& settings) {
  ExplorationFlightConfig& config = settings.config;
  command.number("--voxel-size", config.voxel_size, kLengths, "Of the map, metres");
  command.number("--radius", config.radius, kLengths, "Of the drone, metres");
  command.number("--margin", config.margin, kLengthsFromZero,
                 "Kept beyond the radius, metres; 0: a voxel");
  command.number(
      "--start-radius", config.start_radius, kLengthsFromZero,
      "Around the start, known to be free, metres; 0: as much as it takes to fly out of it");
  command.number("--max-distance", config.max_distance, kLengths, "Distances stop here, metres");
  command.number("--max-speed", config.explorer.motion.max_speed, kMotions, "Metres a second");
  command.number("--max-acceleration", config.explorer.motion.max_acceleration, kMotions,
                 "Metres a second^2");
  command.number("--max-yaw-rate", settings.max_yaw_rate, {.least = 1e-3, .most = 1e6},
                 "Degrees a second");
  command.choice("--camera", settings.camera, {"pinhole", "stereo", "lidar"},
                 "A perfect one, a stereo pair, or a lidar that spins");
  command.whole("--width", settings.width, {4, 4096},
                "Pixels across, of 90 degrees; 3/4 as many down, of a lidar --rows");
  settings.of_lidars = {
      command.whole("--rows", settings.rows, {2, 4096}, "Of a lidar, one above the other"),
      command.number("--vertical-angle", settings.vertical_angle,
                     {.least = 0.0, .most = 179.0, .above = true},
                     "Of a lidar, from the lowest row to the highest, degrees")};
  command.number("--sigma", settings.sigma, kLengthsFromZero,
                 "Gaussian noise on every range, metres");
  command.number("--max-range", settings.max_range, kLengths,
                 "Nothing farther is measured, metres");
  command.whole("--forget-after", config.forget_after, {0, 255},
                "Measurements in a row that contradict a voxel before it is forgotten; 0: never "
                "(default: 8 where the world has solids that come and go, else 0)");
  command.number("--scan-rate", config.scan_rate, {1e-3, 1e3}, "Images a second");
  command.box("--bounds", settings.bounds,
              "What is to be mapped, x0,y0,z0,x1,y1,z1 (default: the world's enclosure)");
  command.choice("--planner", settings.planner, {"ridgeway", "frontier", "nbvp"},
                 "Tours over all frontiers, the nearest frontier, or the next best view "
                 "(Bircher et al. 2016)");
  settings.of_frontiers = {
      command.whole("--least-frontier", config.explorer.least_frontier, {1, 1'000'000},
                    "Voxels of a frontier that is worth a look"),
      command.number("--spacing", config.explorer.spacing, kLengths, "Between viewpoints, metres")};
  command.number("--longest", config.longest, {.least = 0.0, .most = 1e6, .above = true},
                 "The flight is cut off then, seconds");
}

}  // namespace ridgeway::cli
