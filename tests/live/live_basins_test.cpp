// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Basins that follow a field are those of the field, whatever their numbers.
#include "live/live_basins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "support/random_changes.hpp"

namespace ridgeway {
namespace {

void change_at_random(std::mt19937& random, detail::LiveField& field, detail::LiveRidges& ridges,
                      detail::LiveBasins& basins, BasinNumbers& numbers) {
  apply_changes(field, testing::random_changes(random, {-34, -20, -22}, {30, 34, 20}));
  update_distances(field);
  update_traversable(ridges, field);
  update_basins(basins, numbers, field, ridges);
}

/// By voxel of a set, a number of its 26-connected part; zero for the others.
std::vector<std::uint32_t> flooded_parts(const BlockLayout& layout, const VoxelMask& voxels) {
  std::vector<std::uint32_t> part(layout.voxel_count());
  std::uint32_t count = 0;
  for (const VoxelId first : voxels.members(layout)) {
    if (part[first] != 0) continue;
    part[first] = ++count;
    for (std::vector<VoxelId> due{first}; !due.empty();) {
      const VoxelId id = due.back();
      due.pop_back();
      for (int d = 0; d < 27; ++d)
        if (const VoxelId n = layout.neighbour(id, d);
            n != kNoVoxel && voxels.test(n) && part[n] == 0) {
          part[n] = part[id];
          due.push_back(n);
        }
    }
  }
  return part;
}

/// That voxels have the same number of a part where floods reach one from the other, and parts
/// their blocks, boxes and tops.
void expect_parts(const detail::LiveBasins& basins, const BasinNumbers& numbers,
                  const detail::LiveField& field, const VoxelMask& traversable) {
  const BlockLayout& layout = field.esdf.layout;
  const std::vector<std::uint32_t> flooded = flooded_parts(layout, traversable);
  std::map<std::uint32_t, std::uint32_t> by_flood;
  std::map<std::uint32_t, std::set<std::uint32_t>> slots;
  for (const VoxelId id : traversable.members(layout)) {
    ASSERT_TRUE(basins.parts.has(numbers[id]));
    const std::uint32_t part = basins.parts.of_basin[numbers[id]];
    ASSERT_EQ(by_flood.try_emplace(flooded[id], part).first->second, part);
    slots[part].insert(id / kBlockVoxels);
  }
  ASSERT_EQ(by_flood.size(), slots.size());
  std::size_t there = 0;
  for (const detail::SpacePart& part : basins.parts.parts) there += part.top > 0 ? 1 : 0;
  ASSERT_EQ(there, slots.size());
  for (const auto& [number, expected] : slots) {
    const detail::SpacePart& part = basins.parts.parts[number];
    ASSERT_EQ(std::set(part.slots.begin(), part.slots.end()), expected);
    ASSERT_EQ(part.slots.size(), expected.size());
    std::uint32_t top = 0;
    for (const std::uint32_t slot : expected) {
      const BlockIndex& b = layout.block(slot);
      top = std::max(top, basins.ways.blocks[slot].top);
      ASSERT_TRUE(part.low.x <= b.x && part.low.y <= b.y && part.low.z <= b.z);
      ASSERT_TRUE(part.high.x >= b.x && part.high.y >= b.y && part.high.z >= b.z);
    }
    ASSERT_EQ(part.top, top);
  }
}

TEST(SpaceParts, AfterRandomChangesAreThoseThatFloodsFind) {
  std::size_t parts = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(1000 + seed);
    detail::LiveField field(0.1, {}, {.max_distance = 0.8}, true);
    detail::LiveRidges ridges = {.radius = 0.05 + 0.05 * (seed % 3)};
    detail::LiveBasins basins;
    BasinNumbers numbers;
    for (int step = 0; step < 30; ++step) {
      SCOPED_TRACE(step);
      change_at_random(random, field, ridges, basins, numbers);
      ASSERT_NO_FATAL_FAILURE(expect_parts(basins, numbers, field, ridges.traversable));
      parts += basins.parts.parts.size() - basins.parts.unused.size();
    }
  }
  EXPECT_GT(parts, 5000u);
}

TEST(LiveBasins, AfterRandomChangesAreThoseOfTheField) {
  std::size_t members = 0, gone = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    detail::LiveField field(0.1, {}, {.max_distance = seed % 2 == 0 ? 0.8 : 3.0}, true);
    detail::LiveRidges ridges = {.radius = 0.05 + 0.05 * (seed % 3)};
    detail::LiveBasins basins;
    BasinNumbers numbers;
    std::vector<VoxelId> before;
    for (int step = 0; step < 30; ++step) {
      SCOPED_TRACE(step);
      change_at_random(random, field, ridges, basins, numbers);
      const detail::Watershed live =
          watershed_of(basins, numbers, basins.ways.next, field, ridges.traversable);
      detail::Watershed fresh = detail::find_watershed(field.esdf, ridges.traversable);
      std::erase_if(fresh.critical, [&](const detail::CriticalVoxel& voxel) {
        return detail::higher_in_others(field.esdf.layout, fresh.basins.basin, voxel) == 0;
      });
      ASSERT_EQ(live.critical, fresh.critical);
      ASSERT_EQ(live.basins.not_simple_at_first_turn, fresh.basins.not_simple_at_first_turn);
      ASSERT_EQ(live.basins.next.values(), fresh.basins.next.values());
      for (const VoxelId id : ridges.traversable.members(field.esdf.layout))
        ASSERT_EQ(live.basins.peaks[live.basins.basin[id]],
                  fresh.basins.peaks[fresh.basins.basin[id]]);
      std::vector<VoxelId> peaks = live.basins.peaks, expected = fresh.basins.peaks;
      std::erase(peaks, kNoVoxel);
      std::sort(peaks.begin(), peaks.end());
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(peaks, expected);
      std::erase_if(before,
                    [&](VoxelId id) { return std::binary_search(peaks.begin(), peaks.end(), id); });
      gone += before.size();
      members += peaks.size();
      before = std::move(peaks);
    }
  }
  EXPECT_GT(members, 10000u);
  EXPECT_GT(gone, 80u);
}

}  // namespace
}  // namespace ridgeway
