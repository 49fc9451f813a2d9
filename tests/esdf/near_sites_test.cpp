// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/near_sites.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/esdf/free_space.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

TEST(NearSites, AreNeverNearerThanWhatIsNearestAndHardlyEverAnother) {
  int asked = 0, same = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const OccupancyMap map =
        testing::make_map(0.1, {0, 0, 0}, {23, 23, 15}, [&](const VoxelIndex&) {
          return random() % 40 == 0 ? VoxelState::kOccupied : VoxelState::kFree;
        });
    const EsdfMap esdf = compute_esdf(
        map, {.unknown = seed % 2 == 0 ? UnknownPolicy::kObstacle : UnknownPolicy::kFree});
    const FreeSpace space(esdf);
    VoxelFinder finder(esdf.layout);
    std::uniform_real_distribution<double> across(0.05, 2.35), up(0.05, 1.55);
    for (int i = 0; i < 300; ++i) {
      const Point p(across(random), across(random), up(random));
      const double exact = space.distance(p) / esdf.voxel_size;
      const double found =
          std::sqrt(detail::squared_to_near_sites(esdf, finder, p / esdf.voxel_size));
      EXPECT_GE(found, exact - 1e-9);
      EXPECT_LE(found, exact + std::sqrt(3.0));  // to the nearest centre and back
      ++asked;
      same += found <= exact + 1e-9;
    }
  }
  EXPECT_GE(same, 0.99 * asked);
}

TEST(NearSites, AreNoneWhereDistancesEnd) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {31, 31, 31}, [](const VoxelIndex& v) {
    return v.x == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const EsdfMap esdf = compute_esdf(map, {.unknown = UnknownPolicy::kFree, .max_distance = 0.5});
  VoxelFinder finder(esdf.layout);
  EXPECT_TRUE(std::isinf(detail::squared_to_near_sites(esdf, finder, {20.0, 10.0, 10.0})));
  EXPECT_DOUBLE_EQ(detail::squared_to_near_sites(esdf, finder, {4.0, 10.0, 10.0}), 9.0);
}

}  // namespace
}  // namespace ridgeway
