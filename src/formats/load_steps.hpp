// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "ridgeway/formats/load_map.hpp"
#include "voxel_placement.hpp"

namespace ridgeway {

// What load_map is made of.

/// A file that holds voxels, ready to be read into place.
struct VoxelSource {
  double voxel_size;
  std::function<OccupancyMap(const VoxelPlacement&)> read;
};

/// Adds a note, where someone wants notes.
inline void tell(LoadNotes* notes, std::string_view note) {
  if (notes != nullptr) notes->notes.emplace_back(note);
}

/// The edits that every kind of file ends with: isolated filter, crop (obstacles stay so far
/// above the upper faces of the bounds, metres), no-fly boxes. Throws InputError, naming `name`,
/// where nothing free is left.
OccupancyMap finished(OccupancyMap map, const LoadConfig& config, const std::string& name,
                      LoadNotes* notes, double beyond = 0.0);

/// Reads the voxels, moves them, makes them coarser. Only what can come to lie within the bounds is
/// read: large files with small bounds fit.
OccupancyMap placed_voxels(const VoxelSource& source, const LoadConfig& config,
                           const std::string& name, LoadNotes* notes);

/// The same, with the edits of `finished`.
OccupancyMap load_voxels(const VoxelSource& source, const LoadConfig& config,
                         const std::string& name, LoadNotes* notes);

/// The triangles of a file of a format (mesh_format), by map_from_mesh.
OccupancyMap load_mesh_map(const std::filesystem::path& file, std::string_view bytes,
                           const std::string& format, const LoadConfig& config, LoadNotes* notes);

/// A simulated world, by touched_by.
OccupancyMap load_world_map(const std::filesystem::path& file, const LoadConfig& config,
                            LoadNotes* notes);

/// A planar map of the image that a ROS map file names, in the layer from 0 to a voxel's height.
OccupancyMap load_planar_map(const std::filesystem::path& file, std::string_view text,
                             const LoadConfig& given, LoadNotes* notes);

}  // namespace ridgeway
