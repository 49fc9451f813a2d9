// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway::detail {

/// A robot's radius, metres, less what points of the world may be off as their coordinates were
/// rounded: in UTM 3 nanometres. So what just fits in the map's local frame still does.
inline double radius_less_rounding(double radius, std::span<const Point> points_world) {
  constexpr double kExact = 1e-10;  // of the radius: a tenth of what free means leaves for rounding
  double largest = 0.0;
  for (const Point& p : points_world) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  const double share = 2.0 * std::numeric_limits<double>::epsilon() * largest / radius;
  return share > kExact && share < 0.5 ? radius * (1.0 - share) : radius;
}

}  // namespace ridgeway::detail
