// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap/swept_triangle.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/esdf/esdf.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// Long fans, slim and wide, among few obstacles, so that many are free and many just not.
TEST(SweptTriangle, IsWhatItsSegmentsAreOneByOne) {
  constexpr double kRadius = 0.06;
  for (const auto unknown :
       {UnknownPolicy::kObstacle, UnknownPolicy::kFree, UnknownPolicy::kIgnore}) {
    std::size_t swept = 0, stopped = 0;
    for (unsigned seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(seed);
      std::mt19937 random(seed);
      const EsdfMap esdf = compute_esdf(testing::make_map(0.1, {0, 0, 0}, {63, 31, 31},
                                                          [&](const VoxelIndex&) {
                                                            return random() % 4000 == 0
                                                                       ? VoxelState::kOccupied
                                                                       : VoxelState::kFree;
                                                          }),
                                        {.unknown = unknown});
      const detail::RememberedSpace space(esdf, nullptr);
      const auto place = [&](double wide) {
        std::uniform_real_distribution<double> along(0.2, 6.2), across(1.6 - wide, 1.6 + wide);
        return Point(along(random), across(random), across(random));
      };
      for (int i = 0; i < 400; ++i) {
        const double wide = i % 2 == 0 ? 0.1 : 1.4;
        const detail::Fan fan(place(wide), place(wide), place(wide), kRadius);
        if (fan.steps < 32) continue;
        const bool plainly = detail::sweeps_plainly(space, kRadius, fan);
        ASSERT_EQ(detail::sweeps(space, kRadius, fan), plainly) << i;
        (plainly ? swept : stopped) += 1;
      }
    }
    EXPECT_GT(swept, 100u);
    EXPECT_GT(stopped, 100u);
  }
}

}  // namespace
}  // namespace ridgeway
