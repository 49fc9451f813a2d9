// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {

/// Everything behind a plane is solid: normal . x < offset. The normal has length one and points
/// into the open.
struct SolidPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0.0;  ///< metres
};

/// A box along the axes.
struct SolidBox {
  Point centre = Point::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< metres, all above 0
};

struct SolidSphere {
  Point centre = Point::Zero();
  double radius = 1.0;
};

/// An upright cylinder.
struct SolidCylinder {
  Point centre = Point::Zero();
  double radius = 1.0;
  double height = 1.0;
};

/// A mesh at a place of its own; many may share its triangles.
struct PlacedMesh {
  std::shared_ptr<const SolidMesh> mesh;
  double scale = 1.0;  ///< metres of the world a unit of the mesh, above 0
  Eigen::Isometry3d T_world_mesh = Eigen::Isometry3d::Identity();  ///< after scaling
  std::string file = {};  ///< where it was read; may be empty
};

/// A simulated world: the union of solids, metres, z up. Plain data; thread-safe to read.
struct World {
  std::string name;
  std::vector<SolidPlane> planes;
  std::vector<SolidBox> boxes;
  std::vector<SolidSphere> spheres;
  std::vector<SolidCylinder> cylinders;
  std::vector<PlacedMesh> meshes;
};

/// Throws InputError naming the first solid without a size (a mesh without triangles), with a
/// number that is not finite, or a normal that is not of length one.
void validate_world(const World& world);

/// Signed distance to the nearest surface and its gradient. Exact outside, and inside a single
/// solid; where solids overlap, the depth may come out too small, never too large. Infinite in an
/// empty world. On ridges, where the gradient jumps, that of one side.
SurfaceDistance surface_distance(const World& world, const Point& point);

/// How far a ray runs from a point along a direction of length one until it meets a solid, metres:
/// 0 from inside one, infinite where it meets none. Exact, to rounding.
double cast_ray(const World& world, const Point& origin, const Eigen::Vector3d& direction);

}  // namespace ridgeway
