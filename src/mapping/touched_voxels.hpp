// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ridgeway/sensing/solid_mesh.hpp"
#include "ridgeway/voxel/index.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// A set of voxels by block, bits as in VoxelMask, blocks in (z, y, x) order.
struct BlockMasks {
  std::vector<BlockIndex> blocks;
  std::vector<VoxelMask::Block> voxels;
};

/// Triangles in voxels: voxel (0, 0, 0) is the cube from (0, 0, 0) to (1, 1, 1).
struct VoxelTriangles {
  std::vector<Point> vertices;  ///< finite, within 4e9
  std::vector<Triangle> triangles;
  double slack = 0.0;  ///< by which vertices may be off, voxels; what is so near counts as touching
};

/// Triangles whose vertices, in voxels from zero, may be `off` by so many and by rounding, from
/// voxel `origin`. Vertices that no triangle uses may be anything. Throws InputError, naming
/// `name`, where one that is used is not within 4e9 voxels of zero.
VoxelTriangles from_voxel(const VoxelIndex& origin, std::vector<Point> vertices,
                          std::vector<Triangle> triangles, double off, const std::string& name);

/// The voxels from (0, 0, 0) up to `size` whose closed cube shares a point with a triangle, found
/// by the separating axis theorem (Akenine-Moeller 2001); rounding counts as touching. Triangles
/// without area are segments or points. The voxels of a closed surface thus leave no way from one
/// side to the other, not across edges and corners of voxels either. The same for any number of
/// threads. Throws InputError, naming `name`, where memory would not do.
BlockMasks touched_voxels(const VoxelTriangles& mesh, const VoxelIndex& size,
                          const std::string& name);

}  // namespace ridgeway
