// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/measured_moves.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "esdf/remembered_space.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "support/random_maps.hpp"

namespace ridgeway::detail {
namespace {

TEST(MeasuredMoves, AreAllThatTakeALookBetweenTheirVoxels) {
  std::size_t measured = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed, 26), {});
    const BlockLayout& layout = esdf.layout;
    VoxelMask traversable(layout), among(layout);
    for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
      if (!esdf.is_open(id)) continue;
      traversable.set(id);
      if (mixed(id) % 3 != 0) among.set(id);
    }
    const FreeSpace space(esdf);
    const RememberedSpace plain(esdf, nullptr);
    const MeasuredMoves moves(plain, among);
    const RememberedSpace known(esdf, nullptr, &moves);
    for (const VoxelId id : traversable.members(layout))
      for (Cube27 cube = cube_around(layout, traversable, id) & kCells26; cube != 0;
           cube &= cube - 1) {
        const int d = std::countr_zero(cube);
        const VoxelId other = layout.neighbour(id, d);
        ASSERT_EQ(known.move_clearance(id, other, d), space.move_clearance(id, other, d));
        if (d < kCentre) continue;
        const double* found = moves.find(move_from(id, d));
        ASSERT_EQ(found != nullptr,
                  among.test(id) && among.test(other) && !plain.is_level(id, other, d));
        if (found == nullptr) continue;
        ASSERT_EQ(*found, space.move_clearance(id, other, d).value);
        ++measured;
      }
  }
  EXPECT_GT(measured, 500u);
}

}  // namespace
}  // namespace ridgeway::detail
