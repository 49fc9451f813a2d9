// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <functional>
#include <string>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// States of a full box of voxels that somebody else holds, in whatever form.
struct StateGrid {
  VoxelIndex low = {};            ///< of the lattice: the box's first voxel
  std::array<int, 3> shape = {};  ///< voxels along x, y and z
  /// Writes the states of the voxels first .. first + count - 1, counted from `low` and at most
  /// eight along an axis, to place x + 8 y + 64 z, x, y and z counted from `first`; other places
  /// stay as they are. Called from several threads, several times for one voxel.
  std::function<void(const VoxelIndex& first, const VoxelIndex& count, VoxelState* states)> read;
};

/// The same voxels as a map, normalised, without a copy of them in between. `name` is what errors
/// call the grid. Throws InputError where it lies beyond kAllVoxels, or memory would not do.
OccupancyMap map_from_grid(const StateGrid& grid, double voxel_size, const std::string& name);

}  // namespace ridgeway
