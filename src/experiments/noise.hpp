// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "sensing/poses.hpp"

namespace ridgeway {

/// Does the graph depend on the topology of a world, and not on voxel size or noise? (Paper: Sparse
/// Graph Construction.) Lengths in metres.
struct NoiseConfig {
  std::vector<double> voxel_sizes = {0.10, 0.15, 0.25};  ///< the first is the routes' reference
  std::vector<double> sigmas = {0.0, 0.1, 0.2};          ///< noise of every range
  PoseSampling poses = {};     ///< of the camera; level, anywhere in a volume
  double truncation = 0.4;     ///< of the TSDF
  int isolated_below = 5;      ///< clusters of fewer occupied voxels become free
  double min_clearance = 0.4;  ///< and radius of the routes
  std::size_t pairs = 1000;    ///< starts and goals, common to all maps
  std::size_t queries = 200;   ///< of the check of each map
  std::uint64_t seed = 1;      ///< of noise, starts and goals

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// One map: what it was made of, what it became, and how well it serves.
struct NoiseMap {
  double voxel_size = 0.0;
  std::optional<double> sigma;     ///< of the scans; none: the world itself
  double scan_milliseconds = 0.0;  ///< median, of fusing one scan
  BuildResult built;
  CheckReport check;
  std::size_t cycles = 0;  ///< independent ones of the graph
  std::size_t solved = 0;  ///< of the pairs
  Spread length_ratio;     ///< of the routes, over the best of the reference map
};

struct NoiseResult {
  std::vector<NoiseMap> maps;  ///< by voxel size, the world itself first, then by sigma
  std::size_t pairs = 0;       ///< fewer than asked for only where the maps share no more places
  double size_ratio = 0.0;     ///< largest over smallest number of vertices and edges
};

/// Maps a world at each voxel size from its exact distance and from noisy scans, builds a roadmap
/// of each (unknown ignored), checks it, and plans between random places that keep min_clearance
/// and a voxel from every surface and lie in the largest component of every map. The best of the
/// reference map is the shorter of its roadmap's and of its ESDF A*'s shortened route.
NoiseResult run_noise(const World& world, const NoiseConfig& config, const Progress& progress = {});
/// The same; where it is cancelled the result is of the maps that were made, and of the routes that
/// were compared.
void run_noise(const World& world, const NoiseConfig& config, const Progress& progress,
               NoiseResult& result);

}  // namespace ridgeway
