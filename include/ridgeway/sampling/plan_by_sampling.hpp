// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <limits>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

/// How OMPL's planners are run. RRT-Connect stops at its first path; the others go on improving
/// theirs until a limit, unless it is the straight line already.
struct SamplingConfig {
  Planner planner = Planner::kRrtConnect;  ///< one that samples
  double radius = 0.0;                     ///< of the robot, metres; to be given
  std::uint64_t seed = 1;                  ///< of the planner's random numbers
  /// Seconds of sampling; shortening may take as many again. Infinite: only the other limit counts.
  double time_limit = 10.0;
  /// Rounds of the planner's main loop. Runs that this limit ends, or that end by themselves,
  /// repeat exactly: same map, query and configuration, same path. Those that time ends do not.
  std::size_t iteration_limit = std::numeric_limits<std::size_t>::max();
  bool first_solution = false;  ///< stop at the first path
  /// As plan() does: look along the straight line first, and pull the path tight, which the time
  /// limit does not count. Otherwise as the planner found it.
  bool shorten = true;
  /// Longest motion that a tree grows by, metres; 0: 1 m, or 10 voxels where that is more. In wide
  /// corridors three times that is quicker, through doors far slower; less than a tenth of a voxel
  /// is refused. BIT* and PRM* have none.
  double range = 0.0;
  FlightLimits limits = {};   ///< as in PlanConfig
  double robot_height = 0.0;  ///< as in PlanConfig

  /// Throws InputError naming the bad field (a planner that does not sample, no radius, no limit).
  void validate() const;
};

/// The best path that was found; `plan.seconds.attach` is the time to set the planner up.
struct SamplingResult {
  PlanResult plan;             ///< as plan() has it
  std::size_t iterations = 0;  ///< rounds of the main loop
  double first_seconds = 0.0;  ///< until the first path, from the beginning of the search
  double first_length = 0.0;   ///< of the first path as it was found, metres
};

/// Plans for a sphere from start to goal (metres, world frame) with a planner of OMPL. Places and
/// motions are decided by the free-space predicate (esdf/free_space.hpp) alone, exactly along
/// every segment, never by steps along it; samples come from the box around the known free voxels.
/// Start and goal are judged as by plan(). Sampling cannot show that there is no route: a limit
/// that passes without a path is kTimeout.
///
/// Thread-safe. OMPL seeds its generators from one of the process: where a caller uses OMPL beside
/// this function, its own generators made later depend on the seeds given here. OMPL's messages are
/// off meanwhile.
/// Throws InputError as plan() does, and Cancelled; `progress` is asked while it samples, some
/// twenty times a second.
SamplingResult plan_by_sampling(const EsdfMap& esdf, const Point& start, const Point& goal,
                                const SamplingConfig& config, const Progress& progress = {});

}  // namespace ridgeway
