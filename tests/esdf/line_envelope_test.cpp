// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/line_envelope.hpp"

#include <gtest/gtest.h>

#include <random>

#include "esdf/distance_sweeps.hpp"
#include "esdf/plain_envelope.hpp"
#include "support/plain_sites.hpp"

namespace ridgeway {
namespace {

using detail::LineCandidate;

TEST(LineEnvelope, CrossingIsTheFirstPositionThatIsNearerToTheOther) {
  for (std::int64_t apart = 1; apart <= 12; ++apart) {
    const std::int64_t most = (2 * apart - 1) * (2 * apart - 1) + 8 * apart * 20;
    for (std::int64_t t = -most; t <= most; ++t) {
      const LineCandidate a{-3, most + t}, b{-3 + static_cast<int>(apart), most};
      std::int64_t first = -60;
      while (!detail::is_nearer(b, a, first)) ++first;
      ASSERT_EQ(detail::crossing(a, b), first) << apart << " " << t;
      if (apart == 1) {
        ASSERT_EQ(detail::crossing_of_neighbours(a, b), first) << t;
      }
    }
  }
}

/// What lies across a line, as the sweeps find it: anything, few values, or the slopes of
/// distances.
std::uint32_t random_cost(unsigned seed, std::mt19937& random) {
  const auto below = [&](unsigned n) { return static_cast<std::uint32_t>(random() % n); };
  if (below(5) < seed / 4 % 5) return kNoSite;
  if (seed % 4 == 0) return 1 + below(4);
  if (seed % 4 == 1) return 1 + below(2000);
  return squared_halves(1 + static_cast<int>(below(seed % 4 == 2 ? 4 : 40)));
}

TEST(LineEnvelope, WinnersOfARunAreTheNearestCandidatesAndOfEqualOnesTheLeftmost) {
  std::size_t positions = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    std::mt19937 random(seed);
    const int first = static_cast<int>(random() % 20);
    const int end = first + 1 + static_cast<int>(random() % 40);
    std::vector<std::uint32_t> cost(static_cast<std::size_t>(end) + 1);
    for (std::uint32_t& c : cost) c = random_cost(seed, random);
    cost.back() = random() % 2 == 0 ? 0 : kNoSite;  // an obstacle, or the end of the line
    std::vector<LineCandidate> candidates;
    detail::LineEnvelope envelope(cost.size());
    envelope.begin(first, end - 1);
    if (random() % 2 == 0) {
      candidates.push_back({first - 1, 0});
      envelope.add(candidates.back());
    }
    for (int i = first; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (cost[at] == kNoSite) continue;
      candidates.push_back({i, cost[at]});
      envelope.add_before(candidates.back(), cost[at + 1]);
    }
    if (cost.back() == 0) {
      candidates.push_back({end, 0});
      envelope.add(candidates.back());
    }
    int next = first;
    envelope.for_each_stretch([&](int from, int to, int winner) {
      ASSERT_EQ(from, next);
      for (; next < to; ++next, ++positions)
        ASSERT_EQ(winner, detail::plain_winner(candidates, next)) << "seed " << seed;
    });
    ASSERT_EQ(next, candidates.empty() ? first : end);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(positions, 200000u);
}

/// Sites of scattered blocks, all around them obstacle: at random, or on a lattice, where many are
/// equally near.
TEST(DistanceSweeps, FindTheFirstOfTheNearestObstaclesWhateverBlocksThereAre) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<BlockIndex> blocks;
    for (int i = 0; i < 5; ++i)
      blocks.push_back({static_cast<int>(random() % 3) - 1, static_cast<int>(random() % 2),
                        static_cast<int>(random() % 2) - 1});
    const BlockLayout layout(blocks);
    VoxelMask obstacle(layout);
    std::vector<VoxelIndex> obstacles;
    for (int z = -9; z <= 8; ++z)
      for (int y = -1; y <= 16; ++y)
        for (int x = -9; x <= 16; ++x) {
          const VoxelId id = layout.find({x, y, z});
          const bool is_chosen =
              seed % 2 == 0 ? random() % 200 < seed : x % 4 == 0 && y % 3 == 0 && z % 4 == 0;
          if (id != kNoVoxel && !is_chosen) continue;
          if (id != kNoVoxel) obstacle.set(id);
          obstacles.push_back({x, y, z});
        }
    const detail::NearestSites nearest = detail::sweep_distances(layout, obstacle, true);
    for (VoxelId id = 0; id < layout.voxel_count(); ++id)
      ASSERT_TRUE(testing::has_plain_site(layout, nearest, id, obstacles));
  }
}

}  // namespace
}  // namespace ridgeway
