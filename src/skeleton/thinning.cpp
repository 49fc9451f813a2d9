// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "parallel_deletion.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "simple_point.hpp"
#include "thin_among.hpp"

namespace ridgeway {
namespace {

/// A template: cells that must be background, and cells that must be foreground.
struct Template {
  Cube27 background = 0;
  Cube27 foreground = 0;
};

constexpr Cube27 cell(int x, int y, int z) { return 1u << direction_of({x, y, z}); }
constexpr Cube27 side(int axis, int value) { return detail::cells_where(axis, value); }
constexpr Cube27 face(int axis, int value) {
  return cell(axis == 0 ? value : 0, axis == 1 ? value : 0, axis == 2 ? value : 0);
}

constexpr std::array<Template, 38> make_templates() {
  std::array<Template, 38> all;
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis)  // A: a whole face empty, the voxel behind it full
    for (const int s : {-1, 1}) all[count++] = {side(axis, s), face(axis, -s)};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int su : {-1, 1})
      for (const int sv : {-1, 1}) {
        const Cube27 middle_u = side(u, 0), middle_v = side(v, 0);
        // B: the three columns around one edge of the cube empty, the two faces behind full
        all[count++] = {
            (side(u, su) & side(v, sv)) | (side(u, su) & middle_v) | (middle_u & side(v, sv)),
            face(u, -su) | face(v, -sv)};
        // D: in one plane exactly one diagonal cell full
        const Cube27 ring = side(axis, 0) & kCells26;
        const Cube27 diagonal = ring & side(u, su) & side(v, sv);
        all[count++] = {ring & ~diagonal, diagonal};
      }
  }
  for (int octant = 0; octant < 8; ++octant) {  // C: one octant empty, the three faces behind full
    const int x = octant & 1 ? 1 : -1, y = octant & 2 ? 1 : -1, z = octant & 4 ? 1 : -1;
    const Cube27 cells = (side(0, x) | side(0, 0)) & (side(1, y) | side(1, 0)) &
                         (side(2, z) | side(2, 0)) & kCells26;
    all[count++] = {cells, face(0, -x) | face(1, -y) | face(2, -z)};
  }
  return all;
}

constexpr std::array<Template, 38> kTemplates = make_templates();

}  // namespace

bool matches_deletion_template(Cube27 cube) {
  for (const Template& t : kTemplates)
    if ((cube & t.background) == 0 && (cube & t.foreground) == t.foreground) return true;
  return false;
}

void thin(const BlockLayout& layout, VoxelMask& voxels) {
  detail::thin_among(layout, voxels, voxels.members(layout));
}

namespace detail {

bool may_be_thinned(std::uint32_t pass, Cube27 cube) {
  return (pass > 0 || matches_deletion_template(cube)) && is_simple(cube) && !is_curve_end(cube);
}

void thin_among(const BlockLayout& layout, VoxelMask& voxels, std::vector<VoxelId> among,
                const ThinningRound& told) {
  for (std::uint32_t pass = 0; pass < kThinningPasses; ++pass) {
    delete_layers(
        layout, voxels, among, [&](VoxelId, Cube27 cube) { return may_be_thinned(pass, cube); },
        [&](std::uint32_t round, const std::vector<VoxelId>& deleted) {
          if (told) told(pass, round, deleted);
        });
    std::erase_if(among, [&](VoxelId id) { return !voxels.test(id); });
  }
}

}  // namespace detail

}  // namespace ridgeway
