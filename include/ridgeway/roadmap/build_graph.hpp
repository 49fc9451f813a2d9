// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// Lengths in metres.
struct GraphConfig {
  double min_clearance = 0.4;    ///< of every edge
  double prune_radius = 0.35;    ///< vertices nearer than this along the diagram become one;
                                 ///< at least two voxels
  double split_deviation = 0.0;  ///< edge's greatest distance from its curve; 0: two voxels
  double widest_kept = 0.0;      ///< up to this clearance edges are as wide as their curves, so
                                 ///< that the graph connects what the diagram does at larger
                                 ///< radii too; 0: three times min_clearance

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Fits the sparse graph to a diagram (paper: Sparse Graph Generation): vertices, pruning,
/// following, splitting, and the contract that every edge is free along all of it. It follows all
/// of the diagram; simplify_graph leaves out what does not matter. Throws InputError naming the bad
/// field; a clearance above largest_radius(esdf) is one.
SparseGraph build_graph(const EsdfMap& esdf, const VoxelMask& diagram,
                        const GraphConfig& config = {});

/// The way of every traversable voxel to a vertex: by `basins.next` to the diagram, then along it.
AttachField build_attach_field(const EsdfMap& esdf, const VoxelMask& diagram,
                               const SparseGraph& graph, Basins basins);

/// At which clearance any two vertices part: exact over all of traversable space, from the basins
/// and their passes.
ClearanceTree build_clearance_tree(const EsdfMap& esdf, const SparseGraph& graph,
                                   const Basins& basins);

/// Largest clearance at which two vertices are connected, metres; 0 where they are not at all.
double widest_way(const SparseGraph& graph, const ClearanceTree& tree, VertexId a, VertexId b);

/// Lengths in metres.
struct SimplifyConfig {
  double significance = 0.35;  ///< dead ends whose ball reaches less far beyond others go
  double steepness = 0.6;      ///< dead ends that reach less far than this share of their length go
  double widest_kept = 0.0;    ///< up to this clearance ways stay as wide as they were; 0: twice
                               ///< the graph's min_clearance; what is less counts as that
  double width_step = 0.25;    ///< widths count in steps of this share of min_clearance: a way as
                               ///< wide as 1.45 times min_clearance may become 1.25 times as wide
  double stretch = 1.5;        ///< by which factor ways may become longer

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Leaves out of a graph what noise and voxels put into it, and nothing that matters: whatever is
/// left out is swept over free space onto what stays, so no two ways that pass an obstacle on
/// different sides become one. Until nothing changes:
/// - a dead end goes if the ball at its end hardly reaches beyond the balls around (erosion
///   thickness): noise makes short ones, and the curves into the corners of a room gain only 0.29
///   or 0.42 of their length;
/// - a vertex goes into a wider neighbour whose ball it lies in or, where the way does not fork,
///   into any neighbour;
/// - an edge goes if it can be swept onto another way between its ends, as wide and at most
///   `stretch` times as long (a spanner that keeps homotopy).
/// What the graph connects at a radius, a whole number of steps up to `widest_kept`, it connects
/// after, too; for radii between them ways that have become narrower may be missing.
/// The contract of SparseGraph holds for the result. Components stay. Deterministic. Throws
/// InputError naming the bad field; a clearance of the graph above largest_radius(esdf) is one.
SparseGraph simplify_graph(const EsdfMap& esdf, const SparseGraph& graph,
                           const SimplifyConfig& config = {});

}  // namespace ridgeway
