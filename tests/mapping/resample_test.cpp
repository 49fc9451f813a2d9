// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>

#include "mapping/random_map.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"

namespace ridgeway {
namespace {

/// Ratio of voxel sizes p / q, so that overlaps can be told in whole numbers.
struct Ratio {
  int p;
  int q;
};

/// Fine voxels f with length in common with coarse voxel c: f < (c + 1) p / q and f + 1 > c p / q.
VoxelRange fine_voxels(const VoxelIndex& coarse, Ratio ratio) {
  const auto low = [ratio](int c) {
    return static_cast<int>(std::floor(static_cast<double>(c * ratio.p) / ratio.q));
  };
  const auto high = [ratio](int c) {
    const int above = (c + 1) * ratio.p;  // the last f with f q < above
    return static_cast<int>(std::floor(static_cast<double>(above - 1) / ratio.q));
  };
  return {{low(coarse.x), low(coarse.y), low(coarse.z)},
          {high(coarse.x), high(coarse.y), high(coarse.z)}};
}

VoxelState brute_force(const OccupancyMap& fine, const VoxelIndex& coarse, Ratio ratio) {
  bool occupied = false, unknown = false;
  testing::for_each_in(fine_voxels(coarse, ratio), [&](const VoxelIndex& v) {
    occupied |= testing::state_at(fine, v) == VoxelState::kOccupied;
    unknown |= testing::state_at(fine, v) == VoxelState::kUnknown;
  });
  return occupied ? VoxelState::kOccupied : unknown ? VoxelState::kUnknown : VoxelState::kFree;
}

TEST(Resample, EqualsTheDefinitionAtAnyRatio) {
  for (const Ratio ratio :
       {Ratio{2, 1}, {3, 1}, {8, 1}, {5, 4}, {3, 2}, {9, 4}, {10, 3}, {101, 100}}) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      const OccupancyMap fine = testing::clumped_map(seed, 0.05);
      const double size = 0.05 * ratio.p / ratio.q;
      const OccupancyMap coarse = resample(fine, size);
      EXPECT_NEAR(coarse.voxel_size, size, 1e-12);
      const int reach = 40 * ratio.q / ratio.p + 2;
      testing::for_each_in(
          {{-reach, -reach, -reach}, {reach, reach, reach}}, [&](const VoxelIndex& v) {
            ASSERT_EQ(testing::state_at(coarse, v), brute_force(fine, v, ratio))
                << ratio.p << '/' << ratio.q << " at " << v.x << ' ' << v.y << ' ' << v.z;
          });
    }
  }
}

TEST(Resample, NeverLosesAnObstacle) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double ratio = 1.0 + 0.173 * seed;
    const OccupancyMap fine = testing::clumped_map(seed, 0.1);
    const OccupancyMap coarse = resample(fine, 0.1 * ratio);
    testing::for_each_known(fine, [&](const VoxelIndex& v, VoxelState state) {
      if (state != VoxelState::kOccupied) return;
      for (int corner = 0; corner < 8; ++corner) {  // just inside each corner of its cube
        const Point p = 0.1 * (Point(v.x, v.y, v.z) + Point(corner & 1 ? 1 - 1e-6 : 1e-6,
                                                            corner & 2 ? 1 - 1e-6 : 1e-6,
                                                            corner & 4 ? 1 - 1e-6 : 1e-6));
        EXPECT_EQ(testing::state_at(coarse, voxel_at(p, coarse.voxel_size)), VoxelState::kOccupied);
      }
    });
  }
}

TEST(Resample, WholeRatiosAreNotSpoiledByRounding) {
  // 0.15 / 0.05 is a little less than 3 and 0.3 / 0.1 too; far out this would shift the planes.
  for (const double size : {0.15, 0.05 * (3 + 1e-8), 0.3}) {
    OccupancyBuilder builder(0.05);
    builder.fill({{299'970, 3, 3}, {299'999, 8, 8}}, VoxelState::kFree);
    builder.set({299'999, 3, 3}, VoxelState::kOccupied);
    const OccupancyMap coarse = resample(std::move(builder).finish(), size);
    EXPECT_EQ(count_voxels(coarse).occupied, 1u) << size;
  }
}

TEST(Resample, TheOwnSizeChangesNothing) {
  const OccupancyMap map = testing::clumped_map(1);
  EXPECT_TRUE(testing::same_voxels(map, resample(map, 0.1)));
  EXPECT_TRUE(testing::same_voxels(map, resample(map, 0.1 * (1 + 1e-9))));
}

TEST(Resample, HugeVoxelsAreQuick) {
  OccupancyMap map = testing::clumped_map(1);
  EXPECT_GT(count_voxels(resample(map, 1e5)).occupied, 0u);
}

TEST(Resample, RefusesFinerAndNonsense) {
  const OccupancyMap map = testing::clumped_map(1);
  for (const double size : {0.0999, 0.0, -1.0, 5e7, 1e300, std::nan(""), HUGE_VAL})
    EXPECT_THROW(resample(map, size), InputError) << size;
}

}  // namespace
}  // namespace ridgeway
