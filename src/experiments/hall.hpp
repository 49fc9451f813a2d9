// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway {

/// How long does a map take, and does the time grow with the map alone? (Paper: Platform
/// Experiments.) Lengths in metres.
struct HallExperimentConfig {
  HallConfig hall = {};
  std::vector<double> voxel_sizes = {0.28, 0.14, 0.07, 0.05};  ///< of the hall
  double min_clearance = 0.3;  ///< at least two voxels: narrower, openings depend on the lattice
  std::vector<int> threads = {1, 2};  ///< the first is what the others are compared with
  int repeat = 5;                     ///< builds of which the medians are taken
  std::size_t queries = 1000;         ///< of a batch that runs in parallel
  std::size_t copy_bytes = std::size_t{1} << 28;  ///< of the plain copy; well beyond the caches
  std::uint64_t seed = 1;                         ///< of the queries' starts and goals

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// A map to be built beside the hall; made anew for every build, which consumes it.
struct HallMap {
  std::string name;
  std::function<OccupancyMap()> make;
};

/// Where a roadmap lies between building and planning; both or neither may be null.
struct RoadmapStore {
  std::function<void(const Roadmap&)> save;
  std::function<Roadmap()> load;
};

/// A number for each stage of a build. `esdf_to_graph`: from the finished distance field to the
/// sparse graph, the kernel included; `total`: from occupancy to a roadmap that can be queried.
struct StageNumbers {
  double esdf = 0.0, gvd = 0.0, edges = 0.0, thin = 0.0, kernel = 0.0, graph = 0.0, attach = 0.0,
         tangents = 0.0, esdf_to_graph = 0.0, total = 0.0;
};
struct StageName {
  const char* name;
  double StageNumbers::*number;
};
inline constexpr std::array<StageName, 10> kStageNames = {
    {{"esdf", &StageNumbers::esdf},
     {"gvd", &StageNumbers::gvd},
     {"edges", &StageNumbers::edges},
     {"thin", &StageNumbers::thin},
     {"kernel", &StageNumbers::kernel},
     {"graph", &StageNumbers::graph},
     {"attach", &StageNumbers::attach},
     {"tangents", &StageNumbers::tangents},
     {"esdf_to_graph", &StageNumbers::esdf_to_graph},
     {"total", &StageNumbers::total}}};

/// One map, voxel size and number of threads. Times are medians, in seconds.
struct HallRow {
  std::string map;  ///< "hall", or a map's name
  double voxel_size = 0.0, min_clearance = 0.0;
  int threads = 0;
  BuildReport counts;  ///< its seconds are those of one run
  std::size_t vertices = 0, edges = 0;
  StageNumbers seconds;  ///< `total` is the wall clock's, a little above the sum of the stages
  StageNumbers voxels;   ///< that a stage walks over: allocated, traversable, on the ridges, ...
  StageNumbers bytes;    ///< that it has to read and write at least, see least_traffic
  double copy_bandwidth = 0.0;  ///< bytes read and written a second by a plain copy, same threads
  /// Resident memory at its peak, bytes, of a process that makes the map and builds it. Nothing
  /// where the system gives no process.
  std::optional<std::uint64_t> peak_memory;
  double load_seconds = 0.0, first_query_seconds = 0.0;  ///< 0 without a store
  double first_answer_seconds = 0.0;                     ///< from the file to the first path
  std::size_t solved = 0;                                ///< of the batch's queries
  double batch_seconds = 0.0;                            ///< of all queries

  /// Share of the plain copy's bandwidth that a stage reaches, its least traffic over its time.
  double bandwidth_fraction(double StageNumbers::*stage) const;
};

/// Builds the hall at every voxel size, and the other maps, with every number of threads, which
/// take turns so that all see the same machine. Every run gets its map anew, and memory that the
/// system has to provide anew, as a program that builds one map does. Starts processes to measure
/// their memory: call it before other parallel work, whose threads they would miss.
std::vector<HallRow> run_hall(const HallExperimentConfig& config,
                              const std::vector<HallMap>& other_maps = {},
                              const RoadmapStore& store = {}, const Progress& progress = {});
/// The same; where it is cancelled the rows are those of the maps that were done.
void run_hall(const HallExperimentConfig& config, const std::vector<HallMap>& other_maps,
              const RoadmapStore& store, const Progress& progress, std::vector<HallRow>& rows);

}  // namespace ridgeway
