// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// Lengths in metres.
struct GraphConfig {
  double min_clearance = 0.4;
  double prune_radius = 0.35;    ///< vertices nearer than this along the diagram become one
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
/// field.
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

}  // namespace ridgeway
