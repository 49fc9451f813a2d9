// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>

#include "ridgeway/common/progress.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// From occupancy to a queryable roadmap. Lengths in metres, angles in radians.
struct BuildConfig {
  double min_clearance = 0.4;  ///< smallest robot radius the roadmap is for
  UnknownPolicy unknown = UnknownPolicy::kObstacle;
  double max_distance = std::numeric_limits<double>::infinity();  ///< distances stop here
  FlightLimits limits = {};      ///< of every flight on the roadmap, world frame
  double theta = 0.785;          ///< GVD: least angle between the directions to two sites
  double least_apart = 0.0;      ///< GVD: least distance between two sites; see GvdConfig
  double prune_radius = 0.35;    ///< vertices closer than this, or two voxels, become one
  double split_deviation = 0.0;  ///< edge's greatest distance from its diagram; 0: two voxels
  double significance = 0.35;    ///< dead ends of the graph that reach less far go
  bool simplify = true;          ///< leave out of the graph what noise and voxels put into it
  std::size_t tangent_pairs =
      2000;                        ///< of places, at most, to learn the tangent graph from; 0: none
  bool basis_point_edges = false;  ///< edges by basis points, not by the 18-of-26 rule
  bool paper_diagram = false;      ///< thinned edges alone, without the kernel, for comparison

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Seconds that each stage of a build took (docs/how-it-works.md says what a stage is).
struct BuildSeconds {
  double esdf = 0.0, gvd = 0.0, edges = 0.0, thin = 0.0, kernel = 0.0, graph = 0.0, attach = 0.0,
         tangents = 0.0, total = 0.0;
};

/// Counts and times of a build, for reports.
struct BuildReport {
  VoxelCounts voxels;
  std::size_t allocated_voxels = 0;
  std::size_t traversable_voxels = 0;
  std::size_t traversable_components = 0;
  std::size_t gvd_voxels = 0;
  std::size_t edge_voxels = 0;
  std::size_t kernel_voxels = 0;
  std::size_t diagram_voxels = 0;
  std::size_t graph_components = 0;
  BuildSeconds seconds;
};

/// A roadmap, and what building it took.
struct BuildResult {
  Roadmap roadmap;
  BuildReport report;
};

/// The whole pipeline: ESDF, GVD, edges, thinning, kernel, diagram, graph, clearance tree, attach
/// field, tangent graph. Consumes the map. Under UnknownPolicy::kIgnore free pockets smaller than
/// the robot are taken as unknown. Same map and configuration give the same bytes for any number of
/// threads (set by with_threads, common/parallel.hpp). Throws InputError where nothing is free, or
/// memory would not do.
BuildResult build_roadmap(OccupancyMap map, const BuildConfig& config = {},
                          const Progress& progress = {});

}  // namespace ridgeway
