// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/unknown_share.hpp"

#include <gtest/gtest.h>

#include <array>

#include "ridgeway/esdf/esdf.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// A room, 6 m along x, whose floor was seen up to x = 2 m; nothing else around it was.
EsdfMap half_seen_room() {
  return compute_esdf(testing::make_map(0.1, {0, 0, 0}, {59, 39, 39}, [](const VoxelIndex& v) {
    if (v.z == 0) return v.x < 20 ? VoxelState::kOccupied : VoxelState::kUnknown;
    return VoxelState::kFree;
  }));
}

TEST(UnknownShare, IsThePartOfThePathBesideWhatWasNeverSeen) {
  const EsdfMap esdf = half_seen_room();
  const auto share = [&](double from, double to) {
    const std::array<Point, 3> path{Point(from, 2.0, 0.5), Point(0.5 * (from + to), 2.0, 0.5),
                                    Point(to, 2.0, 0.5)};
    return unknown_share(esdf, path);
  };
  EXPECT_EQ(share(0.75, 1.75), 0.0);
  EXPECT_EQ(share(2.75, 5.25), 1.0);
  EXPECT_NEAR(share(0.75, 4.75), 0.69, 0.2);  // from looks 0.8 m apart
  EXPECT_EQ(unknown_share(esdf, {}), 0.0);
}

}  // namespace
}  // namespace ridgeway
