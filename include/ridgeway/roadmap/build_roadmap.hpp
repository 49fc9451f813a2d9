// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>

#include "ridgeway/common/error.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// From occupancy to a queryable roadmap. Lengths in metres, angles in radians.
struct BuildConfig {
  double min_clearance = 0.4;                        ///< smallest robot radius the roadmap is for
  UnknownPolicy unknown = UnknownPolicy::kObstacle;  ///< what unknown space is to the robot
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
  double esdf = 0.0;      ///< distances, and which voxels are traversable
  double gvd = 0.0;       ///< ridges of the distances
  double edges = 0.0;     ///< where ridges meet
  double thin = 0.0;      ///< those to a width of one voxel
  double kernel = 0.0;    ///< basins, kernel and diagram; beside them the cell graph
  double graph = 0.0;     ///< sparse graph, clearance tree, landmarks
  double attach = 0.0;    ///< the way of every voxel to the graph
  double tangents = 0.0;  ///< tangent graph
  double total = 0.0;     ///< the sum of these

  /// Of all stages but `total`, seconds.
  double sum() const { return esdf + gvd + edges + thin + kernel + graph + attach + tangents; }
};

/// Counts and times of a build, for reports.
struct BuildReport {
  VoxelCounts voxels;                      ///< of the map as it was handed in
  std::size_t allocated_voxels = 0;        ///< of the field's blocks
  std::size_t traversable_voxels = 0;      ///< free at the minimum clearance, within the limits
  std::size_t traversable_components = 0;  ///< parts of them that no legal move joins
  std::size_t gvd_voxels = 0;              ///< on ridges of the distances
  std::size_t edge_voxels = 0;             ///< where ridges meet, before they were thinned
  std::size_t kernel_voxels = 0;           ///< that carry the topology, shells and sheets included
  std::size_t diagram_voxels = 0;          ///< of the diagram that the graph is fitted to
  std::size_t graph_components = 0;        ///< connected parts of the graph
  BuildSeconds seconds;                    ///< what each stage took
};

/// A roadmap, and what building it took.
struct BuildResult {
  Roadmap roadmap;     ///< what queries need
  BuildReport report;  ///< counts and times
};

/// The whole pipeline: ESDF, GVD, edges, thinning, kernel, diagram, graph, clearance tree, attach
/// field, cell graph, tangent graph. Consumes the map. Under UnknownPolicy::kIgnore free pockets
/// smaller than the robot are taken as unknown. Same map and configuration give the same bytes for
/// any number of threads (set by with_threads, common/parallel.hpp). `progress` can cancel it
/// anywhere, within the stages too (with_progress). Throws InputError naming the bad field, and
/// where nothing is free or traversable, or memory would not do.
BuildResult build_roadmap(OccupancyMap map, const BuildConfig& config = {},
                          const Progress& progress = {});

}  // namespace ridgeway
