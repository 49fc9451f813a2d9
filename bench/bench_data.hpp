// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// What the benchmarks share: the map that comes with the project, taken through all stages, and
// queries on it. Ask for it before the loop that is timed: the first to do so builds it.
#pragma once

#include <benchmark/benchmark.h>

#include <utility>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

inline constexpr double kRadius = 0.3;  // metres

/// The results of all stages: each benchmark repeats one of them.
struct Pipeline {
  OccupancyMap map;
  EsdfMap esdf;
  VoxelMask traversable;
  VoxelMask gvd;
  VoxelMask edges;
  Basins basins;
  VoxelMask kernel;
  Roadmap roadmap;
};
const Pipeline& pipeline();

/// Pairs of places that a path connects.
using Query = std::pair<Point, Point>;
const std::vector<Query>& solvable_queries();

/// Centres of random traversable voxels, metres; the same each time.
std::vector<Point> random_places(std::size_t count);

/// Says how many voxels, segments, ... a second, of so many in each iteration.
void report_rate(benchmark::State& state, const char* what, std::size_t in_an_iteration);

}  // namespace ridgeway
