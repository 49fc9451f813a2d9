// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/random_maps.hpp"

namespace ridgeway::testing {

inline constexpr double kPillarVoxel = 0.1, kPillarClearance = 0.2;  // metres

/// Which coordinate of an axis is drawn first: another hall for the same seed.
enum class DrawnFirst { kX, kY };

/// A low hall, 8 x 6 m, with at most so many pillars from floor to ceiling, their axes in `axes`
/// (metres). A robot of kPillarClearance passes between any two, and between them and the walls.
inline OccupancyMap pillars(unsigned seed, std::vector<Eigen::Vector2d>& axes,
                            std::size_t most = 12, DrawnFirst first = DrawnFirst::kY) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(1.0, 7.0), y(1.0, 5.0), radius(0.1, 0.5);
  std::vector<double> radii;
  axes.clear();
  for (int tries = 0; tries < 12 && axes.size() < most; ++tries) {
    Eigen::Vector2d axis = Eigen::Vector2d::Zero();  // or g++ takes it for unset
    if (first == DrawnFirst::kX) axis.x() = x(random);
    axis.y() = y(random);
    if (first == DrawnFirst::kY) axis.x() = x(random);
    const double r = radius(random);
    const double to_wall =
        std::min({axis.x() - 0.1, 7.9 - axis.x(), axis.y() - 0.1, 5.9 - axis.y()});
    bool clear = to_wall > r + 2.0 * kPillarClearance + 0.2;
    for (std::size_t i = 0; i < axes.size(); ++i)
      clear &= (axis - axes[i]).norm() > r + radii[i] + 2.0 * kPillarClearance + 0.4;
    if (!clear) continue;
    axes.push_back(axis);
    radii.push_back(r);
  }
  return make_map(kPillarVoxel, {0, 0, 0}, {79, 59, 7}, [&](const VoxelIndex& v) {
    if (v.x == 0 || v.y == 0 || v.z == 0 || v.x == 79 || v.y == 59 || v.z == 7)
      return VoxelState::kOccupied;
    const Point p = centre_of(v, kPillarVoxel);
    for (std::size_t i = 0; i < axes.size(); ++i)
      if ((p.head<2>() - axes[i]).norm() < radii[i]) return VoxelState::kOccupied;
    return VoxelState::kFree;
  });
}

/// By how much a segment turns around each vertical axis, turns.
inline Eigen::RowVectorXd turns(const Point& a, const Point& b,
                                const std::vector<Eigen::Vector2d>& axes) {
  Eigen::RowVectorXd angles(static_cast<Eigen::Index>(axes.size()));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Eigen::Vector2d u = a.head<2>() - axes[i], v = b.head<2>() - axes[i];
    angles[static_cast<Eigen::Index>(i)] =
        std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)) / (2.0 * std::numbers::pi);
  }
  return angles;
}

}  // namespace ridgeway::testing
