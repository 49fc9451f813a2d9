// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What is asked of an exploration flight, and what is told of it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/number_text.hpp"
#include "common/require.hpp"
#include "exploration_flight.hpp"

namespace ridgeway {

void ExplorationFlightConfig::validate() const {
  using detail::require;
  require(radius > 0.0 && std::isfinite(radius), "radius", radius, "give metres above 0");
  require(margin >= 0.0 && std::isfinite(margin), "margin", margin, "give metres from 0");
  require(start.allFinite(), "start", start.x(), "give three finite coordinates");
  require(std::isfinite(start_yaw), "start_yaw", start_yaw, "give radians");
  require(start_radius == 0.0 || start_radius >= least_start_radius(), "start_radius", start_radius,
          "give at least the radius, the margin and the diagonal of a voxel, or 0: " +
              number_text(std::ceil(100.0 * least_start_radius()) / 100.0));
  require(voxel_size > 0.0 && std::isfinite(voxel_size), "voxel_size", voxel_size,
          "give metres above 0");
  require(scan_rate > 0.0 && std::isfinite(scan_rate), "scan_rate", scan_rate,
          "give images a second, above 0");
  require(longest > 0.0 && std::isfinite(longest), "longest", longest, "give seconds above 0");
  require(max_distance > clearance(), "max_distance", max_distance,
          "give more than the radius and the margin");
  if (lidar)
    lidar->validate();
  else
    sensor.validate();
  require(max_range() >= 2.0 * voxel_size, "max_range", max_range(), "give at least two voxels");
  require(max_range() > free_radius() + 2.0 * voxel_size, "max_range", max_range(),
          "give more than the " + number_text(std::ceil(100.0 * free_radius()) / 100.0) +
              " m around the start that are taken for free, and two voxels, or a start_radius "
              "below it: nothing new is seen from there otherwise");
  require(!forget_after || (*forget_after >= 0 && *forget_after <= 255), "forget_after",
          forget_after.value_or(0), "give 0 to 255");
  explorer.motion.validate();
  require(!std::isfinite(budget) || is_by_explorer(), "budget", budget,
          "leave it out, or take the planner ridgeway or frontier: no other comes back in time");
  const double turn = 2.0 * std::numbers::pi / explorer.motion.max_yaw_rate;
  require(budget >= turn, "budget", budget,
          "give at least the " + number_text(std::ceil(10.0 * turn) / 10.0) +
              " s that the drone takes to turn once around");
  // The flight is looked at when an image is taken, so it ends no earlier.
  const double period = 1.0 / scan_rate;
  require(budget >= period, "budget", budget, "give at least the time between two images");
  require(longest >= period, "longest", longest, "give at least the time between two images");
  if (bounds) validate_box(*bounds, "bounds");
}

FieldOfView ExplorationFlightConfig::view() const {
  return lidar ? field_of_view(*lidar, 0.7, 2.0 * voxel_size) : field_of_view(sensor);
}

FieldOfView ExplorationFlightConfig::whole_view() const {
  return lidar ? field_of_view(*lidar, 1.0) : field_of_view(sensor, 1.0);
}

double ExplorationFlightConfig::least_start_radius() const {
  // The start lies anywhere in its voxel, and voxels are in the ball by their centres: so the robot
  // fits at the centre of its voxel and of the next.
  return clearance() + std::numbers::sqrt3 * voxel_size;
}

double ExplorationFlightConfig::free_radius() const {
  if (start_radius > 0.0) return start_radius;
  const FieldOfView seen = view();
  const double half_angle = 0.5 * std::min({seen.vertical, seen.horizontal, std::numbers::pi});
  // Where the edges of the view leave the ball the robot must fit between them.
  return std::max(clearance() + 2.0 * voxel_size,
                  clearance() / std::sin(half_angle) + 0.25 * voxel_size);
}

std::string_view ExplorationFlight::end_name() const {
  if (end == ExplorationStatus::kComplete && !is_complete) return "finished";
  return end == ExplorationStatus::kKeep ? "cut_off" : name_of(end);
}

double ExplorationFlight::seconds_to(double share) const {
  for (const ExplorationSample& sample : samples)
    if (sample.mapped >= share) return sample.state.time;
  return std::numeric_limits<double>::infinity();
}

double ExplorationFlight::length_to(double share) const {
  double flown = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) flown += (samples[i].state.position - samples[i - 1].state.position).norm();
    if (samples[i].mapped >= share) return flown;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace ridgeway
