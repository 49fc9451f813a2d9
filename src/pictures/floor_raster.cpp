// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "floor_raster.hpp"

#include <algorithm>
#include <climits>
#include <map>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

/// Calls visit(voxel of the lattice, state) for every known voxel.
template <typename Visit>
void for_each_known(const EsdfMap& esdf, const Visit& visit) {
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot) {
    const VoxelState* state = esdf.state.block(slot);
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (state[i] != VoxelState::kUnknown)
        visit(esdf.origin + voxel_of(esdf.layout.block(slot), i), state[i]);
    }
  }
}

/// Extent of the known voxels in the lattice, and how many free ones there are at each height.
struct KnownExtent {
  VoxelIndex min{INT_MAX, INT_MAX, INT_MAX}, max{INT_MIN, INT_MIN, INT_MIN};
  std::map<int, std::size_t> free_at_height;
};

KnownExtent known_extent(const EsdfMap& esdf) {
  KnownExtent found;
  std::array<std::size_t, kBlockSide> free_in_layer{};
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot) {
    const VoxelState* state = esdf.state.block(slot);
    free_in_layer.fill(0);
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (state[i] == VoxelState::kUnknown) continue;
      const VoxelIndex v = esdf.origin + voxel_of(esdf.layout.block(slot), i);
      found.min = {std::min(found.min.x, v.x), std::min(found.min.y, v.y),
                   std::min(found.min.z, v.z)};
      found.max = {std::max(found.max.x, v.x), std::max(found.max.y, v.y),
                   std::max(found.max.z, v.z)};
      free_in_layer[static_cast<std::size_t>(i >> 6)] += state[i] == VoxelState::kFree;
    }
    for (int z = 0; z < kBlockSide; ++z) {
      if (const std::size_t free = free_in_layer[static_cast<std::size_t>(z)]; free > 0) {
        found.free_at_height[esdf.origin.z + esdf.layout.block(slot).z * kBlockSide + z] += free;
      }
    }
  }
  return found;
}

/// Heights between which the middle three fifths of the free voxels lie.
HeightBand middle_band(const KnownExtent& found, double voxel_size) {
  if (found.free_at_height.empty()) {
    return {found.min.z * voxel_size, (found.max.z + 1) * voxel_size};
  }
  std::size_t total = 0, below = 0;
  for (const auto& [z, count] : found.free_at_height) total += count;
  std::optional<int> low, high;
  for (const auto& [z, count] : found.free_at_height) {
    below += count;
    if (!low && 5 * below > total) low = z;
    if (!high && 5 * below >= 4 * total) high = z;
  }
  return {*low * voxel_size, (*high + 1) * voxel_size};
}

}  // namespace

FloorRaster make_floor_raster(const EsdfMap& esdf, const std::optional<HeightBand>& band,
                              int most_cells) {
  const KnownExtent found = known_extent(esdf);
  if (found.min.x > found.max.x) {
    throw InputError("map", "has no known voxels to draw", "build the map from other data");
  }
  FloorRaster raster;
  raster.band = band ? *band : middle_band(found, esdf.voxel_size);
  raster.first = found.min;
  const int columns_x = found.max.x - found.min.x + 1, columns_y = found.max.y - found.min.y + 1;
  const int longest = std::max(columns_x, columns_y);
  raster.side = (longest - 1) / most_cells + 1;
  raster.nx = (columns_x - 1) / raster.side + 1;
  raster.ny = (columns_y - 1) / raster.side + 1;
  raster.cells.resize(static_cast<std::size_t>(raster.nx) * static_cast<std::size_t>(raster.ny));
  for_each_known(esdf, [&](const VoxelIndex& v, VoxelState state) {
    const double z = (v.z + 0.5) * esdf.voxel_size;
    if (z < raster.band.low || z > raster.band.high) return;
    const int cx = (v.x - raster.first.x) / raster.side, cy = (v.y - raster.first.y) / raster.side;
    FloorRaster::Cell& cell =
        raster.cells[static_cast<std::size_t>(cy) * static_cast<std::size_t>(raster.nx) +
                     static_cast<std::size_t>(cx)];
    ++(state == VoxelState::kFree ? cell.free : cell.occupied);
  });
  return raster;
}

}  // namespace ridgeway
