// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "viewer/surface_quads.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using Face = std::tuple<int, int, int, int>;  // cell, in cells of the map's own lattice, and side

int floor_divided(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Every face between a solid and an open cell, voxel by voxel.
std::set<Face> plain_faces(const EsdfMap& esdf, int cell_voxels) {
  std::map<std::tuple<int, int, int>, VoxelState> cells;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (esdf.state[id] == VoxelState::kUnknown) continue;
    const VoxelIndex v = esdf.layout.index_of(id);
    VoxelState& cell =
        cells
            .try_emplace({floor_divided(v.x, cell_voxels), floor_divided(v.y, cell_voxels),
                          floor_divided(v.z, cell_voxels)},
                         VoxelState::kFree)
            .first->second;
    if (esdf.state[id] == VoxelState::kOccupied) cell = VoxelState::kOccupied;
  }
  std::set<Face> faces;
  for (const auto& [at, state] : cells) {
    if (state != VoxelState::kOccupied) continue;
    const auto [x, y, z] = at;
    for (int side = 0; side < 6; ++side) {
      const int step = side % 2 == 1 ? 1 : -1;
      const auto beside =
          cells.find({x + (side / 2 == 0 ? step : 0), y + (side / 2 == 1 ? step : 0),
                      z + (side / 2 == 2 ? step : 0)});
      if (beside != cells.end() && beside->second == VoxelState::kFree)
        faces.insert({x, y, z, side});
    }
  }
  return faces;
}

/// The faces of quads one by one; a face in two quads is a failure.
std::set<Face> faces_of(const SurfaceQuads& surface) {
  std::set<Face> faces;
  const int s = surface.cell_voxels;
  for (const SurfaceQuad& q : surface.quads)
    for (int across = 0; across < q.height; ++across)
      for (int along = 0; along < q.width; ++along) {
        const int axis = q.side / 2;
        const int x = q.x + (axis == 0 ? 0 : along);
        const int y = q.y + (axis == 0 ? along : axis == 1 ? 0 : across);
        const int z = q.z + (axis == 2 ? 0 : across);
        EXPECT_TRUE(faces
                        .insert({x + surface.low.x / s, y + surface.low.y / s,
                                 z + surface.low.z / s, q.side})
                        .second)
            << "a face is in two quads";
      }
  return faces;
}

EsdfMap random_esdf(unsigned seed) { return compute_esdf(testing::random_map(seed, 60)); }

TEST(SurfaceQuads, HoldEveryFaceOnce) {
  std::size_t all = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const EsdfMap esdf = random_esdf(seed);
    for (const int cell_voxels : {1, 2, 8}) {
      const SurfaceQuads surface = merge_surface(esdf, cell_voxels);
      const std::set<Face> expected = plain_faces(esdf, cell_voxels);
      all += expected.size();
      EXPECT_EQ(faces_of(surface), expected) << "seed " << seed << ", cells of " << cell_voxels;
      EXPECT_LE(surface.quads.size(), expected.size());
    }
  }
  EXPECT_GT(all, 10'000u);
}

TEST(SurfaceQuads, AreTheSameForAnyNumberOfThreads) {
  const EsdfMap esdf = random_esdf(7);
  const auto once = with_threads(1, [&] { return merge_surface(esdf).quads; });
  EXPECT_EQ(with_threads(4, [&] { return merge_surface(esdf).quads; }), once);
}

TEST(SurfaceQuads, GrowCoarserUntilTheyAreFewEnough) {
  const EsdfMap esdf = random_esdf(8);
  const std::size_t all = merge_surface(esdf).quads.size();
  EXPECT_EQ(merge_surface_within(esdf, all).cell_voxels, 1);
  const SurfaceQuads fewer = merge_surface_within(esdf, all - 1);
  EXPECT_GT(fewer.cell_voxels, 1);
  EXPECT_LT(fewer.quads.size(), all);
}

TEST(SurfaceQuads, RefuseCellsThatAreNoPowerOfTwo) {
  const EsdfMap esdf = random_esdf(9);
  for (const int cell_voxels : {0, -2, 3, 12})
    EXPECT_THROW(merge_surface(esdf, cell_voxels), InputError);
}

}  // namespace
}  // namespace ridgeway
