// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <span>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// Length of a path from waypoint to waypoint; 0 where it has fewer than two.
inline double length_of(std::span<const Point> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace ridgeway
