// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// A query of the MovingAI 3D benchmarks and the length of its shortest path over the cells.
struct BenchmarkScenario {
  VoxelIndex start, goal;
  double optimal_length = 0.0;  ///< cells; 26-moves that cut no corner
};

struct BenchmarkScenarios {
  std::string map;  ///< the map's name, as it stands in the file
  std::vector<BenchmarkScenario> scenarios;
};

/// Reads a .3dscen file: "version 1", the map's name, then a scenario a line: start x y z, goal
/// x y z, optimal length, and its ratio to a lower bound, which is not kept. The moves of its paths
/// are those that A* through the ESDF takes at a radius of half a cell on the map with unknown
/// space an obstacle. Throws InputError naming file and line.
BenchmarkScenarios read_benchmark_scenarios(std::string_view bytes, const std::string& name);

}  // namespace ridgeway
