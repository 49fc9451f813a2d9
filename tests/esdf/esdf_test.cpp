// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/esdf.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "support/brute_force.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::all_obstacles;
using testing::random_map;

/// Obstacles that share y and z, by x.
struct Row {
  int y, z;
  std::vector<int> xs;
};
std::vector<Row> rows_of(const std::vector<VoxelIndex>& obstacles) {  // in (z, y, x) order
  std::vector<Row> rows;
  for (const VoxelIndex& o : obstacles) {
    if (rows.empty() || rows.back().y != o.y || rows.back().z != o.z)
      rows.push_back({o.y, o.z, {}});
    rows.back().xs.push_back(o.x);
  }
  return rows;
}

std::int64_t squared_along(int k) {
  const std::int64_t twice = std::max(2 * std::abs(k) - 1, 0);
  return twice * twice;
}

/// detail::plain_nearest, but that rows farther away than `claimed` are passed over: the result
/// equals the claim where it is right, and differs from it where it is not.
detail::PlainNearest nearest_within(const VoxelIndex& v, const std::vector<Row>& rows,
                                    std::int64_t claimed) {
  detail::PlainNearest nearest;
  for (const Row& row : rows) {
    const std::int64_t across = squared_along(row.y - v.y) + squared_along(row.z - v.z);
    if (across > claimed) continue;
    for (const int x : row.xs) {
      const std::int64_t squared = across + squared_along(x - v.x);
      if (squared < nearest.squared) nearest = {squared, {x, row.y, row.z}};
    }
  }
  return nearest;
}

void expect_equal_to_brute_force(const OccupancyMap& map, const EsdfConfig& config,
                                 const EsdfMap& esdf) {
  const std::vector<Row> rows = rows_of(all_obstacles(map, config.unknown));
  const double limit = config.max_distance / map.voxel_size * (1 + 1e-9);
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    const VoxelIndex v = esdf.layout.index_of(id);
    const detail::PlainNearest nearest = nearest_within(v, rows, esdf.squared[id]);
    if (nearest.squared == kNoSite ||
        std::sqrt(0.25 * static_cast<double>(nearest.squared)) > limit) {
      ASSERT_EQ(esdf.squared[id], kNoSite);
      continue;
    }
    ASSERT_EQ(esdf.squared[id], nearest.squared) << v.x << " " << v.y << " " << v.z;
    const SiteOffset o = esdf.site[id];
    ASSERT_EQ(v + (VoxelIndex{o.x, o.y, o.z}), nearest.site) << v.x << " " << v.y << " " << v.z;
  }
}

class EsdfOnRandomMaps : public ::testing::TestWithParam<UnknownPolicy> {};

TEST_P(EsdfOnRandomMaps, EqualsBruteForceOnEveryVoxelWithOneThreadAndTwo) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = random_map(seed);
    EsdfConfig config{.unknown = GetParam()};
    if (seed % 4 == 3) config.max_distance = 0.35;
    const EsdfMap one = with_threads(1, [&] { return compute_esdf(map, config); });
    const EsdfMap two = with_threads(2, [&] { return compute_esdf(map, config); });
    ASSERT_EQ(one.squared.values(), two.squared.values());
    ASSERT_EQ(one.site.values(), two.site.values());
    expect_equal_to_brute_force(map, config, one);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(BothPolicies, EsdfOnRandomMaps,
                         ::testing::Values(UnknownPolicy::kObstacle, UnknownPolicy::kIgnore));

TEST(Esdf, IsExactThroughSpaceThatIsNotAllocated) {
  // Two lonely obstacles and lonely free voxels, many blocks of nothing between them.
  OccupancyMap map;
  map.voxel_size = 0.1;
  map.layout = BlockLayout({{0, 0, 0}, {7, 3, -4}, {-5, 6, 2}, {1, -6, 1}});
  map.state = VoxelField<VoxelState>(map.layout);
  std::mt19937 random(5);
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    for (int i = 0; i < 40; ++i) map.state.block(slot)[random() % kBlockVoxels] = VoxelState::kFree;
  map.state[map.layout.find({3, 3, 3})] = VoxelState::kOccupied;
  map.state[map.layout.find({9, -45, 12})] = VoxelState::kOccupied;
  const EsdfConfig config{.unknown = UnknownPolicy::kIgnore};
  expect_equal_to_brute_force(map, config, compute_esdf(map, config));
}

TEST(Esdf, IsExactWhereFewBlocksLieScatteredAndUnknownIsIgnored) {
  // Sites far off over gaps, and on lattices that make ties; some policies bound the distance.
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    std::vector<BlockIndex> blocks;
    for (int i = 2 + below(8); i > 0; --i) blocks.push_back({below(6), below(6) - 3, below(6)});
    OccupancyMap map;
    map.voxel_size = 0.1;
    map.layout = BlockLayout(blocks);
    map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
    const int lattice = 1 + below(4);
    for (int i = 1 + below(6); i > 0; --i) {
      VoxelIndex v = map.layout.index_of(static_cast<VoxelId>(random() % map.state.size()));
      v = {v.x / lattice * lattice, v.y / lattice * lattice, v.z / lattice * lattice};
      if (const VoxelId id = map.layout.find(v); id != kNoVoxel)
        map.state[id] = VoxelState::kOccupied;
    }
    EsdfConfig config{.unknown = UnknownPolicy::kIgnore};
    if (seed % 3 == 2) config.max_distance = 0.1 * (1 + below(20));
    expect_equal_to_brute_force(map, config, compute_esdf(map, config));
    if (HasFatalFailure()) return;
  }
}

TEST(Esdf, AllocatesTheNeighboursOfKnownVoxelsWhereUnknownIsIgnored) {
  const OccupancyMap map = random_map(3);
  const EsdfMap esdf = compute_esdf(map, {.unknown = UnknownPolicy::kIgnore});
  std::size_t known = 0;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (esdf.state[id] == VoxelState::kUnknown) continue;
    ++known;
    for (int d = 0; d < 27; ++d) ASSERT_NE(esdf.layout.neighbour(id, d), kNoVoxel);
  }
  EXPECT_EQ(known, count_voxels(map).free + count_voxels(map).occupied);
}

TEST(Esdf, RefusesAPolicyThatIsNone) {
  EXPECT_THROW(compute_esdf(random_map(1), {.unknown = static_cast<UnknownPolicy>(7)}), InputError);
}

TEST(Esdf, RefusesAMaxDistanceThatIsNoLength) {
  for (const double bad : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(compute_esdf(random_map(1), {.max_distance = bad}), InputError);
}

TEST(Esdf, MapsThatWereMovedOrPutTogetherWrongAreRefused) {
  OccupancyMap map = testing::random_map(1, 16);
  const OccupancyMap moved = std::move(map);
  EXPECT_EQ(map.at({1, 1, 1}), VoxelState::kUnknown);  // NOLINT(bugprone-use-after-move)
  OccupancyMap without = moved;
  without.state = {};
  EXPECT_THROW(compute_esdf(without), InputError);
  OccupancyMap grown = moved;
  grown.layout.add(std::vector<BlockIndex>{{99, 99, 99}});
  EXPECT_THROW(compute_esdf(grown), InputError);
  // A view of what is gone once it is made.
  static_assert(!std::is_constructible_v<FreeSpace, EsdfMap>);
  static_assert(!std::is_constructible_v<FreeSpace, const EsdfMap&, FlightLimits>);
  static_assert(!std::is_constructible_v<FreeSpace, EsdfMap, const FlightLimits&, double, double>);
  static_assert(!std::is_constructible_v<Surroundings, EsdfMap>);
  static_assert(std::is_constructible_v<FreeSpace, const EsdfMap&>);
  static_assert(std::is_constructible_v<Surroundings, EsdfMap&>);
}

}  // namespace
}  // namespace ridgeway
