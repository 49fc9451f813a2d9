// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/load_map.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <utility>

#include "benchmark_map.hpp"
#include "common/number_text.hpp"
#include "files/read_file.hpp"
#include "files/text.hpp"
#include "load_steps.hpp"
#include "map_server.hpp"
#include "mapping/memory_limit.hpp"
#include "mesh_file.hpp"
#include "octomap.hpp"
#include "pcd.hpp"
#include "ply_cloud.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "voxblox.hpp"
#include "voxblox_graph.hpp"
#include "xyz.hpp"

namespace ridgeway {
namespace {

OccupancyMap without_specks(OccupancyMap map, const LoadConfig& config, LoadNotes* notes) {
  if (config.isolated_below <= 1) return map;
  const std::size_t before = count_voxels(map).occupied;
  map = remove_isolated(std::move(map), config.isolated_below);
  tell(notes, std::to_string(before - count_voxels(map).occupied) +
                  " occupied voxels in clusters of fewer than " +
                  std::to_string(config.isolated_below) + " were taken as free");
  return map;
}

bool has_free_voxel(const OccupancyMap& map) {
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot) {
    const VoxelState* states = map.state.block(slot);
    if (std::find(states, states + kBlockVoxels, VoxelState::kFree) != states + kBlockVoxels)
      return true;
  }
  return false;
}

/// The part of the source's lattice that bounds, seen back through a transform, can reach.
VoxelRange reach_before(const Eigen::Isometry3d& T_map_file, const Box& bounds, double voxel_size) {
  if (!bounds.min.allFinite() || !bounds.max.allFinite()) return kAllVoxels;
  const Eigen::AlignedBox3d box =
      Eigen::AlignedBox3d(bounds.min, bounds.max).transformed(T_map_file.inverse());
  return voxels_overlapping({box.min(), box.max()}, voxel_size);
}

}  // namespace

OccupancyMap finished(OccupancyMap map, const LoadConfig& config, const std::string& name,
                      LoadNotes* notes, double beyond) {
  map = without_specks(std::move(map), config, notes);
  if (config.bounds) map = crop(std::move(map), *config.bounds, beyond);
  require_memory_for_blocks(map.layout.block_count(), kPipelineBytesPerVoxel, name);
  map = add_no_fly(std::move(map), config.exclude);
  if (has_free_voxel(map)) return map;
  throw InputError(name, "has no free voxel left within the bounds and outside the no-fly boxes",
                   "check bounds, exclude and voxel_size");
}

OccupancyMap placed_voxels(const VoxelSource& source, const LoadConfig& config,
                           const std::string& name, LoadNotes* notes) {
  const double voxel_size = config.voxel_size.value_or(source.voxel_size);
  if (voxel_size < source.voxel_size * (1.0 - 1e-6)) {
    std::ostringstream what;
    what << voxel_size << " m is finer than the " << source.voxel_size << " m of " << name;
    throw InputError("voxel_size", what.str(), "leave it out, or give a larger one");
  }
  const auto motion = find_lattice_transform(config.transform, source.voxel_size);
  const bool edited = config.bounds || !motion || voxel_size > source.voxel_size * (1.0 + 1e-6);

  VoxelPlacement placement{.motion = motion.value_or(LatticeTransform{}),
                           .bytes_per_voxel = edited ? kMapBytesPerVoxel : kPipelineBytesPerVoxel};
  if (config.bounds) {
    // What lies around decides on the voxels at the border: their specks, their coarse voxels.
    const Eigen::Vector3d margin =
        Eigen::Vector3d::Constant((4.0 + config.isolated_below) * voxel_size);
    const Box around = {config.bounds->min - margin, config.bounds->max + margin};
    placement.clip = motion ? voxels_overlapping(around, source.voxel_size)
                            : reach_before(config.transform, around, source.voxel_size);
  }
  OccupancyMap map = source.read(placement);
  if (motion) return resample(std::move(map), voxel_size);
  tell(notes,
       "the transform is not made of quarter turns and whole voxels: obstacles and unknown space "
       "grew by up to a voxel's diagonal");
  return transform_map(map, config.transform, voxel_size);
}

OccupancyMap load_voxels(const VoxelSource& source, const LoadConfig& config,
                         const std::string& name, LoadNotes* notes) {
  return finished(placed_voxels(source, config, name, notes), config, name, notes);
}

namespace {

OccupancyMap load_cloud(const PointCloud& cloud, const LoadConfig& config, const std::string& name,
                        LoadNotes* notes) {
  require_no_faces(cloud, name);
  if (cloud.points.empty()) {
    throw InputError(name,
                     cloud.skipped > 0 ? "has no point with finite coordinates" : "has no points",
                     "record or write the cloud again");
  }
  const std::string span = "its points span " + describe(extent(cloud, config.transform));
  if (!config.voxel_size && !config.bounds)
    throw InputError(
        name,
        "is a point cloud, which has no voxel size, and in which the free space is not "
        "recorded",
        std::string("give bounds and voxel_size; ").append(span));
  if (!config.voxel_size)
    throw InputError(name, "is a point cloud, which has no voxel size",
                     std::string("give voxel_size; ").append(span));
  if (!config.bounds)
    throw InputError(name, "is a point cloud, in which the free space is not recorded",
                     std::string("give bounds; ").append(span));
  tell(notes,
       "the cloud does not record free space: everything within bounds that is not occupied is "
       "taken as free, behind walls too (scans with their poses, fused, say what is)");
  OccupancyMap map = map_from_points(cloud,
                                     {.voxel_size = *config.voxel_size,
                                      .bounds = *config.bounds,
                                      .margin = config.isolated_below,
                                      .T_map_cloud = config.transform},
                                     name, notes);
  const double on_the_face = 1e-3 * *config.voxel_size;
  return finished(std::move(map), config, name, notes, on_the_face);
}

void require_mesh_options_unused(const LoadConfig& config, const std::string& name) {
  const char* const given = config.units             ? "units"
                            : config.up              ? "up"
                            : !config.inside.empty() ? "inside"
                                                     : nullptr;
  if (given != nullptr)
    throw InputError(given, "is of meshes, which " + name + " is not", "leave it out");
}

OccupancyMap load_benchmark_map(std::string_view bytes, const LoadConfig& config,
                                const std::string& name, LoadNotes* notes) {
  if (!config.voxel_size) tell(notes, "the file records no voxel size: a cell is taken as 1 m");
  const double cell = config.voxel_size.value_or(1.0);
  const VoxelSource source = {cell, [&](const VoxelPlacement& placement) {
                                return read_benchmark_map(bytes, name, cell, placement);
                              }};
  return load_voxels(source, config, name, notes);
}

OccupancyMap load_known(const OccupancyMap& map, const LoadConfig& config, const std::string& name,
                        LoadNotes* notes) {
  const VoxelSource source = {
      map.voxel_size, [&](const VoxelPlacement& placement) {
        OccupancyBuilder builder(
            map.voxel_size,
            {.clip = placement.clip, .bytes_per_voxel = placement.bytes_per_voxel, .name = name});
        for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
          const VoxelIndex voxel = map.origin + map.layout.index_of(id);
          if (map.state[id] != VoxelState::kUnknown)
            builder.set(placement.motion({voxel, voxel}).min, map.state[id]);
        }
        return std::move(builder).finish();
      }};
  return load_voxels(source, config, name, notes);
}

OccupancyMap load_voxblox(std::string_view bytes, const LoadConfig& config, const std::string& name,
                          LoadNotes* notes) {
  const std::vector<VoxbloxLayer> layers = read_voxblox(bytes, name);
  const VoxbloxLayer& layer = map_layer(layers, name);
  if (layers.size() > 1)
    tell(notes, "of " + std::to_string(layers.size()) + " layers the " + layer.type + " is taken");
  return load_known(map_of_layer(layer, name), config, name, notes);
}

/// Text that begins with a number, or with column names, after comments.
bool looks_like_xyz(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  if (head.find('\0') != std::string_view::npos) return false;
  for (std::size_t at = 0; at < head.size();) {
    at = head.find_first_not_of(" \t\r\n,;", at);
    if (at == std::string_view::npos) return false;
    if (head[at] != '#' && head.substr(at, 2) != "//") {
      const unsigned char c = static_cast<unsigned char>(head[at]);
      return std::isdigit(c) != 0 || c == '-' || c == '+' || c == '.';
    }
    at = std::min(head.find('\n', at), head.size());
  }
  return false;
}

bool is_yaml_name(const std::filesystem::path& file) {
  return extension_of(file) == ".yaml" || extension_of(file) == ".yml";
}

bool is_named_as_text(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".xyz" || extension == ".txt" || extension == ".csv" || extension == ".asc";
}

}  // namespace

void LoadConfig::validate() const {
  if (voxel_size) validate_voxel_size(*voxel_size, "voxel_size");
  if (bounds) validate_box(*bounds, "bounds");
  if (up && *up != UpAxis::kX && *up != UpAxis::kY && *up != UpAxis::kZ)
    throw InputError("up", "is no enumerator of UpAxis", "give kX, kY or kZ");
  for (std::size_t i = 0; i < exclude.size(); ++i)
    validate_box(exclude[i], "exclude box " + std::to_string(i + 1));
  validate_transform(transform);
  constexpr double kMostUnits = 1e6;
  if (units && !(*units >= 1.0 / kMostUnits && *units <= kMostUnits))
    throw InputError("units", "are " + number_text(*units) + " m",
                     "give metres from 1e-6 to 1e6, for example 0.001 for millimetres");
  for (const Point& place : inside)
    if (!place.allFinite())
      throw InputError("inside", "is no place", "give three finite numbers, metres");
  if (isolated_below < 0) {
    throw InputError("isolated_below", "is " + std::to_string(isolated_below),
                     "give a number of voxels, 0 to keep all");
  }
}

namespace {

bool is_image(std::string_view bytes) {
  return bytes.starts_with("P5") || bytes.starts_with("P2") || bytes.starts_with("\x89PNG");
}

}  // namespace

OccupancyMap load_map(const std::filesystem::path& file, const LoadConfig& config,
                      LoadNotes* notes) {
  config.validate();
  if (std::error_code error; std::filesystem::is_directory(file, error))
    throw InputError(file.string(), "is a folder",
                     "give a file; recordings of cameras and scans are fused to one first");
  if (is_tsdf_file(file))
    return load_known(occupancy_of(load_tsdf(file)), config, file.string(), notes);
  const std::string bytes = read_file(file), name = file.string();
  if (bytes.starts_with("RIDGEWAY"))
    throw InputError(name, "is a roadmap already", "give the map that it was built from");
  if (const std::string format = mesh_format(bytes, file); !format.empty())
    return load_mesh_map(file, bytes, format, config, notes);
  require_mesh_options_unused(config, name);
  if (is_map_server(bytes)) return load_planar_map(file, bytes, config, notes);
  if (is_yaml_name(file)) return load_world_map(file, config, notes);
  if (is_octomap(bytes)) {
    const VoxelSource source = {
        read_octomap_header(bytes, name).voxel_size,
        [&](const VoxelPlacement& placement) { return read_octomap(bytes, name, placement); }};
    return load_voxels(source, config, name, notes);
  }
  if (is_voxblox(bytes)) return load_voxblox(bytes, config, name, notes);
  if (is_voxblox_graph(bytes))
    throw InputError(name, "is a sparse graph, which says nothing of the space around it",
                     "build from the TSDF or ESDF that it was made of");
  if (is_pcd(bytes)) return load_cloud(read_pcd(bytes, name), config, name, notes);
  if (is_ply(bytes)) return load_cloud(read_ply(bytes, name), config, name, notes);
  if (is_benchmark_map(bytes)) return load_benchmark_map(bytes, config, name, notes);
  if (is_image(bytes))
    throw InputError(name, "is in no map format, but an image",
                     "give the .yaml of the ROS map that it is of");
  if (looks_like_xyz(bytes) || is_named_as_text(file))
    return load_cloud(read_xyz(bytes, name), config, name, notes);
  throw InputError(
      name, "is in no map format that is known here",
      "give an OctoMap .bt or .ot, a mesh .dae, .glb, .obj, .stl or .ply, a point cloud "
      ".pcd, .ply or .xyz, voxblox layers .vxblx, a ROS map or world .yaml, or a .3dmap");
}

}  // namespace ridgeway
