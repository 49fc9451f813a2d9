// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "surface_quads.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <climits>

#include "merge_faces.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

constexpr int kSide = SurfaceQuads::kMostCells;
using CubeIndex = Index3<struct CubeTag>;
using Plane = detail::FacePlane<kSide>;

/// The cells of a cube and those beside it: bit x + 1 of row (z + 1, y + 1).
class CubeCells {
 public:
  CubeCells(const EsdfMap& esdf, const CubeIndex& cube, int cell_voxels) {
    const int side = kSide * cell_voxels;
    const VoxelIndex low{cube.x * side, cube.y * side, cube.z * side};
    const VoxelIndex first{low.x - cell_voxels, low.y - cell_voxels, low.z - cell_voxels};
    const VoxelIndex last{low.x + side + cell_voxels - 1, low.y + side + cell_voxels - 1,
                          low.z + side + cell_voxels - 1};
    const BlockIndex a = block_of(first), b = block_of(last);
    for (int z = a.z; z <= b.z; ++z)
      for (int y = a.y; y <= b.y; ++y)
        for (int x = a.x; x <= b.x; ++x) {
          const std::uint32_t slot = esdf.layout.find_block({x, y, z});
          if (slot != BlockLayout::kNoBlock) add_block(esdf, slot, {x, y, z}, first, cell_voxels);
        }
    for (std::size_t z = 0; z < kRows; ++z)
      for (std::size_t y = 0; y < kRows; ++y) open_[z][y] &= ~solid_[z][y];
  }

  /// Faces of the cells with a coordinate along an axis, on its lower or upper side: rows along the
  /// later of the other axes, bits along the earlier.
  Plane faces(int axis, bool upper, int at) const {
    Plane plane{};
    const auto o = static_cast<std::size_t>(at) + 1;
    const std::size_t beyond = upper ? o + 1 : o - 1;
    for (std::size_t row = 1; row <= kSide; ++row) {
      std::uint64_t bits = 0;
      if (axis == 2)
        bits = solid_[o][row] & open_[beyond][row];
      else if (axis == 1)
        bits = solid_[row][o] & open_[row][beyond];
      else
        for (std::size_t y = 1; y <= kSide; ++y)
          bits |= (solid_[row][y] >> o & open_[row][y] >> beyond & 1) << y;
      plane[row - 1] = static_cast<std::uint32_t>(bits >> 1);
    }
    return plane;
  }

 private:
  static constexpr std::size_t kRows = kSide + 2;
  using Bits = std::array<std::array<std::uint64_t, kRows>, kRows>;

  void add_block(const EsdfMap& esdf, std::uint32_t slot, const BlockIndex& block,
                 const VoxelIndex& first, int cell_voxels) {
    const VoxelState* states = esdf.state.block(slot);
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (states[i] == VoxelState::kUnknown) continue;
      const VoxelIndex from_first = voxel_of(block, i) - first;
      if (std::min({from_first.x, from_first.y, from_first.z}) < 0) continue;
      const auto x = static_cast<std::size_t>(from_first.x / cell_voxels),
                 y = static_cast<std::size_t>(from_first.y / cell_voxels),
                 z = static_cast<std::size_t>(from_first.z / cell_voxels);
      if (std::max({x, y, z}) >= kRows) continue;
      (states[i] == VoxelState::kOccupied ? solid_ : open_)[z][y] |= std::uint64_t{1} << x;
    }
  }

  Bits solid_{}, open_{};
};

/// Quads of a cube; `corner`: its lowest cell, from that of all.
std::vector<SurfaceQuad> quads_of(const CubeCells& cells, const CubeIndex& corner) {
  std::vector<SurfaceQuad> quads;
  const std::array<int, 3> low = {corner.x, corner.y, corner.z};
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      for (int at = 0; at < kSide; ++at) {
        Plane plane = cells.faces(axis, upper, at);
        detail::merge_faces(plane, [&](int bit, int row, int width, int height) {
          std::array<int, 3> cell = low;
          cell[static_cast<std::size_t>(axis)] += at;
          cell[axis == 0 ? 1 : 0] += bit;
          cell[axis == 2 ? 1 : 2] += row;
          quads.push_back({static_cast<std::uint16_t>(cell[0]), static_cast<std::uint16_t>(cell[1]),
                           static_cast<std::uint16_t>(cell[2]),
                           static_cast<std::uint16_t>(2 * axis + upper),
                           static_cast<std::uint8_t>(width), static_cast<std::uint8_t>(height)});
        });
      }
  return quads;
}

/// Cubes in which something is occupied, in order.
std::vector<CubeIndex> cubes_of(const EsdfMap& esdf, int cell_voxels) {
  std::vector<CubeIndex> cubes;
  const auto floor_divided = [](int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); };
  const int blocks = kSide * cell_voxels / kBlockSide;
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot) {
    const VoxelState* states = esdf.state.block(slot);
    if (std::find(states, states + kBlockVoxels, VoxelState::kOccupied) == states + kBlockVoxels)
      continue;
    const BlockIndex& b = esdf.layout.block(slot);
    cubes.push_back(
        {floor_divided(b.x, blocks), floor_divided(b.y, blocks), floor_divided(b.z, blocks)});
  }
  std::sort(cubes.begin(), cubes.end());
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  return cubes;
}

bool fits(const CubeIndex& extent) {
  return std::max({extent.x, extent.y, extent.z}) < UINT16_MAX / kSide;
}

/// From the lowest to the highest cube.
std::pair<CubeIndex, CubeIndex> range_of(const std::vector<CubeIndex>& cubes) {
  if (cubes.empty()) return {};
  CubeIndex low = cubes.front(), high = low;
  for (const CubeIndex& c : cubes) {
    low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
  }
  return {low, high - low};
}

}  // namespace

SurfaceQuads merge_surface(const EsdfMap& esdf, int cell_voxels) {
  if (cell_voxels < 1 || !std::has_single_bit(static_cast<unsigned>(cell_voxels)))
    throw InputError("cell_voxels", "is no power of two", "give 1, 2, 4, ...");
  const std::vector<CubeIndex> cubes = cubes_of(esdf, cell_voxels);
  const auto [low, extent] = range_of(cubes);
  if (!fits(extent))
    throw InputError("cell_voxels", "is too small for a map as large", "give a larger one");
  std::vector<std::vector<SurfaceQuad>> parts(cubes.size());
  parallel_for_each_index(cubes.size(), [&, low = low](std::size_t i) {
    const CubeIndex from_low = cubes[i] - low;
    parts[i] = quads_of(CubeCells(esdf, cubes[i], cell_voxels),
                        {from_low.x * kSide, from_low.y * kSide, from_low.z * kSide});
  });
  const int side = kSide * cell_voxels;
  SurfaceQuads surface{cell_voxels, {low.x * side, low.y * side, low.z * side}, {}};
  for (const std::vector<SurfaceQuad>& part : parts)
    surface.quads.insert(surface.quads.end(), part.begin(), part.end());
  return surface;
}

SurfaceQuads merge_surface_within(const EsdfMap& esdf, std::size_t most) {
  for (int cell_voxels = 1;; cell_voxels *= 2) {
    const bool is_last = cell_voxels >= 1 << 15;
    if (!is_last && !fits(range_of(cubes_of(esdf, cell_voxels)).second)) continue;
    SurfaceQuads surface = merge_surface(esdf, cell_voxels);
    if (surface.quads.size() <= most || is_last) return surface;
  }
}

}  // namespace ridgeway
