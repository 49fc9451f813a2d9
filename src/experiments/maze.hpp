// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway {

/// How fast is a plan, and how long is the path? (Paper: Planning.) Lengths in metres.
struct MazeExperimentConfig {
  MazeConfig maze = {};
  double voxel_size = 0.1;
  double min_clearance = 0.4;  ///< and radius of the robot
  std::size_t pairs = 100;     ///< random starts and goals
  std::size_t long_pairs = 3;  ///< of them, for RRT* with all of its time
  std::size_t repeat = 3;      ///< rounds of all planners, but for that one
  double time_limit = 10.0;    ///< seconds of a planner that samples
  double range = 3.0;          ///< longest motion of a tree: about a cell, best in a maze
  std::uint64_t seed = 1;      ///< of starts, goals and samples
  bool explored = false;       ///< on the map of a drone that explored the maze, not on the truth

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// One planner's answers.
struct MazeRow {
  std::string planner;  ///< "rrtstar", "rrtstar_10s", "rrtconnect", "esdf", "diagram", "graph_raw",
                        ///< "graph"
  std::size_t queries = 0, solved = 0;  ///< of the random pairs
  Spread seconds;                       ///< of those solved, each the median of its rounds
  Spread length, vertices;
  Spread length_over_esdf;  ///< over the path of A* through the ESDF as it found it
  double single_seconds = 0.0, single_length = 0.0;  ///< from one corner to the opposite one
  std::size_t single_vertices = 0;
  std::vector<Point> single_path;  ///< empty where there is none
};

struct MazeResult {
  Roadmap roadmap;  ///< of the ground truth, or of what was explored
  std::vector<MazeRow> rows;
};

/// Plans with every planner on the same maze, one query after the other on one thread: all pairs
/// with one planner, for at least a tenth of a second, then with the next, in rounds, so that slow
/// phases of the machine fall on all of them. Planners that sample stop at their first path, which
/// is not shortened, but for RRT* with all of its time; "graph" is the roadmap with shortening, all
/// others are as they come.
MazeResult run_maze(const MazeExperimentConfig& config, const Progress& progress = {});
/// The same; where it is cancelled the result is of the rounds that were done, with no rows where
/// there is not one of every planner.
void run_maze(const MazeExperimentConfig& config, const Progress& progress, MazeResult& result);

}  // namespace ridgeway
