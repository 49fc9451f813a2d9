// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/planning/check.hpp"

namespace ridgeway {

/// How near do paths come to optima that others computed? Lengths in metres.
struct GridExperimentConfig {
  double min_clearance = 0.5;      ///< and radius of the robot: half a voxel of 1 m moves as the
                                   ///< MovingAI benchmarks do, through gaps of one voxel too
  std::size_t scenarios = 0;       ///< at most so many of them, evenly spread; 0: all
  std::size_t exact = 200;         ///< the first of those to be solved by A* through the ESDF too
  double optimum_accuracy = 1e-3;  ///< relative: a length so near to the optimum reproduces it

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// A query and the length of its shortest path over the voxels.
struct GridScenario {
  Point start, goal;
  double optimum = 0.0;  ///< metres, above 0
};

/// What one map is put to.
struct GridBenchmark {
  std::string map;  ///< its name
  OccupancyMap voxels;
  std::vector<GridScenario> scenarios;
};

/// One way of asking, over all scenarios of a map.
struct GridAnswers {
  std::size_t solved = 0, fallbacks = 0;  ///< fallbacks: solved, but not by the graph
  Spread length_over_optimum;             ///< of those solved; below 1 off the lattice's directions
  Spread microseconds;                    ///< a query
  std::size_t within_violations = 0;      ///< longer than `within` says of a path by the optimum
  std::vector<double> ratios;             ///< by scenario; NaN where it was not solved
};

/// One map.
struct GridRow {
  std::string map;
  std::vector<std::size_t> scenarios;  ///< those run, by their place in the benchmark, ascending
  std::size_t solvable = 0;            ///< solved, or if not then by A* through the ESDF
  GridAnswers raw, shortened;          ///< the graph's routes as found, and pulled tight
  std::size_t optimum_checked = 0, optimum_reproduced = 0;  ///< by A* through the ESDF
  double build_seconds = 0.0;                               ///< from occupancy to roadmap
  std::size_t vertices = 0, edges = 0;                      ///< of the graph
};

/// Builds the roadmap of a map, unknown space an obstacle, and plans its scenarios with the sparse
/// graph, one after the other on one thread; A* through the ESDF runs on all threads, untimed.
/// Consumes the benchmark. Throws InputError for a benchmark without scenarios, an optimum that is
/// not above 0, a map without free space.
GridRow run_grid(GridBenchmark benchmark, const GridExperimentConfig& config = {},
                 const Progress& progress = {});

}  // namespace ridgeway
