// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// Who decides where to fly.
enum class ExplorationPlanner : std::uint8_t {
  kRidgeway,  ///< Explorer, by tours
  kFrontier,  ///< Explorer, nearest frontier
  kNextBest,  ///< receding horizon next best view (Bircher et al. 2016)
  kOffline,   ///< a tour by one that knows the world; does not come back
};

/// A simulated drone maps a world by itself. Metres, seconds, radians.
struct ExplorationFlightConfig {
  Point start = Point::Zero();
  double start_yaw = 0.0;
  /// Around the start, taken as free: somebody has looked. 0: what the robot needs and two voxels,
  /// more where it would not fit from there into what the sensor has in view.
  double start_radius = 0.0;
  double radius = 0.3;  ///< of the drone
  /// Kept beyond the radius, from known obstacles and from the unknown: for surfaces that the map
  /// has up to a voxel off. 0: a voxel.
  double margin = 0.0;
  double budget = std::numeric_limits<double>::infinity();  ///< until it must be back
  bool come_back = true;
  double voxel_size = 0.2;
  double max_distance = 4.0;  ///< distances stop here
  /// See FusionConfig; none: 8 in worlds with solids that come and go, else 0.
  std::optional<int> forget_after;
  double scan_rate = 4.0;     ///< images a second
  std::optional<Box> bounds;  ///< what is to be mapped; else the world's enclosure
  DepthSensor sensor;
  std::optional<SpinningLidar> lidar;  ///< in place of the camera
  double longest = 3600.0;             ///< flights are cut off then
  ExplorationPlanner planner = ExplorationPlanner::kRidgeway;
  ExplorerConfig explorer;  ///< limits, sizes; what follows from the rest is set by the flight
  std::uint64_t seed = 1;   ///< of the sensor's noise, and of planners that sample

  /// Whether Explorer decides: no other planner keeps a budget.
  bool is_by_explorer() const {
    return planner == ExplorationPlanner::kRidgeway || planner == ExplorationPlanner::kFrontier;
  }
  double clearance() const { return radius + (margin > 0.0 ? margin : voxel_size); }
  double least_start_radius() const;  ///< metres
  double free_radius() const;
  double min_range() const { return lidar ? lidar->min_range : sensor.min_range; }
  double max_range() const { return lidar ? lidar->max_range : sensor.max_range; }
  /// Of camera or lidar, as the explorer counts on it, or all that it may see.
  FieldOfView view() const;
  FieldOfView whole_view() const;

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// At a scan.
struct ExplorationSample {
  FlightState state;
  double mapped = 0.0;          ///< share of what can be seen at all that is known
  std::size_t frontiers = 0;    ///< clusters that are worth a look
  ExplorationSeconds seconds;   ///< of the decision on this machine; no part of the simulated time
  double update_seconds = 0.0;  ///< of the roadmap, likewise
};

struct ExplorationFlight {
  std::vector<ExplorationSample> samples;
  std::vector<Point> path;  ///< every few centiseconds
  ExplorationStatus end = ExplorationStatus::kKeep;
  bool is_complete = false;
  double seconds = 0.0, length = 0.0;
  double viewable_volume = 0.0;  ///< m^3 that can be seen at all
  double coverage = 0.0;         ///< share of it that is known at the end
  double nearest =
      std::numeric_limits<double>::infinity();  ///< to the exact world, less the radius
  std::size_t collisions = 0;                   ///< places of `path` nearer than the radius
  std::size_t decisions = 0, trajectories = 0, stops = 0, doubts = 0, brakes = 0;
  std::vector<UnseenFrontier> unseen;
  std::shared_ptr<const Roadmap> roadmap;  ///< settled
  OccupancyMap map;

  /// The name of `end`; "cut_off" where the flight came to none.
  std::string_view end_name() const;
  /// Seconds until a share was known; infinite where it never was.
  double seconds_to(double share) const;
  double length_to(double share) const;
};

/// Each image as it is fused, with its pose (camera to world).
using OnImage = std::function<void(const DepthImage&, const Eigen::Isometry3d&)>;

/// Each scan of a lidar as it is fused, points in its frame, with its pose (sensor to world).
using OnScan = std::function<void(std::span<const Point>, const Eigen::Isometry3d&)>;

/// A scan, and what was decided after it.
struct ExplorationMoment {
  std::shared_ptr<const Roadmap> roadmap;  ///< none where the robot fits nowhere
  std::size_t scan = 0;                    ///< counted from 1
  const ExplorationSample& sample;
  std::vector<Point> ahead;  ///< places of the trajectory that is flown, a few a second
};
using OnMoment = std::function<void(const ExplorationMoment&)>;

/// Flies until all is seen, or the time is up. Seeded: the same world and configuration give the
/// same flight and the same map. Throws InputError, before the flight, for a start that is no place
/// for the drone, a world without an enclosure and no bounds, a sensor that reaches less than two
/// voxels, a budget in which nothing can be done.
ExplorationFlight explore(const World& world, const ExplorationFlightConfig& config,
                          const Progress& progress = {}, const OnImage& on_image = {},
                          const OnMoment& on_moment = {}, const OnScan& on_scan = {});

}  // namespace ridgeway
