// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// What makes a voxel part of a ridge.
struct GvdConfig {
  double theta = 0.785;  ///< radians in (0, pi); least angle between the directions to two sites
  /// Metres; least distance between two sites. A robot does not pass between two that are nearer to
  /// each other than it is wide: a ridge between them decides nothing.
  double least_apart = 0.0;

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Voxels that are free (unknown ones too, where those are taken for free) and at least `radius`
/// metres from every obstacle (inclusive). `within_limits`: only
/// those within the map's flight limits. Throws InputError where the radius is below 0, not finite
/// or above the map's max_distance.
VoxelMask traversable_voxels(const EsdfMap& esdf, double radius, bool within_limits = true);

/// Voxels on the generalized Voronoi diagram (paper: GVD Generation): those with a free
/// 6-neighbour whose nearest site lies in a direction more than theta away from the voxel's own,
/// both seen from the voxel, and `least_apart` or more from it. A voxel without a site counts as on
/// the ridge. Throws InputError naming the bad field.
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

/// Whether a neighbourhood matches one of the deletion templates of She et al. 2009 (paper:
/// Thinning) in any orientation: A face, B edge, C corner, D in-plane diagonal.
bool matches_deletion_template(Cube27 cube);

/// Thins a set to curves and keeps its topology: b0, b1 and b2 stay. Voxels that match a template,
/// are simple and end no curve go, layer by layer; at last any simple voxel that ends no curve, so
/// that the result is one voxel wide. Eight parity sub-fields, in which no two voxels are
/// adjacent, make it parallel with the same result for any number of threads.
void thin(const BlockLayout& layout, VoxelMask& voxels);

}  // namespace ridgeway
