// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "planning/detour.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/index.hpp"
#include "support/pillars.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::Deadline;
using detail::Detour;
using detail::find_detour;

/// A room of 6 x 4 x 2 m with a box in its middle, 0.3 m along x, to 1.6 m above the floor.
EsdfMap room_with_box() {
  return compute_esdf(testing::make_map(0.1, {0, 0, 0}, {59, 39, 19}, [](const VoxelIndex& v) {
    const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 59 || v.y == 39 || v.z == 19;
    const bool box = v.x >= 28 && v.x < 31 && v.y >= 10 && v.y < 30 && v.z < 16;
    return wall || box ? VoxelState::kOccupied : VoxelState::kFree;
  }));
}

/// A way from a over corners to b is free, and as long as it says.
void expect_free(const FreeSpace& space, const Point& a, const Detour& detour, const Point& b,
                 double radius) {
  std::vector<Point> way{a};
  way.insert(way.end(), detour.corners.begin(), detour.corners.end());
  way.push_back(b);
  for (std::size_t i = 1; i < way.size(); ++i)
    EXPECT_TRUE(space.is_free(way[i - 1], way[i], radius));
  EXPECT_NEAR(length_of(way), detour.length, 1e-9);
}

TEST(Detour, LeadsPastABoxWithinItsBudgetAndItsCorners) {
  const EsdfMap esdf = room_with_box();
  const FreeSpace space(esdf);
  const Point a(1.05, 2.0, 0.8), b(4.95, 2.0, 0.8);
  const double straight = (b - a).norm();
  const Detour one = find_detour(esdf, space, a, b, 0.2, 2.0 * straight, 1);
  const Detour two = find_detour(esdf, space, a, b, 0.2, 2.0 * straight, 2);
  ASSERT_TRUE(two.found());
  EXPECT_LE(one.corners.size(), 1u);
  EXPECT_LE(two.corners.size(), 2u);
  if (one.found()) expect_free(space, a, one, b, 0.2);
  expect_free(space, a, two, b, 0.2);
  EXPECT_LT(two.length, 2.0 * straight);
  EXPECT_GT(two.length, straight);
  // A budget below what it takes, or the straight line's own length: nothing.
  EXPECT_FALSE(find_detour(esdf, space, a, b, 0.2, 1.01 * straight, 2).found());
  EXPECT_FALSE(find_detour(esdf, space, a, b, 0.2, straight, 2).found());
  EXPECT_FALSE(find_detour(esdf, space, a, a, 0.2, 1.0, 2).found());
  // Too wide for any way past.
  EXPECT_FALSE(find_detour(esdf, space, a, b, 0.7, 2.0 * straight, 2).found());
}

TEST(Detour, OfAFreeLineIsALineWithAPlaceOnIt) {
  const EsdfMap esdf = room_with_box();
  const FreeSpace space(esdf);
  const Point a(1.0, 0.5, 1.0), b(5.0, 0.5, 1.0);
  const Detour detour = find_detour(esdf, space, a, b, 0.2, 8.0, 2);
  ASSERT_TRUE(detour.found());
  expect_free(space, a, detour, b, 0.2);
  EXPECT_NEAR(detour.length, 4.0, 1e-9);
}

TEST(Detour, RedirectedPathsAreFreeAndNeverLonger) {
  constexpr double kRadius = testing::kPillarClearance;
  int shorter = 0, same = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Eigen::Vector2d> axes;
    const EsdfMap esdf = compute_esdf(testing::pillars(seed, axes));
    const FreeSpace space(esdf);
    const std::vector<VoxelId> places = testing::traversable_places(esdf, kRadius);
    std::mt19937 random(seed);
    const auto place = [&] {
      return centre_of(esdf.layout.index_of(places[random() % places.size()]), esdf.voxel_size);
    };
    for (int i = 0; i < 200; ++i) {
      std::vector<Point> path{place()};
      for (int tries = 0; tries < 20 && path.size() < 5; ++tries)
        if (const Point next = place(); space.is_free(path.back(), next, kRadius))
          path.push_back(next);
      if (path.size() < 3) continue;
      const std::vector<Point> redirected =
          detail::redirect(esdf, space, path, kRadius, Deadline::never());
      ASSERT_EQ(redirected.front(), path.front());
      ASSERT_EQ(redirected.back(), path.back());
      for (std::size_t k = 1; k < redirected.size(); ++k)
        ASSERT_TRUE(space.is_free(redirected[k - 1], redirected[k], kRadius));
      const double before = length_of(path), after = length_of(redirected);
      ASSERT_LE(after, before * (1.0 + 1e-12));
      ++(after < before ? shorter : same);
      EXPECT_EQ(detail::redirect(esdf, space, path, kRadius, Deadline(-1.0)), path);  // no time
    }
  }
  EXPECT_GT(shorter, 300);
  EXPECT_GT(same, 0);
}

}  // namespace
}  // namespace ridgeway
