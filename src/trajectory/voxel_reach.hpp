// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/voxel/index.hpp"

namespace ridgeway::detail {

/// Whether a point is a number, and not so far away that its voxel has no index.
inline bool has_voxel(const Point& p, double voxel_size) {
  constexpr double kFarthest = 1e9;  // voxels
  return (p.array().abs() < kFarthest * voxel_size).all();
}

}  // namespace ridgeway::detail
