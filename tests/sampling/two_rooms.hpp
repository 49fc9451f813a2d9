// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <limits>

#include "ridgeway/sampling/plan_by_sampling.hpp"
#include "support/random_maps.hpp"

namespace ridgeway::testing {

inline constexpr std::array kSamplers{Planner::kRrtStar, Planner::kRrtConnect, Planner::kBitStar,
                                      Planner::kPrmStar, Planner::kInformedRrtStar};
inline constexpr double kForever = std::numeric_limits<double>::infinity();

/// 6 x 4 x 2 m, voxels of 0.1 m; a wall across the middle, up to 3.4 m along y if not `shut`.
inline OccupancyMap two_rooms(bool shut) {
  return make_map(0.1, {0, 0, 0}, {59, 39, 19}, [shut](const VoxelIndex& v) {
    return v.x / 2 == 15 && (shut || v.y < 34) ? VoxelState::kOccupied : VoxelState::kFree;
  });
}
inline const Point kLeft(1.0, 1.0, 1.0), kRight(5.0, 1.0, 1.0);
inline constexpr double kRadius = 0.2;

inline SamplingConfig limited(Planner planner, std::size_t iterations, std::uint64_t seed = 1) {
  return {.planner = planner,
          .radius = kRadius,
          .seed = seed,
          .time_limit = kForever,
          .iteration_limit = iterations};
}

/// BIT* counts the edges that it looks at, the others samples.
inline std::size_t iterations_of(Planner planner, std::size_t samples) {
  return planner == Planner::kBitStar ? 12 * samples : samples;
}

}  // namespace ridgeway::testing
