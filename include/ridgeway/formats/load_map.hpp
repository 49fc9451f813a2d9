// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// Which axis of a file points up.
enum class UpAxis : std::uint8_t { kX, kY, kZ };

/// How to make a map of a file. Lengths in metres, boxes in the world (z up).
struct LoadConfig {
  /// Voxel size of the result. Required for point clouds; for .3dmap the size of a cell (1 unless
  /// given); for meshes and worlds 0.1 unless given; for OctoMaps the file's own unless given,
  /// never finer.
  std::optional<double> voxel_size = std::nullopt;
  /// The flight volume: what is not wholly inside is unknown. Required for point clouds, which do
  /// not record free space, and for worlds without an end; for other worlds the box that their
  /// planes enclose, or the one around their solids, and for meshes the one around them unless
  /// given.
  std::optional<Box> bounds = std::nullopt;
  std::vector<Box> exclude = {};  ///< no-fly boxes, made occupied
  /// From the file's frame to the world's, where nothing may lie beyond 1e9 voxels from zero.
  /// Quarter turns and translations by whole voxels are exact; others make the obstacles of a voxel
  /// file grow (transform_map), not those of a cloud.
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  std::optional<double> units = std::nullopt;  ///< of meshes: metres a unit; instead of the file's
  std::optional<UpAxis> up = std::nullopt;     ///< of meshes: instead of the file's
  /// Of meshes: places in open space, in the world; what is reached from them is free. Without any
  /// what is reached from the bounds is, or within, where the mesh encloses more than that.
  std::vector<Point> inside = {};
  int isolated_below = 0;  ///< clusters of fewer occupied voxels become free (remove_isolated)

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// What a person should be told about a map that was loaded all the same.
struct LoadNotes {
  std::vector<std::string> notes;  ///< a sentence each, in the order in which they came up
};

/// Reads OctoMap .bt and .ot, point clouds .pcd, .ply and .xyz, meshes .dae, .glb, .gltf, .obj,
/// .stl and .ply (with faces), voxblox layers, simulated worlds .yaml, ROS maps .yaml (planar),
/// MovingAI .3dmap, and fused maps (`.ridge` files of save_tsdf), by what the file's bytes say; its
/// name counts where they say little: .obj, .gltf, worlds and text. In this order: read, transform,
/// resample, isolated filter, crop, no-fly boxes. Obstacles of meshes and worlds are all voxels
/// that they touch. Throws InputError naming the file (or the bad option) and the remedy; a map
/// that does not fit into memory is refused before it is taken.
OccupancyMap load_map(const std::filesystem::path& file, const LoadConfig& config = {},
                      LoadNotes* notes = nullptr);

}  // namespace ridgeway
