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

/// By place in a block: the directions in which a neighbour's sub-field is a later one.
inline constexpr std::array<Cube27, kBlockVoxels> kLaterFields = [] {
  std::array<Cube27, kBlockVoxels> later{};
  for (VoxelId place = 0; place < kBlockVoxels; ++place)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex n = voxel_of({}, static_cast<int>(place)) + offset_of(d);
      if (sub_field(static_cast<VoxelId>(local_of(n))) > sub_field(place)) later[place] |= 1u << d;
    }
  return later;
}();

}  // namespace ridgeway::detail
