// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Looks for a way from a to b with few corners beside the obstacle that blocks the straight line:
/// rays fan out from the blocked place, across the line, to the nearest points where the robot
/// fits. `budget`: only ways shorter than this, metres, are of interest; `corners`: how many there
/// may be. The interior corners of the best way found; of a free line a place on it.
struct Detour {
  std::vector<Point> corners;
  double length = 0.0;  ///< from a over the corners to b
  bool found() const { return !corners.empty(); }
};
Detour find_detour(const EsdfMap& esdf, const FreeSpace& space, const Point& a, const Point& b,
                   double radius, double budget, int corners);

/// Looks past the corners of a shortened path: where a stretch of it is much longer than the
/// straight line, tries ways on other sides of what blocks the line, and keeps those that are
/// shorter.
std::vector<Point> redirect(const EsdfMap& esdf, const FreeSpace& space, std::vector<Point> path,
                            double radius, const Deadline& deadline);

}  // namespace ridgeway::detail
