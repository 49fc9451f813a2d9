// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// A field that follows its map is the field of the map: the same distances and sites, whatever
// came and went.
#include "live/live_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ridgeway/common/parallel.hpp"
#include "support/random_changes.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::LiveField;

void expect_same(const LiveField& live, const EsdfMap& batch) {
  std::size_t different = 0;
  for (VoxelId id = 0; id < live.esdf.layout.voxel_count(); ++id) {
    const VoxelId same = batch.layout.find(live.esdf.layout.index_of(id));
    if (same == kNoVoxel) {
      EXPECT_EQ(live.known[id / kBlockVoxels], 0);
      continue;
    }
    different += live.esdf.squared[id] != batch.squared[same] ||
                 live.esdf.site[id] != batch.site[same] ||
                 live.esdf.obstacle.test(id) != batch.obstacle.test(same);
  }
  EXPECT_EQ(different, 0u);
}

std::vector<BlockIndex> missing(const LiveField& field, const BlockIndex& low,
                                const BlockIndex& high) {
  std::vector<BlockIndex> blocks = testing::blocks_of_box(low, high);
  std::erase_if(blocks, [&](const BlockIndex& b) {
    return field.esdf.layout.find_block(b) != BlockLayout::kNoBlock;
  });
  return blocks;
}

/// Whether all sites of small maps are near.
bool is_near(const EsdfConfig& config) {
  return config.unknown == UnknownPolicy::kObstacle || !std::isinf(config.max_distance);
}

struct Case {
  UnknownPolicy unknown;
  double max_distance;
};

class LiveFieldOf : public ::testing::TestWithParam<Case> {};

TEST_P(LiveFieldOf, RandomChangesIsThatOfABatchBuild) {
  const EsdfConfig config{GetParam().unknown, GetParam().max_distance};
  const bool is_slow = config.unknown == UnknownPolicy::kIgnore;  // the batch build
  for (unsigned seed = 0; seed < (is_slow ? 10u : 60u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    LiveField field(0.1, {}, config, is_near(config) && seed % 4 != 0);
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE(step);
      const int reach = 1 + step / 4;                // blocks, from the origin: the map grows
      if (config.unknown == UnknownPolicy::kIgnore)  // sweeps pass through all of them
        add_blocks(field, missing(field, {-reach, -reach, -reach}, {reach, reach, reach - 1}));
      const auto changes =
          testing::random_changes(random, {-8 * reach + 1, -8 * reach, -8 * reach + 3},
                                  {8 * reach, 8 * reach + 5, 8 * reach});
      with_threads(1 + step % 2, [&] {
        apply_changes(field, changes);
        update_distances(field);
      });
      expect_same(field, compute_esdf(map_of(field), config));
      if (HasFailure()) return;
    }
  }
}

TEST_P(LiveFieldOf, AWholeMapIsThatOfABatchBuild) {
  const EsdfConfig config{GetParam().unknown, GetParam().max_distance};
  const bool is_slow = config.unknown == UnknownPolicy::kIgnore;
  for (unsigned seed = 0; seed < (is_slow ? 8u : 40u); ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, seed % 5 == 0 ? 60 : 24);
    LiveField field(map.voxel_size, {}, config, is_near(config) && seed % 4 != 0);
    if (config.unknown == UnknownPolicy::kIgnore)
      add_blocks(field, testing::blocks_of_box({-4, -4, -4}, {11, 11, 11}));
    apply_changes(field, testing::changes_to(map));
    update_distances(field);
    expect_same(field, compute_esdf(map_of(field), config));
    if (HasFailure()) return;
  }
}

/// A row of blocks along each axis with an obstacle at its end, or none.
TEST(LiveField, SaysWhereNearSitesNoLongerDo) {
  const EsdfConfig config{UnknownPolicy::kIgnore, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis)
    for (const int blocks : {16, 17}) {
      SCOPED_TRACE(axis);
      LiveField near(0.1, {}, config, true), any(0.1, {}, config, false);
      const BlockIndex last{axis == 0 ? blocks - 1 : 0, axis == 1 ? blocks - 1 : 0,
                            axis == 2 ? blocks - 1 : 0};
      for (LiveField* field : {&near, &any}) {
        add_blocks(*field, testing::blocks_of_box({0, 0, 0}, last));
        apply_changes(*field, std::vector<VoxelChange>{{{0, 0, 0}, VoxelState::kOccupied}});
        update_distances(*field);
      }
      EXPECT_FALSE(any.is_outgrown);
      EXPECT_EQ(near.is_outgrown, blocks == 17);
      if (!near.is_outgrown) EXPECT_TRUE(near.esdf.site.values() == any.esdf.site.values());
    }
}

INSTANTIATE_TEST_SUITE_P(
    Policies, LiveFieldOf,
    ::testing::Values(Case{UnknownPolicy::kObstacle, std::numeric_limits<double>::infinity()},
                      Case{UnknownPolicy::kObstacle, 0.55}, Case{UnknownPolicy::kObstacle, 1.0},
                      Case{UnknownPolicy::kIgnore, std::numeric_limits<double>::infinity()},
                      Case{UnknownPolicy::kIgnore, 0.7}));

}  // namespace
}  // namespace ridgeway
