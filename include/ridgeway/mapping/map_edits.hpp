// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

// Edits of maps. In a planar map (flatten) heights of boxes play no part, and a column counts as
// one voxel; resample, flatten and transform_map, which would take its layers apart, throw
// InputError.

/// The same space at a coarser voxel size, without ever losing an obstacle: a coarse voxel is
/// occupied where it shares volume with an occupied voxel, else unknown where it shares volume
/// with an unknown one, else free. The ratio of the sizes need not be whole; one within 1e-6 of a
/// whole number n is taken as n, and the result's voxel size is then exactly n times the map's.
/// Throws InputError where `voxel_size` is finer than the map's own.
OccupancyMap resample(OccupancyMap map, double voxel_size);

/// What lies inside bounds (the flight volume): voxels that are not wholly inside, with a slack of
/// 1e-6 voxels, become unknown, but for occupied ones that share volume with it, or with what is up
/// to `beyond` metres above its upper faces: where unknown space is no obstacle, these still are.
/// Infinite coordinates mean no limit.
/// The map is normalised. Throws InputError for a box that validate_box refuses.
OccupancyMap crop(OccupancyMap map, const Box& bounds, double beyond = 0.0);

/// Makes every voxel that shares volume with one of the boxes occupied, unknown ones too. Boxes
/// reach no farther than one block (8 voxels) beyond the known bounds. A box without extent along
/// an axis closes the voxel layer that holds it. The map is normalised if there are boxes. Throws
/// InputError for a box that validate_box refuses, or where memory would not do.
OccupancyMap add_no_fly(OccupancyMap map, std::span<const Box> boxes);

/// Filter for noisy maps, in which a speck closes a doorway: every 26-connected cluster of fewer
/// than `min_cluster` occupied voxels becomes free. 0 and 1 change nothing. It removes small real
/// obstacles (a wire, a lamp) just as well, so nothing uses it unless asked to. Throws InputError
/// below 0.
OccupancyMap remove_isolated(OccupancyMap map, int min_cluster);

/// Every 26-connected cluster of free voxels of less than `min_volume` cubic metres becomes
/// unknown: what a stray measurement opens behind a wall holds no robot. Throws InputError below 0.
OccupancyMap remove_pockets(OccupancyMap map, double min_volume);

/// The map of a robot that stays in a plane, one layer of voxels: a column is occupied where it
/// shares volume with something occupied between the heights `low` and `high` (metres, world),
/// else unknown where with something unknown, else free. The layer is that of the middle of the
/// two. Throws InputError where the heights are no numbers, not low < high, or nothing is known
/// between them.
OccupancyMap flatten(const OccupancyMap& map, double low, double high);

/// A motion that takes voxels to voxels: axes swapped and turned round, then whole voxels added.
struct LatticeTransform {
  std::array<int, 3> source_axis = {0, 1, 2};  ///< target axis a is source axis source_axis[a] ...
  std::array<bool, 3> flipped = {};            ///< ... reversed, where set, ...
  std::array<int, 3> shift = {};               ///< ... and moved by this many voxels

  VoxelRange operator()(const VoxelRange& source) const;  ///< Where it takes the voxels of a range.
  bool operator==(const LatticeTransform&) const = default;  ///< Equal in every field.
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
/// pay that. Throws InputError for a finer voxel size (metres), for a transform that
/// validate_transform refuses, and for one by more than 1e9 voxels.
OccupancyMap transform_map(const OccupancyMap& map, const Eigen::Isometry3d& T_target_source,
                           double voxel_size);

}  // namespace ridgeway
