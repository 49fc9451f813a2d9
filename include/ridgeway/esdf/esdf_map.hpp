// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// What unknown space is to the robot.
enum class UnknownPolicy : std::uint8_t {
  kObstacle = 0,  ///< as solid as a wall: a sphere of the robot's radius never reaches into it
  kIgnore = 1,    ///< pushes no distances, but a path stays in known-free voxels
};

/// Throws InputError where a policy is no enumerator.
void validate_policy(UnknownPolicy policy);

/// Offset from a voxel to its nearest site, voxels.
struct SiteOffset {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 0;
  friend constexpr bool operator==(const SiteOffset&, const SiteOffset&) = default;
};

/// Squared distance from a voxel's centre to the closed cube at an offset, as the integer
/// 4 d^2 / s^2 = sum over the axes of max(2 |k| - 1, 0)^2.
constexpr std::uint32_t quarter_squared(int k) {
  const int twice = 2 * (k < 0 ? -k : k) - (k != 0);  // no branch: zero is hard to foresee
  return static_cast<std::uint32_t>(twice) * static_cast<std::uint32_t>(twice);
}
constexpr std::uint32_t quarter_squared(const SiteOffset& o) {
  return quarter_squared(o.x) + quarter_squared(o.y) + quarter_squared(o.z);
}

/// Longest distance that is ever stored, voxels; farther voxels have no site.
inline constexpr int kFarthestSite = 16000;
/// `squared` of a voxel without a site.
inline constexpr std::uint32_t kNoSite = 0xffffffffu;

/// Euclidean distance field over the blocks of a map (method: exact distances from voxel centres
/// to closed obstacle cubes; ties between sites go to the smallest (z, y, x)).
/// Obstacles are occupied voxels and, under UnknownPolicy::kObstacle, unknown ones, allocated or
/// not. Invariants: obstacle voxels have `squared` 0 and `site` {0,0,0}; a voxel farther than
/// `max_distance` from every obstacle has `squared` kNoSite.
struct EsdfMap {
  double voxel_size = 0.0;  ///< metres
  VoxelIndex origin = {};   ///< the lattice's voxel that is the map's own (0, 0, 0); to_world()
  UnknownPolicy unknown = UnknownPolicy::kObstacle;
  double max_distance = std::numeric_limits<double>::infinity();  ///< metres
  BlockLayout layout;
  VoxelField<VoxelState> state;
  VoxelField<std::uint32_t> squared;  ///< 4 d^2 / voxel_size^2
  VoxelField<SiteOffset> site;
  VoxelMask obstacle;

  bool is_obstacle(VoxelId id) const {
    return id == kNoVoxel ? unknown == UnknownPolicy::kObstacle : obstacle.test(id);
  }
  /// Distance from a voxel's centre to the nearest obstacle cube, metres; infinite without a site.
  double distance(VoxelId id) const {
    return squared[id] == kNoSite ? std::numeric_limits<double>::infinity()
                                  : 0.5 * voxel_size * std::sqrt(static_cast<double>(squared[id]));
  }
};

/// Smallest value of 4 d^2 / s^2 at which a voxel counts as free at a radius: inclusive, with a
/// relative slack of 1e-9 on the radius, so that r / s a whole number is no matter of rounding.
inline double squared_threshold(double radius, double voxel_size) {
  const double r = radius * (1.0 - 1e-9) / voxel_size;
  return 4.0 * r * r;
}

}  // namespace ridgeway
