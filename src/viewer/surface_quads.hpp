// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {

/// A rectangle of faces between solid and open cells, all in one plane.
struct SurfaceQuad {
  std::uint16_t x = 0, y = 0,
                z = 0;     ///< of its lowest cell, which is solid, from SurfaceQuads::low
  std::uint16_t side = 0;  ///< of the cell: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z
  /// Cells along the two axes of the plane, the earlier of x, y, z first; 1 to kMostCells.
  std::uint8_t width = 0, height = 0;
  friend bool operator==(const SurfaceQuad&, const SurfaceQuad&) = default;
};

/// What can be seen of obstacles from where space is known to be free.
struct SurfaceQuads {
  /// Quads do not reach farther, so that they are made in cubes of so many cells, in parallel.
  static constexpr int kMostCells = 32;

  int cell_voxels = 1;  ///< side of a cell, voxels
  VoxelIndex low;       ///< lowest voxel of cell (0, 0, 0), one of the map's own
  std::vector<SurfaceQuad> quads;
};

/// The faces between occupied and known-free voxels, merged: each face is in one quad, no other
/// face is in any. Cells of `cell_voxels` (a power of two) voxels a side are occupied where a voxel
/// in them is, else free where one is: coarser surfaces enclose the finer ones. The same quads for
/// any number of threads. Throws InputError where a cell has a coordinate above 65535.
SurfaceQuads merge_surface(const EsdfMap& esdf, int cell_voxels = 1);

/// With the smallest cells that need `most` quads or fewer.
SurfaceQuads merge_surface_within(const EsdfMap& esdf, std::size_t most);

}  // namespace ridgeway
