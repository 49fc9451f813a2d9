// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "common/number_text.hpp"
#include "planar.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// What is known of the columns of a block, seen from above.
struct Columns {
  std::array<int, 64> free{};  // voxels of each
  std::array<bool, 64> occupied{};
};
using Plan = std::map<std::pair<int, int>, Columns>;  // by y and x of the block

Plan columns_between(const OccupancyMap& map, int first, int last) {
  Plan plan;
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot) {
    const BlockIndex& block = map.layout.block(slot);
    const int low = std::max(first - block.z * kBlockSide, 0);
    const int high = std::min(last - block.z * kBlockSide, kBlockSide - 1);
    if (low > high) continue;
    Columns& columns = plan[{block.y, block.x}];
    const VoxelState* states = map.state.block(slot);
    for (int z = low; z <= high; ++z)
      for (std::size_t i = 0; i < 64; ++i) {
        const VoxelState state = states[64 * static_cast<std::size_t>(z) + i];
        columns.free[i] += state == VoxelState::kFree;
        columns.occupied[i] |= state == VoxelState::kOccupied;
      }
  }
  return plan;
}

void require_heights(double low, double high) {
  constexpr double kFarthest = 1e9;
  if (std::abs(low) <= kFarthest && std::abs(high) <= kFarthest && low < high) return;
  throw InputError("planar heights " + number_text(low) + " and " + number_text(high),
                   "are no slice of the map", "give two numbers, the lower first");
}

}  // namespace

OccupancyMap flatten(const OccupancyMap& map, double low, double high) {
  require_heights(low, high);
  detail::require_three_dimensions(map);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const VoxelRange slice = voxels_overlapping(
      {Point(-kInfinity, -kInfinity, low), Point(kInfinity, kInfinity, high)}, map.voxel_size);
  const int first = slice.min.z - map.origin.z, last = slice.max.z - map.origin.z;
  const Plan plan = columns_between(map, first, last);
  OccupancyMap flat;
  flat.voxel_size = map.voxel_size;
  const int middle = floor_to_int(0.5 * (low + high) / map.voxel_size);
  flat.origin = {map.origin.x, map.origin.y, middle - detail::kStandingLayer};
  std::vector<BlockIndex> blocks;
  for (const auto& [place, columns] : plan) blocks.push_back({place.second, place.first, 0});
  flat.layout = BlockLayout(std::move(blocks));
  flat.state = VoxelField<VoxelState>(flat.layout);
  bool any = false;
  for (const auto& [place, columns] : plan) {
    VoxelState* states = flat.state.block(flat.layout.find_block({place.second, place.first, 0}));
    for (std::size_t i = 0; i < 64; ++i) {
      const VoxelState state = columns.occupied[i]                   ? VoxelState::kOccupied
                               : columns.free[i] == last - first + 1 ? VoxelState::kFree
                                                                     : VoxelState::kUnknown;
      any |= state != VoxelState::kUnknown;
      for (std::size_t z = 0; z < kBlockSide; ++z) states[64 * z + i] = state;
    }
  }
  if (!any)
    throw InputError(
        "map", "is nowhere known from " + number_text(low) + " to " + number_text(high) + " m",
        "give other heights");
  flat = normalised(std::move(flat));
  flat.planar = true;
  return flat;
}

}  // namespace ridgeway
