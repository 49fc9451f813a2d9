// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {

/// Everything behind a plane is solid: normal . x < offset. The normal has length one and points
/// into the open.
struct SolidPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of length one, into the open
  double offset = 0.0;                                ///< metres
};

/// A box along the axes.
struct SolidBox {
  Point centre = Point::Zero();                    ///< metres
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< metres, all above 0
};

/// A ball.
struct SolidSphere {
  Point centre = Point::Zero();  ///< metres
  double radius = 1.0;           ///< metres, above 0
};

/// An upright cylinder.
struct SolidCylinder {
  Point centre = Point::Zero();  ///< metres, of the whole: half of it lies above
  double radius = 1.0;           ///< metres, above 0
  double height = 1.0;           ///< metres, above 0
};

/// A mesh at a place of its own; many may share its triangles.
struct PlacedMesh {
  std::shared_ptr<const SolidMesh> mesh;  ///< there must be one
  double scale = 1.0;                     ///< metres of the world a unit of the mesh, above 0
  Eigen::Isometry3d T_world_mesh = Eigen::Isometry3d::Identity();  ///< after scaling
  std::string file = {};  ///< where it was read; may be empty
};

/// Solids that are there for a while: a door that is closed, a crate until it is moved.
struct TimedSolids {
  double from = -std::numeric_limits<double>::infinity();  ///< seconds
  double until = std::numeric_limits<double>::infinity();  ///< seconds; no longer there then
  std::vector<SolidBox> boxes = {};                        ///< that are there meanwhile
  std::vector<SolidSphere> spheres = {};                   ///< that are there meanwhile
  std::vector<SolidCylinder> cylinders = {};               ///< that are there meanwhile
};

/// A simulated world: the union of solids, metres, z up. Plain data; thread-safe to read.
struct World {
  std::string name = {};                      ///< for people; may be empty
  std::vector<SolidPlane> planes = {};        ///< half-spaces
  std::vector<SolidBox> boxes = {};           ///< along the axes
  std::vector<SolidSphere> spheres = {};      ///< balls
  std::vector<SolidCylinder> cylinders = {};  ///< upright
  std::vector<PlacedMesh> meshes = {};        ///< surfaces of triangles
  std::vector<TimedSolids> timed = {};  ///< which only world_at() and world_at_all_times() see
};

/// The world as it is at a time, seconds: with the timed solids that are there then, and none that
/// come or go.
World world_at(const World& world, double time);
/// The world with all timed solids, as if they never came or went: what is in the way at some time.
World world_at_all_times(const World& world);

/// Throws InputError naming the first solid without a size (a mesh without triangles), with a
/// number that is not finite, or a normal that is not of length one, and timed solids that are
/// never there.
void validate_world(const World& world);

/// Signed distance to the nearest surface and its gradient. Exact outside, and inside a single
/// solid; where solids overlap, the depth may come out too small, never too large. Infinite in an
/// empty world. On ridges, where the gradient jumps, that of one side.
SurfaceDistance surface_distance(const World& world, const Point& point);

/// How far a ray runs from a point along a direction of length one until it meets a solid, metres:
/// 0 from inside one, infinite where it meets none. Exact, to rounding.
double cast_ray(const World& world, const Point& origin, const Eigen::Vector3d& direction);

}  // namespace ridgeway
