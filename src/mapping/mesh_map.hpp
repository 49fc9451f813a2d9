// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {

/// Triangles in the world, metres.
struct TriangleSoup {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
  double off = 0.0;  ///< metres by which coordinates may be off, as they were rounded
};

struct MeshMapConfig {
  double voxel_size = 0.0;    ///< metres, required
  std::optional<Box> bounds;  ///< of what is known; left out: the box around the mesh
  std::vector<Point> inside;  ///< places in free space, world; see map_from_mesh
  int margin = 0;             ///< surfaces are also kept so many voxels beyond the bounds
};

/// Where space that should be closed is open.
struct MeshLeak {
  Point exit = Point::Zero();       ///< a place at the bounds that is reached
  Point narrowest = Point::Zero();  ///< of the widest way there
  double width = 0.0;               ///< metres, about: how wide it is there
};

struct MeshMapReport {
  Box box;  ///< around the triangles
  enum class Free : std::uint8_t {
    kAround,  ///< what is reached from the bounds
    kWithin,  ///< the largest space that the surface encloses, larger than what is around it
    kSeeded,  ///< what is reached from the places given
  } free = Free::kAround;
  std::uint64_t enclosed = 0;        ///< spaces enclosed that are not free
  double largest_enclosed = 0.0;     ///< cubic metres
  Point in_largest = Point::Zero();  ///< a place in it
  std::optional<MeshLeak> leak;      ///< of kSeeded: the space is not closed within the bounds
};

/// The box around the vertices that triangles use. Throws InputError naming `name` where there is
/// no triangle, one names a vertex that is not there, or a coordinate is not finite.
Box box_around(const TriangleSoup& mesh, const std::string& name);

/// A surface as a map: voxels that a triangle touches are occupied (touched_voxels), so that a
/// closed surface is closed at any voxel size, and a sheet is a thin wall. Of the others, those
/// wholly inside the bounds are free that are reached across faces of voxels from the places
/// `inside`; where none is given, from the bounds, or from within, if the largest space that the
/// surface encloses is larger than all that is around it. All else is unknown. Normals of triangles
/// play no part. The same for any number of threads.
/// Throws InputError naming `name` where bounds hold no voxel, a place of `inside` is in a wall or
/// outside the bounds, nothing is free, or memory would not do.
OccupancyMap map_from_mesh(const TriangleSoup& mesh, const MeshMapConfig& config,
                           const std::string& name, MeshMapReport* told = nullptr);

}  // namespace ridgeway
