// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "voxel/flat_table.hpp"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

namespace ridgeway {
namespace {

/// Good hashes, and ones by which many keys want the same place.
TEST(FlatTable, HoldsWhatAMapHoldsThroughAddingErasingAndClearing) {
  std::size_t most = 0, erased = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 generator(seed);
    const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
    const auto hash = [&](std::uint32_t key) {
      return seed % 2 == 0 ? detail::mixed(key) : std::uint64_t{key % 7};
    };
    detail::FlatTable<std::uint32_t, int> table;
    std::unordered_map<std::uint32_t, int> map;
    const unsigned keys = 1 + random() % 400;
    for (int step = 0; step < 5000; ++step) {
      const std::uint32_t key = random() % keys;
      const auto known = map.find(key);
      const int* found = table.find(key, hash(key));
      ASSERT_EQ(found != nullptr, known != map.end());
      if (found != nullptr) {
        ASSERT_EQ(*found, known->second);
        map.erase(known);
        table.erase(key, hash(key));
        ++erased;
      } else {
        map.emplace(key, step);
        table.add(key, hash(key), step);
      }
      if (random() % 2000 == 0) {
        map.clear();
        table.clear();
      }
      ASSERT_EQ(table.size(), map.size());
      most = std::max(most, map.size());
    }
  }
  EXPECT_GT(most, 100u);
  EXPECT_GT(erased, 10000u);
}

}  // namespace
}  // namespace ridgeway
