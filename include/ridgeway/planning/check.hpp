// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

/// How values of a sample lie.
struct Spread {
  double median = 0.0;  ///< half of them are below
  double p95 = 0.0;     ///< 95 in a hundred are
  double p99 = 0.0;     ///< 99 in a hundred are
  double max = 0.0;     ///< the largest
};

/// All 0 for no values.
inline Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())))];
  };
  return {at(0.5), at(0.95), at(0.99), values.back()};
}

/// What check_roadmap compares.
struct CheckConfig {
  std::size_t queries = 0;  ///< random ones; 0: edges alone are checked
  std::uint64_t seed = 1;   ///< of start, goal and radius; the same seed asks the same
  /// Of all queries, world frame; start and goal are drawn within them.
  FlightLimits limits = {};
  /// As in PlanConfig; the radius is then the smallest in all queries.
  double robot_height = 0.0;
  /// As in PlanConfig, of the roadmap's answers; what A* finds is made as short as by default.
  bool quick = false;
  double within = 0.0;  ///< as in PlanConfig, of the roadmap's answers; 0: not asked for

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// One query of a check and the path that the roadmap answered with, for independent checkers.
struct CheckedPath {
  double radius = 0.0;           ///< that was asked for, metres
  std::vector<Point> waypoints;  ///< world
};

/// What check_roadmap found; clean where nothing is wrong.
struct CheckReport {
  std::size_t edges = 0;  ///< of the graph, measured anew
  /// Whose clearance is less than the contract says, or is measured as
  std::size_t edges_below_clearance = 0;
  std::size_t components = 0;  ///< of the graph
  std::size_t queries = 0;     ///< that were answered: those asked for, unless cancelled
  std::size_t graph_ok = 0;    ///< queries that the roadmap answered with a path
  std::size_t esdf_ok = 0;     ///< queries that A* through the ESDF answered so
  /// One of them only; within limits the roadmap may find ways that moves between voxels do not
  /// have
  std::size_t disagreements = 0;
  /// Nearer to an obstacle than the radius, or beyond the limits
  std::size_t paths_below_clearance = 0;
  std::size_t fallbacks = 0;  ///< answered beyond the graph
  // Of the queries answered with a path:
  Spread length_ratio;             ///< over the better of it and the ESDF's shortened
  Spread microseconds;             ///< shortened queries over the roadmap
  Spread raw_microseconds;         ///< the same queries not shortened
  Spread esdf_milliseconds;        ///< the same by A* through the ESDF
  std::vector<CheckedPath> paths;  ///< of the roadmap, in the order of the queries

  /// Whether every edge and path keeps its clearance, and all answers agree.
  bool is_clean() const {
    return edges_below_clearance == 0 && disagreements == 0 && paths_below_clearance == 0;
  }
};

/// Verifies the contract of a roadmap: the clearance of every edge, measured anew, and random
/// queries against A* through the ESDF: start and goal anywhere in the traversable voxels, radius
/// 1 to 2 times the smallest, half of them 1, 1.25, 1.5 or 2 times. Queries run on all threads; the
/// times are of one query alone on its thread. Throws InputError for bad limits and a bad `within`,
/// and for a robot that holds no ball of the smallest radius.
CheckReport check_roadmap(const Roadmap& roadmap, const CheckConfig& config = {},
                          const Progress& progress = {});
/// The same; where it is cancelled the report is of what was checked until then.
void check_roadmap(const Roadmap& roadmap, const CheckConfig& config, const Progress& progress,
                   CheckReport& report);

}  // namespace ridgeway
