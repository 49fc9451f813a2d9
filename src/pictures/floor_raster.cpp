// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "floor_raster.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
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
      if (state[i] != VoxelState::kUnknown && is_of_map(esdf, i))
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
      if (state[i] == VoxelState::kUnknown || !is_of_map(esdf, i)) continue;
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

/// Heights between which the middle three fifths of some free voxels lie.
HeightBand middle_band(const std::map<int, std::size_t>& free_at_height, double voxel_size) {
  std::size_t total = 0, below = 0;
  for (const auto& [z, count] : free_at_height) total += count;
  std::optional<int> low, high;
  for (const auto& [z, count] : free_at_height) {
    below += count;
    if (!low && 5 * below > total) low = z;
    if (!high && 5 * below >= 4 * total) high = z;
  }
  return {*low * voxel_size, (*high + 1) * voxel_size};
}

HeightBand default_band(const KnownExtent& found, const Projection& projection, double voxel_size) {
  const std::array<int, 3> low = {found.min.x, found.min.y, found.min.z},
                           high = {found.max.x, found.max.y, found.max.z};
  const auto along = static_cast<std::size_t>(projection.along);
  if (projection.along != 2 || found.free_at_height.empty())
    return {low[along] * voxel_size, (high[along] + 1) * voxel_size};
  return middle_band(found.free_at_height, voxel_size);
}

KnownExtent require_known(const EsdfMap& esdf) {
  KnownExtent found = known_extent(esdf);
  if (found.min.x > found.max.x)
    throw InputError("map", "has no known voxels to draw", "build the map from other data");
  return found;
}

/// How much is free at each height from the lowest on.
using FreeByHeight = std::vector<std::size_t>;

/// The height of the slab between two storeys, if there is one within [begin, end).
std::optional<std::size_t> find_slab(const FreeByHeight& free, std::size_t begin, std::size_t end,
                                     std::size_t least_height) {
  constexpr double kSlab = 0.35, kStorey = 0.1;  // shares of a storey's, and of the map's, most
  const std::size_t most = *std::max_element(free.begin(), free.end());
  std::vector<std::size_t> above(end - begin + 1, 0);  // most from a height on
  for (std::size_t z = end; z-- > begin;)
    above[z - begin] = std::max(above[z - begin + 1], free[z]);
  std::optional<std::size_t> slab;
  double least = kSlab;
  std::size_t below = 0;
  for (std::size_t z = begin; z < end; below = std::max(below, free[z++])) {
    const std::size_t beside = std::min(below, above[z - begin + 1]);
    if (z < begin + least_height || z + least_height > end) continue;
    if (static_cast<double>(beside) < kStorey * static_cast<double>(most)) continue;
    const double share = static_cast<double>(free[z]) / static_cast<double>(beside);
    if (share >= least) continue;
    least = share;
    slab = z;
  }
  return slab;
}

void split_storeys(const FreeByHeight& free, std::size_t begin, std::size_t end,
                   std::size_t least_height, std::vector<std::size_t>& slabs) {
  const auto slab = find_slab(free, begin, end, least_height);
  if (!slab) return;
  split_storeys(free, begin, *slab, least_height, slabs);
  slabs.push_back(*slab);
  split_storeys(free, *slab, end, least_height, slabs);
}

}  // namespace

FloorRaster make_floor_raster(const EsdfMap& esdf, const Projection& projection,
                              const std::optional<HeightBand>& band, int most_cells) {
  const KnownExtent found = require_known(esdf);
  const auto part = [](const VoxelIndex& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
  };
  const auto [across, up, along] = projection;
  FloorRaster raster;
  raster.projection = projection;
  raster.band = band ? *band : default_band(found, projection, esdf.voxel_size);
  raster.first = found.min;
  const int columns = part(found.max, across) - part(found.min, across) + 1,
            rows = part(found.max, up) - part(found.min, up) + 1;
  raster.side = (std::max(columns, rows) - 1) / most_cells + 1;
  raster.nx = (columns - 1) / raster.side + 1;
  raster.ny = (rows - 1) / raster.side + 1;
  raster.cells.resize(static_cast<std::size_t>(raster.nx) * static_cast<std::size_t>(raster.ny));
  for_each_known(
      esdf, [&, across = across, up = up, along = along](const VoxelIndex& v, VoxelState state) {
        const double depth = (part(v, along) + 0.5) * esdf.voxel_size;
        if (depth < raster.band.low || depth > raster.band.high) return;
        const int cx = (part(v, across) - part(raster.first, across)) / raster.side,
                  cy = (part(v, up) - part(raster.first, up)) / raster.side;
        FloorRaster::Cell& cell =
            raster.cells[static_cast<std::size_t>(cy) * static_cast<std::size_t>(raster.nx) +
                         static_cast<std::size_t>(cx)];
        ++(state == VoxelState::kFree ? cell.free : cell.occupied);
      });
  return raster;
}

std::vector<Storey> find_storeys(const EsdfMap& esdf, double least_height) {
  const KnownExtent found = require_known(esdf);
  FreeByHeight free(static_cast<std::size_t>(found.max.z - found.min.z) + 1, 0);
  for (const auto& [z, count] : found.free_at_height)
    free[static_cast<std::size_t>(z - found.min.z)] = count;
  const auto least =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(least_height / esdf.voxel_size)));
  std::vector<std::size_t> bounds = {0};
  split_storeys(free, 0, free.size(), least, bounds);
  bounds.push_back(free.size());
  std::vector<Storey> storeys;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const int low = found.min.z + static_cast<int>(bounds[i]),
              high = found.min.z + static_cast<int>(bounds[i + 1]);
    const HeightBand heights{low * esdf.voxel_size, high * esdf.voxel_size};
    const std::map<int, std::size_t> inside(found.free_at_height.lower_bound(low),
                                            found.free_at_height.lower_bound(high));
    storeys.push_back({heights, inside.empty() ? heights : middle_band(inside, esdf.voxel_size)});
  }
  return storeys;
}

}  // namespace ridgeway
