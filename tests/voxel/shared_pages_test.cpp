// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <utility>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {
namespace {

using Pages = detail::SharedPages<std::uint32_t>;

TEST(SharedPages, CopiesAreArraysOfTheirOwn) {
  std::mt19937 random(1);
  std::vector<Pages> arrays(1);
  std::vector<std::vector<std::uint32_t>> expected(1);
  for (int step = 0; step < 4000; ++step) {
    const std::size_t i = random() % arrays.size();
    switch (random() % 8) {
      case 0:
        arrays[i].grow(static_cast<std::uint32_t>(expected[i].size() + random() % 40));
        expected[i].resize(arrays[i].size());
        break;
      case 1:
        arrays.push_back(arrays[i]);
        expected.push_back(expected[i]);
        break;
      case 2: {
        const std::size_t k = random() % arrays.size();
        arrays[k] = arrays[i];
        expected[k] = expected[i];
        break;
      }
      case 3:
        if (arrays.size() > 5) {
          arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(i));
          expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(i));
        }
        break;
      default:
        if (!expected[i].empty()) {
          const std::size_t slot = random() % expected[i].size();
          arrays[i].own(static_cast<std::uint32_t>(slot)) = expected[i][slot] = step + 1u;
        }
    }
    for (std::size_t k = 0; k < arrays.size(); ++k) {
      ASSERT_EQ(arrays[k].size(), expected[k].size());
      for (std::uint32_t slot = 0; slot < arrays[k].size(); ++slot)
        ASSERT_EQ(std::as_const(arrays[k])[slot], expected[k][slot]) << step;
    }
  }
}

TEST(SharedPages, TakeMemoryOnlyForWhatIsAnother) {
  Pages first;
  first.grow(64 * 1000);
  const std::size_t empty = first.memory_bytes();
  EXPECT_LT(empty, 64u * 1000u);
  for (std::uint32_t slot = 0; slot < first.size(); slot += 64) first.own(slot) = slot;
  EXPECT_GE(first.memory_bytes(), 64u * 1000u * sizeof(std::uint32_t));
  const auto alive = std::make_shared<int>(3);
  detail::SharedPages<std::shared_ptr<int>> owners;
  owners.grow(100);
  owners.own(3) = alive;
  auto copy = owners;
  EXPECT_EQ(alive.use_count(), 2);  // one page for both
  copy.own(4) = alive;
  EXPECT_EQ(alive.use_count(), 4);
  owners = {};
  EXPECT_EQ(alive.use_count(), 3);
  copy = {};
  EXPECT_EQ(alive.use_count(), 1);
}

TEST(SharedPages, AnyThreadMayMakeAPageItsArraysOwn) {
  for (int repeat = 0; repeat < 50; ++repeat) {
    Pages first;
    first.grow(64 * 20);
    for (std::uint32_t slot = 0; slot < first.size(); slot += 2) first.own(slot) = 7;
    Pages second = first;
    with_threads(2, [&] {
      parallel_for_each_index(
          second.size(),
          [&](std::size_t slot) {
            second.own(static_cast<std::uint32_t>(slot)) = static_cast<std::uint32_t>(slot);
          },
          1);
      return 0;
    });
    for (std::uint32_t slot = 0; slot < first.size(); ++slot) {
      ASSERT_EQ(std::as_const(first)[slot], slot % 2 == 0 ? 7u : 0u);
      ASSERT_EQ(std::as_const(second)[slot], slot);
    }
  }
}

}  // namespace
}  // namespace ridgeway
