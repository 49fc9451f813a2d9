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
using detail::find_detour;

/// A room of 6 x 4 x 2 m with a box in its middle, 0.3 m along x, to 1.2 m above the floor.
EsdfMap room_with_box() {
  return compute_esdf(testing::make_map(0.1, {0, 0, 0}, {59, 39, 19}, [](const VoxelIndex& v) {
    const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 59 || v.y == 39 || v.z == 19;
    const bool box = v.x >= 28 && v.x < 31 && v.y >= 10 && v.y < 30 && v.z < 12;
    return wall || box ? VoxelState::kOccupied : VoxelState::kFree;
  }));
}

double length_over(const Point& a, const Point& corner, const Point& b) {
  return (corner - a).norm() + (b - corner).norm();
}

TEST(Detour, LeadsPastABoxWithinItsBudget) {
  const EsdfMap esdf = room_with_box();
  const FreeSpace space(esdf);
  const Point a(1.05, 2.0, 0.8), b(4.85, 2.0, 0.8);
  const double straight = (b - a).norm();
  const std::optional<Point> corner = find_detour(esdf, space, a, b, 0.1, 2.0 * straight);
  ASSERT_TRUE(corner);
  EXPECT_TRUE(space.is_free(a, *corner, 0.1));
  EXPECT_TRUE(space.is_free(*corner, b, 0.1));
  const double length = length_over(a, *corner, b);
  EXPECT_GT(length, straight);
  EXPECT_LT(length, 2.0 * straight);
  // A budget of its own length, or the straight line's: nothing.
  EXPECT_FALSE(find_detour(esdf, space, a, b, 0.1, length));
  EXPECT_FALSE(find_detour(esdf, space, a, b, 0.1, straight));
  EXPECT_FALSE(find_detour(esdf, space, a, a, 0.1, 1.0));
  // Too wide for any way past.
  EXPECT_FALSE(find_detour(esdf, space, a, b, 0.7, 2.0 * straight));
}

TEST(Detour, OfAFreeLineIsAPlaceOnIt) {
  const EsdfMap esdf = room_with_box();
  const FreeSpace space(esdf);
  const Point a(1.0, 0.5, 1.0), b(5.0, 0.5, 1.0);
  const std::optional<Point> place = find_detour(esdf, space, a, b, 0.2, 8.0);
  ASSERT_TRUE(place);
  EXPECT_NEAR(length_over(a, *place, b), 4.0, 1e-9);
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
