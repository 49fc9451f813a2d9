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

/// What is in the way.
enum class Blocker : std::uint8_t {
  kObstacle,  ///< something occupied
  kUnknown,   ///< space that may be free, for all that is known
  kLimits,    ///< limits of the flight alone: without them there is a way at the radius
};
/// "obstacle", "unknown" or "limits".
std::string_view name_of(Blocker blocker);

/// Why there is no route from one place to another at a radius.
struct BlockedRoute {
  /// Largest radius at which there is a way, over the moves between voxels, metres. It may be below
  /// the roadmap's min_clearance, for which a roadmap has to be built then; 0: there is no way
  /// through known-free space for any robot. Limits of the flight count for none of this; where
  /// they are what is in the way it is 0, and there is no place.
  double radius = 0.0;
  /// Where the widest way is narrowest. Where there is none at all: the nearest unknown voxel, by
  /// moves from the start, beyond which nothing occupied is known to be in the way; nothing where
  /// what is occupied encloses one of the two. Metres, world frame.
  std::optional<Point> place;
  Blocker by = Blocker::kObstacle;  ///< what is nearest there; of equally near ones the obstacle
  /// The two parts of traversable space at the asked radius that start and goal are in, and their
  /// numbers among all parts, largest first.
  Component start_component, goal_component;
  std::size_t start_number = 0, goal_number = 0;
};

/// Tells why plan() found no route, exactly. Made in about the time of the kernel's stage (the
/// basins of all free space); one answer then takes time linear in the voxels. A view: the roadmap
/// must outlive it. Thread-safe.
class RouteBlocks {
 public:
  explicit RouteBlocks(const Roadmap& roadmap);

  /// Between points of the world. Nothing where start or goal have no place at the radius: then
  /// plan() says which and why. `limits`: as in PlanConfig.
  std::optional<BlockedRoute> between(const Point& start, const Point& goal, double radius,
                                      const FlightLimits& limits = {}) const;

 private:
  const EsdfMap& esdf_;
  SpaceParts parts_;
  Surroundings around_;
};

}  // namespace ridgeway
