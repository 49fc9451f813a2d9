// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"
#include "ridgeway/roadmap/tangent_graph.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// The one-voxel-wide curves along the ridges of the distance field that the graph is fitted to.
struct SkeletonDiagram {
  VoxelMask voxels;      ///< on the ESDF's layout
  bool complete = true;  ///< connected as space is; false for the paper's edges alone
};

/// Way of every traversable voxel to the graph, widest first: the direction of its next voxel, a
/// byte each. Following it never passes a place narrower than any other way would have to.
struct AttachField {
  static constexpr Direction kHere = kCentre;  ///< a vertex stands here, or the way ends here
  static constexpr Direction kNotTraversable = 27;
  VoxelField<Direction> next;  ///< on the ESDF's layout
};

/// At which clearance do two vertices part? A forest over the vertices: `parent` (itself at a
/// root), and the clearance and place of the narrowest point of the widest way to the parent.
/// Climbing it takes a number of steps logarithmic in the number of vertices.
struct ClearanceTree {
  std::vector<VertexId> parent;
  std::vector<double> clearance;  ///< metres; 0 at a root
  std::vector<VoxelIndex> place;  ///< where the way to the parent is narrowest
};

/// Everything a query needs, in the local frame of `esdf`; to_world(esdf, point) and to_local lead
/// from it to the world and back; what is saved to and loaded from a `.ridge` file.
/// Immutable during queries: any number of threads may plan on one Roadmap.
struct Roadmap {
  EsdfMap esdf;
  double min_clearance = 0.0;  ///< metres; smallest robot radius that may be asked for
  SkeletonDiagram diagram;
  SparseGraph graph;
  AttachField attach;
  ClearanceTree tree;
  Landmarks landmarks;     ///< of the graph; not in the file, placed when it is loaded
  TangentGraph tangents;   ///< ways close around corners; may be empty
  bool is_settled = true;  ///< false: a LiveRoadmap's, its tangents not learnt yet
  std::string source;      ///< the map it was built from, for people
  std::string config;      ///< the configuration it was built with, as JSON text, for people
};

}  // namespace ridgeway
