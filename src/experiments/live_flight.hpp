// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/common/progress.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// What changes from scan to scan while a world is explored, and what an update costs against a
/// batch build. Lengths in metres.
struct LiveFlightConfig {
  double voxel_size = 0.1;
  double min_clearance = 0.3;
  double max_distance = 4.0;
  double spacing = 0.3;  ///< way between scans
  double sigma = 0.01;   ///< noise of every range
  std::size_t scans = 100;
  std::uint64_t seed = 1;  ///< of places and noise

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// How many voxels of a stage's result there are, and how many came or went with a scan.
struct StageChange {
  std::size_t voxels = 0, changed = 0;
  std::size_t blocks = 0;  ///< that hold changed ones
};

/// One scan.
struct LiveScan {
  UpdateReport update;
  BuildSeconds batch;   ///< of build_roadmap of the same map
  bool is_same = true;  ///< whether that gave the same diagram, graph and distances
  std::size_t known_voxels = 0, map_blocks = 0;
  StageChange traversable, gvd, thick_edges, edges, kernel, diagram;
};

/// A forward camera flies between random places of a world, along paths planned on its exact map,
/// and all it sees goes into a live roadmap.
std::vector<LiveScan> run_live_flight(const World& world, const LiveFlightConfig& config,
                                      const Progress& progress = {});
/// The same; where it is cancelled the results are those that were done.
void run_live_flight(const World& world, const LiveFlightConfig& config, const Progress& progress,
                     std::vector<LiveScan>& results);

}  // namespace ridgeway
