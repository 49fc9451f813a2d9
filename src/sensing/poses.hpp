// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// Where a camera is put at random: level, any heading, any place of a volume that keeps its
/// distance.
struct PoseSampling {
  Point low = Point::Zero(), high = Point::Zero();  ///< corners of the volume, metres
  double clearance = 0.5;                           ///< metres to the nearest surface
  std::size_t count = 200;
  std::uint64_t seed = 1;

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// The box between the planes along the axes, and, where there are none, around the solids.
/// Throws InputError for a world that has neither on some side.
PoseSampling sampling_inside(const World& world);

/// Pose (camera to world) of a level camera at a place; heading 0 looks along x, pi / 2 along y.
Eigen::Isometry3d level_pose(const Point& place, double heading);

/// Throws InputError where the volume has hardly any place with that clearance.
std::vector<Eigen::Isometry3d> sample_poses(const World& world, const PoseSampling& sampling);

}  // namespace ridgeway
