// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "grey_image.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// What the .yaml file of a ROS map says of its image.
struct MapServerFile {
  enum class Mode : std::uint8_t { kTrinary, kScale, kRaw };
  std::filesystem::path image;         ///< as written
  double resolution = 0.0;             ///< metres a pixel
  double x = 0.0, y = 0.0, yaw = 0.0;  ///< of the lower left corner in the world, metres, radians
  bool negate = false;                 ///< white is occupied
  double occupied_thresh = 0.65;       ///< more likely occupied than that: occupied
  double free_thresh = 0.196;          ///< less: free
  Mode mode = Mode::kTrinary;
};

/// Does a text look like such a file: a key `image` at the beginning of a line?
bool is_map_server(std::string_view text);

/// Throws InputError, with the line, for keys that are missing or hold no such value.
MapServerFile read_map_server(std::string_view text, const std::string& name);

/// What a pixel says: the probability of being occupied is 1 - grey / 255 (negated grey / 255), in
/// the mode raw grey / 100. Neither free nor occupied, or seen through: unknown.
VoxelState state_of_pixel(const MapServerFile& file, std::uint8_t grey, std::uint8_t opaque);

}  // namespace ridgeway
