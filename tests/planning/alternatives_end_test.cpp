// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// That looking for alternatives comes to an end.
#include <gtest/gtest.h>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"

namespace ridgeway {
namespace {

const Point kFrom(0.5, 2.9, 0.4), kBeyondPillars(7.4, 3.1, 0.4);

/// Robots far smaller than a voxel are looked for as closely as voxels ask for.
TEST(Alternatives, OfATinyRobotComeToAnEnd) {
  std::vector<Eigen::Vector2d> axes;
  const Roadmap roadmap = build_roadmap(testing::pillars(0, axes), {.min_clearance = 1e-4}).roadmap;
  const Alternatives found = plan_alternatives(roadmap, kFrom, kBeyondPillars, 3);
  ASSERT_EQ(found.routes.size(), 3u);
  const FreeSpace space(roadmap.esdf);
  for (const PlanResult& route : found.routes) EXPECT_GE(space.clearance(route.waypoints), 1e-4);
}

TEST(Alternatives, ThatTimeCutShortAreNotComplete) {
  std::vector<Eigen::Vector2d> axes;
  const Roadmap roadmap =
      build_roadmap(testing::pillars(0, axes), {.min_clearance = testing::kPillarClearance})
          .roadmap;
  const Alternatives found =
      plan_alternatives(roadmap, kFrom, kFrom + Point(0.1, 0.0, 0.0), 3, {.time_limit = 1e-9});
  ASSERT_TRUE(found.ok());  // straight on
  EXPECT_FALSE(found.complete);
}

}  // namespace
}  // namespace ridgeway
