// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

struct GvdConfig {
  double theta = 0.785;  ///< radians in (0, pi); least angle between the directions to two sites

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Free voxels at least `radius` metres from every obstacle (inclusive).
VoxelMask traversable_voxels(const EsdfMap& esdf, double radius);

/// Voxels on the generalized Voronoi diagram (paper: GVD Generation): those with a free
/// 6-neighbour whose nearest site lies in a direction more than theta away from the voxel's own,
/// both seen from the voxel. A voxel without a site counts as on the ridge.
/// Throws InputError naming the bad field.
VoxelMask compute_gvd(const EsdfMap& esdf, const VoxelMask& traversable,
                      const GvdConfig& config = {});

/// GVD voxels with at least 18 of their 26 neighbours on the GVD: its thick edges (paper: Edge
/// Extraction).
VoxelMask extract_edges(const EsdfMap& esdf, const VoxelMask& gvd);

/// The definition for perfect worlds, for comparison: GVD voxels with at least three basis points
/// (paper: Edge Extraction). Basis points are the sites of the voxel and of its free 6-neighbours
/// that lie pairwise more than theta apart, seen from the voxel. Throws InputError naming the bad
/// field.
VoxelMask extract_basis_point_edges(const EsdfMap& esdf, const VoxelMask& gvd,
                                    const GvdConfig& config = {});

}  // namespace ridgeway
