// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/common/triangle.hpp"
#include "ridgeway/mapping/tsdf_map.hpp"

namespace ridgeway {

/// A surface as triangles, their fronts towards free space. `normals` is as long as `vertices`, and
/// `triangles` hold places in it.
struct SurfaceMesh {
  std::vector<Point> vertices;           ///< metres, world frame
  std::vector<Eigen::Vector3d> normals;  ///< of length one, towards free space
  std::vector<Triangle> triangles;
};

/// The zero level of a truncated distance field, where a voxel at distance 0 counts as behind the
/// surface. It runs between voxel centres and only where all eight around a place are known: it has
/// borders where the unknown begins and nowhere else. Every edge is that of one triangle at a
/// border, else of two. The same for any number of threads. Throws InputError for a surface of more
/// than 2^31 - 1 vertices.
SurfaceMesh surface_of(const TsdfMap& tsdf);

}  // namespace ridgeway
