// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway {

/// A map seen from above: cells of `side` x `side` columns, and how much in each is free and
/// occupied within a band of heights.
struct FloorRaster {
  struct Cell {
    std::uint32_t free = 0;
    std::uint32_t occupied = 0;
  };
  HeightBand band;          ///< metres, world
  VoxelIndex first;         ///< column of the lattice of the corner with the smallest x and y
  int side = 1;             ///< voxels
  int nx = 0, ny = 0;       ///< cells
  std::vector<Cell> cells;  ///< x fastest

  /// In the world.
  Point min_corner(double voxel_size) const { return Point(first.x, first.y, 0.0) * voxel_size; }
  double width(double voxel_size) const { return nx * side * voxel_size; }
  double height(double voxel_size) const { return ny * side * voxel_size; }
};

/// Counts all known voxels into at most `most_cells` cells along each side. Throws InputError for
/// a map without known voxels.
FloorRaster make_floor_raster(const EsdfMap& esdf, const std::optional<HeightBand>& band,
                              int most_cells);

}  // namespace ridgeway
