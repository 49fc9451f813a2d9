// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "support/cancelling.hpp"

#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

TEST(Cancelling, StopsBuildsAndChecksAtEveryStage) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {15, 15, 15},
                                             [](const VoxelIndex&) { return VoxelState::kFree; });
  const auto building = [&](const Progress& progress) {
    build_roadmap(map, {.min_clearance = 0.2}, progress);
  };
  EXPECT_EQ(testing::stages_to_stop(building), 9);  // before each of eight stages, and at the end
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.2}).roadmap;
  const auto checking = [&](const Progress& progress) {
    check_roadmap(roadmap, {.queries = 200}, progress);
  };
  EXPECT_EQ(testing::places_to_stop(checking), 5);  // before the edges and each 64 queries
}

}  // namespace
}  // namespace ridgeway
