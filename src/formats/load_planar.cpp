// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "files/read_file.hpp"
#include "grey_image.hpp"
#include "load_steps.hpp"
#include "map_server.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// The image as columns of voxels, the lower left pixel's at zero.
OccupancyMap columns_of(const GreyImage& image, const MapServerFile& file, int layers,
                        const VoxelPlacement& placement, const std::string& name) {
  OccupancyBuilder builder(
      file.resolution,
      {.clip = placement.clip, .bytes_per_voxel = placement.bytes_per_voxel, .name = name});
  std::size_t pixel = 0;
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x, ++pixel) {
      const std::uint8_t opaque = image.opaque.empty() ? 255 : image.opaque[pixel];
      const VoxelState state = state_of_pixel(file, image.grey[pixel], opaque);
      builder.fill(placement.motion(VoxelRange{{x, y, 0}, {x, y, layers - 1}}), state);
    }
  return std::move(builder).finish();
}

/// The turn of a map's file. People write quarter turns with some decimals: one that moves no
/// corner of the image by a hundredth of a pixel from where a quarter turn puts it is one.
Eigen::AngleAxisd turn_of(const MapServerFile& facts, const GreyImage& image) {
  constexpr double kQuarter = 0.5 * std::numbers::pi, kSmall = 0.01;
  const double nearest = kQuarter * std::round(facts.yaw / kQuarter);
  const double moves = std::abs(facts.yaw - nearest) * std::hypot(image.width, image.height);
  return {moves < kSmall ? nearest : facts.yaw, Eigen::Vector3d::UnitZ()};
}

}  // namespace

OccupancyMap load_planar_map(const std::filesystem::path& file, std::string_view text,
                             const LoadConfig& given, LoadNotes* notes) {
  const std::string name = file.string();
  const MapServerFile facts = read_map_server(text, name);
  if (!given.transform.isApprox(Eigen::Isometry3d::Identity(), 0.0))
    throw InputError("transform", "cannot move a map in the plane, whose file says where it lies",
                     "change the origin in " + name);
  const auto path = file.parent_path() / facts.image;
  const GreyImage image = read_grey_image(read_file(path), path.string());

  LoadConfig config = given;
  if (config.bounds) {  // in the plane: all heights are read
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    config.bounds->min.z() = -kInfinity;
    config.bounds->max.z() = kInfinity;
  }
  config.transform = Eigen::Translation3d(facts.x, facts.y, 0.0) * turn_of(facts, image);
  const double voxel_size = config.voxel_size.value_or(facts.resolution);
  // So many that the lowest layer of larger voxels lies within what is known.
  constexpr double kMostLayers = 1e6;
  const double layers = std::ceil(voxel_size / facts.resolution) + 1.0;
  if (!(layers <= kMostLayers))
    throw InputError("voxel size", "is more than a million pixels of " + name,
                     "give a smaller one, in metres");
  const VoxelSource source = {facts.resolution, [&](const VoxelPlacement& placement) {
                                return columns_of(image, facts, static_cast<int>(layers), placement,
                                                  name);
                              }};
  const OccupancyMap columns = placed_voxels(source, config, name, notes);
  return finished(flatten(columns, 0.0, columns.voxel_size), config, name, notes);
}

}  // namespace ridgeway
