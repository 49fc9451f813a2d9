// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

struct LoadNotes;

/// Points of a file, in its own frame, metres.
struct PointCloud {
  std::vector<Point> points;  ///< all finite
  std::size_t skipped = 0;    ///< points left out because a coordinate is NaN or infinite
  std::size_t faces = 0;      ///< of the file: the points are the vertices of a mesh

  /// Takes a point, or counts it as skipped where a coordinate is not finite.
  void add(double x, double y, double z) {
    if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z))
      points.emplace_back(x, y, z);
    else
      ++skipped;
  }
};

/// How a cloud becomes a map.
struct CloudMapConfig {
  double voxel_size = 0.0;  ///< metres, required
  Box bounds;               ///< where the space is known, map frame, required
  int margin =
      0;  ///< obstacles are also kept this many voxels beyond the bounds, for filters; 0 or more
  /// From the cloud's frame to the map's, metres
  Eigen::Isometry3d T_map_cloud = Eigen::Isometry3d::Identity();
};

/// Voxels that hold a point within the bounds, or on them, are occupied; of the others, those
/// wholly inside the bounds are free: a cloud does not say where it saw nothing. Throws InputError
/// naming `name` where no point lies within the bounds, they hold no voxel, or a point lies beyond
/// 1e9 voxels. `notes`: of points that are left out, as they lie outside of the bounds or were
/// skipped.
OccupancyMap map_from_points(const PointCloud& cloud, const CloudMapConfig& config,
                             const std::string& name, LoadNotes* notes = nullptr);

/// Throws InputError where a cloud is the vertices of a mesh: between them are walls that it does
/// not show. `name` is its file.
void require_no_faces(const PointCloud& cloud, const std::string& name);

/// Box around the points of a cloud, moved into the map frame.
Box extent(const PointCloud& cloud, const Eigen::Isometry3d& T_map_cloud);

/// "x0,y0,z0 to x1,y1,z1", for messages.
std::string describe(const Box& box);

}  // namespace ridgeway
