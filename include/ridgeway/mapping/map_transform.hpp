// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/mapping/voxel_range.hpp"

namespace ridgeway {

/// A motion that takes voxels to voxels: axes swapped and turned round, then whole voxels added.
struct LatticeTransform {
  std::array<int, 3> source_axis = {0, 1, 2};  ///< target axis a is source axis source_axis[a] ...
  std::array<bool, 3> flipped = {};            ///< ... reversed, where set, ...
  std::array<int, 3> shift = {};               ///< ... and moved by this many voxels

  VoxelRange operator()(const VoxelRange& source) const;
};

/// Throws InputError naming `transform` unless it is a rotation and a finite translation.
void validate_transform(const Eigen::Isometry3d& transform);

/// The motion on the lattice, where a transform is one: quarter turns and a translation by whole
/// voxels, both within 1e-6 (of the rotation's entries; of a voxel).
std::optional<LatticeTransform> find_lattice_transform(const Eigen::Isometry3d& T_target_source,
                                                       double voxel_size);

/// The map moved by any transform, at a voxel size not finer than its own, without losing an
/// obstacle: a voxel of the result is occupied where its cube shares volume with the moved cube of
/// an occupied voxel, else unknown where with that of an unknown one, else free. Obstacles and the
/// unknown thus grow by up to a voxel's diagonal: exact motions (find_lattice_transform) do not
/// pay that.
OccupancyMap transform_map(const OccupancyMap& map, const Eigen::Isometry3d& T_target_source,
                           double voxel_size);

}  // namespace ridgeway
