// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>

#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway::detail {

/// Which of the eight parity sub-fields a voxel is in; no two voxels of one are 26-adjacent.
constexpr std::uint32_t sub_field(VoxelId id) {
  return (id & 1) | (id >> 3 & 1) << 1 | (id >> 6 & 1) << 2;
}

/// By place in a block: the directions in which a neighbour's sub-field is a later one. A step
/// flips the parity along the axes that it goes along.
inline constexpr std::array<Cube27, kBlockVoxels> kLaterFields = [] {
  std::array<Cube27, 8> of_field{};
  for (std::uint32_t field = 0; field < 8; ++field)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex& o = offset_of(d);
      const std::uint32_t flipped = (o.x & 1) | (o.y & 1) << 1 | (o.z & 1) << 2;
      if ((field ^ flipped) > field) of_field[field] |= 1u << d;
    }
  std::array<Cube27, kBlockVoxels> later{};
  for (VoxelId place = 0; place < kBlockVoxels; ++place) later[place] = of_field[sub_field(place)];
  return later;
}();

}  // namespace ridgeway::detail
