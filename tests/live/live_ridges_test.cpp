// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Ridges that follow a field are those of the field, stage by stage.
#include "live/live_ridges.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "support/random_changes.hpp"

namespace ridgeway {
namespace {

void expect_those_of(const detail::LiveRidges& ridges, const EsdfMap& esdf) {
  const VoxelMask traversable = traversable_voxels(esdf, ridges.radius);
  const VoxelMask gvd = compute_gvd(esdf, traversable, ridges.config);
  VoxelMask edges = extract_edges(esdf, gvd);
  EXPECT_TRUE(ridges.traversable == traversable);
  EXPECT_TRUE(ridges.gvd == gvd);
  EXPECT_TRUE(ridges.thick_edges == edges);
  EXPECT_EQ(ridges.traversable_count, traversable.count());
  EXPECT_EQ(ridges.gvd_count, gvd.count());
  EXPECT_EQ(ridges.thick_count, edges.count());
  thin(esdf.layout, edges);
  EXPECT_TRUE(ridges.edges == edges);
}

TEST(LiveRidges, AfterRandomChangesAreThoseOfTheField) {
  std::size_t members = 0, gone = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    detail::LiveField field(0.1, {}, {.max_distance = seed % 2 == 0 ? 0.8 : 3.0}, true);
    detail::LiveRidges ridges = {.radius = 0.05 + 0.05 * (seed % 3)};
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE(step);
      const auto changes = testing::random_changes(random, {-34, -20, -22}, {30, 34, 20});
      with_threads(1 + step % 2, [&] {
        apply_changes(field, changes);
        update_distances(field);
        update_traversable(ridges, field);
        update_edges(ridges, field);
      });
      expect_those_of(ridges, field.esdf);
      members += ridges.edges.count();
      gone += ridges.changed_thick.count();
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(members, 10000u);
  EXPECT_GT(gone, 10000u);
}

}  // namespace
}  // namespace ridgeway
