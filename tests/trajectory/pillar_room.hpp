// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "experiments/flight_judge.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "support/random_maps.hpp"

namespace ridgeway::testing {

inline constexpr double kVoxel = 0.1;  // metres

/// A room of 20 x 20 x 4 m with a pillar of 2 x 2 m in its middle.
inline const OccupancyMap& pillar_room() {
  static const OccupancyMap map =
      make_map(kVoxel, {0, 0, 0}, {199, 199, 39}, [](const VoxelIndex& v) {
        const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 199 || v.y == 199 || v.z == 39;
        const bool pillar = v.x >= 90 && v.x < 110 && v.y >= 90 && v.y < 110;
        return wall || pillar ? VoxelState::kOccupied : VoxelState::kFree;
      });
  return map;
}
inline const EsdfMap& esdf() {
  static const EsdfMap map = compute_esdf(pillar_room());
  return map;
}

/// Whether there is one, free and within the limits all along, by an independent judge.
inline void expect_flown(const TrajectoryResult& result, const std::vector<Point>& path,
                         const TrajectoryConfig& config) {
  static const FlightJudge judge(pillar_room(), UnknownPolicy::kObstacle);
  ASSERT_TRUE(result.ok()) << name_of(result.status);
  EXPECT_EQ(judge.judge(result, path.front(), path.back(), config).complaint, "");
  EXPECT_TRUE(config.motion.hold(result.peaks));
}

}  // namespace ridgeway::testing
