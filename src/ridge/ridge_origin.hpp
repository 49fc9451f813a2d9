// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// A map's origin as headers have it: three whole numbers.
inline nlohmann::ordered_json json_of_origin(const VoxelIndex& origin) {
  return {origin.x, origin.y, origin.z};
}

/// The origin in a header; files of version 1 have none: zero. Throws std::out_of_range, or what
/// JSON does, where it is none.
inline VoxelIndex origin_in(const nlohmann::ordered_json& header) {
  if (!header.contains("origin")) return {};
  const nlohmann::ordered_json& json = header.at("origin");
  std::array<int, 3> parts{};
  for (std::size_t axis = 0; axis < parts.size(); ++axis) {
    const nlohmann::ordered_json& part = json.at(axis);
    if (!part.is_number_integer() || part.get<double>() < -kMaxVoxelIndex ||
        part.get<double>() > kMaxVoxelIndex)
      throw std::out_of_range("'origin' is no voxel");
    parts[axis] = part.get<int>();
  }
  if (json.size() != parts.size()) throw std::out_of_range("'origin' is no voxel");
  return {parts[0], parts[1], parts[2]};
}

}  // namespace ridgeway
