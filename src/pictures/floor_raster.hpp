// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway {

/// From where a map is looked at: the axes (0 x, 1 y, 2 z) that lie across the page, up the page
/// and along the line of sight.
struct Projection {
  int across = 0, up = 1, along = 2;
};
inline constexpr Projection kFromAbove{0, 1, 2}, kFromFront{0, 2, 1}, kFromSide{1, 2, 0};

/// A map seen from above, or from a side: cells of `side` x `side` columns along the line of sight,
/// and how much in each is free and occupied within a band along it.
struct FloorRaster {
  struct Cell {
    std::uint32_t free = 0;
    std::uint32_t occupied = 0;
  };
  Projection projection;
  HeightBand band;          ///< metres, world
  VoxelIndex first;         ///< of the lattice: the corner with the smallest coordinates
  int side = 1;             ///< voxels
  int nx = 0, ny = 0;       ///< cells
  std::vector<Cell> cells;  ///< x fastest

  /// In the world.
  Point min_corner(double voxel_size) const {
    return Point(first.x, first.y, first.z) * voxel_size;
  }
  double width(double voxel_size) const { return nx * side * voxel_size; }
  double height(double voxel_size) const { return ny * side * voxel_size; }
};

/// Counts all known voxels into at most `most_cells` cells along each side. `band`: not given, from
/// above the middle three fifths of the free voxels' heights, from a side all there is. Throws
/// InputError for a map without known voxels.
FloorRaster make_floor_raster(const EsdfMap& esdf, const Projection& projection,
                              const std::optional<HeightBand>& band, int most_cells);

/// A storey of a building.
struct Storey {
  HeightBand heights;  ///< metres, world
  HeightBand band;     ///< of the middle three fifths of its free voxels
};

/// Storeys from below: where there is much free space below a height and above it, but hardly any
/// at it, is a slab between two. None is lower than a height (metres); at least one where anything
/// is free, and together they are all heights of the map.
std::vector<Storey> find_storeys(const EsdfMap& esdf, double least_height);

}  // namespace ridgeway
