// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/block_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace ridgeway {
namespace {

double squared(const BlockIndex& p, const BlockIndex& first, const BlockIndex& last) {
  const auto off = [](double at, double low, double high) {
    return std::max({low - at, at - high, 0.0});
  };
  const double x = off(p.x, first.x, last.x), y = off(p.y, first.y, last.y),
               z = off(p.z, first.z, last.z);
  return x * x + y * y + z * z;
}

TEST(BlockTree, FindsWhatIsNearestOfAnyBlocksAndLooksAtFew) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const std::size_t count : {0, 1, 4, 5, 100, 3000}) {
    SCOPED_TRACE(count);
    std::mt19937 random(static_cast<unsigned>(count));
    const auto place = [&](int most) { return static_cast<int>(random() % (2 * most)) - most; };
    std::vector<BlockIndex> blocks(count);
    for (BlockIndex& b : blocks) b = {place(300), place(300), place(3)};
    const detail::BlockTree tree(blocks);
    EXPECT_EQ(tree.empty(), count == 0);
    std::size_t looks = 0;
    for (int i = 0; i < 200; ++i) {
      const BlockIndex p{place(2000), place(400), place(4)};
      const auto nearest = [&](double best) {
        return tree.search(
            best,
            [&](const BlockIndex& first, const BlockIndex& last) {
              return squared(p, first, last);
            },
            [&](const BlockIndex& block, double found) {
              ++looks;
              return std::min(found, squared(p, block, block));
            });
      };
      double expected = kNone;
      for (const BlockIndex& b : blocks) expected = std::min(expected, squared(p, b, b));
      EXPECT_EQ(nearest(kNone), expected);
      EXPECT_EQ(nearest(expected), expected);
      EXPECT_EQ(nearest(0.0), 0.0);
    }
    EXPECT_LE(looks, 200u * 40u);
  }
}

}  // namespace
}  // namespace ridgeway
