// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <vector>

#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

/// Routes from a start to a goal, each on other sides of obstacles than the others, or the one
/// reason why there is none.
struct Alternatives {
  PlanStatus status = PlanStatus::kNoRoute;  ///< kOk, or why there is no route
  std::vector<PlanResult> routes;            ///< shortest first; empty unless ok
  bool complete = false;  ///< all routes of the graph were looked at: asking for more finds no more
  double seconds = 0.0;   ///< in all

  /// Whether there is a route.
  bool ok() const { return status == PlanStatus::kOk; }
};

/// Up to `count` routes no two of which can be deformed into each other by uniform visibility
/// (Zhou et al. 2020: points at equal shares of two paths' lengths see each other), for a sphere of
/// three quarters of the asked radius, since tight paths touch the radius itself. Each is pulled
/// tight within its class, and verified at the asked radius as in plan(); the first is no longer
/// than plan()'s path. No two stay within the radius of each other all along. None comes back,
/// pulled tight, to within the radius of where it was.
///
/// Where obstacles reach from floor to ceiling these are the homotopy classes; in 3D the ways left,
/// right and above of a floating box are three routes too. The routes are those of the sparse graph
/// that pass no vertex twice: none winds around an obstacle, and none takes a way that the graph is
/// too coarse for at this radius (`answered_by` is not graph: then plan()'s path is the only one).
/// They are looked at by their length along the graph, up to a few thousand pieces of them:
/// `complete` says whether that, or the time limit, left some out.
///
/// The planner must be the graph's; paths are always pulled tight, prefer no clearance and have no
/// escapes. Thread-safe on one roadmap. Throws InputError for another configuration, as plan()
/// does, and where `count` is 0.
Alternatives plan_alternatives(const Roadmap& roadmap, const Point& start, const Point& goal,
                               std::size_t count, const PlanConfig& config = {});

}  // namespace ridgeway
