// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/components.hpp"

namespace ridgeway {

/// Why there is no route from one place to another at a radius.
struct BlockedRoute {
  /// Largest radius at which there is a way, over the moves between voxels, metres. It may be below
  /// the roadmap's min_clearance, for which a roadmap has to be built then; 0: there is no way
  /// through known-free space for any robot. Limits of the flight count for none of this; where
  /// they are what is in the way it is 0, and there is no place.
  double radius = 0.0;
  /// Where the widest way is narrowest. Where there is none at all: the nearest unknown voxel of
  /// the map, by moves from the start, beyond which nothing occupied is known to be in the way;
  /// nothing where what is occupied parts the two. The map ends at the box around all that is known
  /// (see known_bounds). Metres, world frame.
  std::optional<Point> place;
  /// Where what is occupied parts the two, but may not do so beyond the map's end: a place near the
  /// start at which a way would leave the map. Nothing where what is occupied encloses one of the
  /// two. Metres, world frame.
  std::optional<Point> map_end;
  Blocker by = Blocker::kObstacle;  ///< what is nearest there; of equally near ones the obstacle
  // The two parts of traversable space at the asked radius, and their numbers among all parts,
  // largest first:
  Component start_component;     ///< that the start is in
  Component goal_component;      ///< that the goal is in
  std::size_t start_number = 0;  ///< that of the start
  std::size_t goal_number = 0;   ///< that of the goal
};

/// Tells why plan() found no route, exactly. Made in about the time of the kernel's stage (the
/// basins of all free space); one answer then takes time linear in the voxels. A view: the roadmap
/// must outlive it. Thread-safe.
class RouteBlocks {
 public:
  explicit RouteBlocks(const Roadmap& roadmap);  ///< Finds the basins of all free space.
  explicit RouteBlocks(const Roadmap&&) = delete;

  /// Between points of the world that plan() found no route between, for a sphere of a radius in
  /// metres. Nothing where start or goal have no place at the radius: then plan() says which and
  /// why. `limits`: as in PlanConfig.
  /// Throws InputError where they are bad, or the radius is not above 0 or beyond the map's
  /// distances.
  std::optional<BlockedRoute> between(const Point& start, const Point& goal, double radius,
                                      const FlightLimits& limits = {}) const;

 private:
  const EsdfMap& esdf_;
  SpaceParts parts_;
};

/// The smallest PlanConfig::snap with which there is a path, metres, to a billionth; 0 where there
/// is one without. Nothing where `farthest`, metres, does not do. `config.snap` does not count.
/// Takes some plans, more the farther it is. Thread-safe; throws what plan() does, and InputError
/// where `farthest` is negative or not finite.
std::optional<double> smallest_snap(const Roadmap& roadmap, const Point& start, const Point& goal,
                                    double farthest, PlanConfig config = {});

/// What a robot finds at a place.
struct PlaceFacts {
  /// kOk, or why the robot cannot be there, as of a start.
  PlanStatus status = PlanStatus::kOk;
  VoxelState state = VoxelState::kUnknown;  ///< of the voxel
  double clearance = 0.0;                   ///< metres; 0 in an obstacle
  /// Where the robot fits: its number among `report.components`, and of each other part the widest
  /// way there: at which radius it would be one with this part, where that is narrowest, and what
  /// is in the way; widest first. Parts that no robot reaches are left out.
  std::size_t component = 0;
  std::vector<ComponentJoin> ways;  ///< `a` is the component, `b` the other
  ComponentReport report;           ///< all parts of space for that robot
};

/// At a point of the world, for a sphere of the radius that the roadmap was made for, within the
/// limits of its flights. Takes about as long as report_components. Throws InputError for a point
/// that is not finite.
PlaceFacts describe_place(const Roadmap& roadmap, const Point& point);

}  // namespace ridgeway
