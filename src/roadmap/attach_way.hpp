// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// The way of a voxel towards the graph, as far as it is free at a radius.
struct AttachWay {
  std::vector<VoxelId> voxels;  ///< from the voxel on; the last is where the way stops
  VertexId vertex = kNoVertex;  ///< the vertex it reaches, if it does
  bool met_diagram = false;     ///< whether one of the voxels is on the diagram
  double clearance = std::numeric_limits<double>::infinity();  ///< of its moves, metres
  bool reached() const { return vertex != kNoVertex; }
};
AttachWay follow_attach(const Roadmap& roadmap, VoxelId from, double radius);
/// Of two voxels, in less time than one after the other.
std::array<AttachWay, 2> follow_attach(const Roadmap& roadmap, const std::array<VoxelId, 2>& from,
                                       double radius);

/// The vertex that stands on a voxel, or kNoVertex.
VertexId vertex_at(const SparseGraph& graph, const VoxelIndex& voxel);

}  // namespace ridgeway::detail
