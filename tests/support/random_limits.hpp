// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <random>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::testing {

/// How deep a point lies in a box; negative outside.
inline double depth(const Box& box, const Point& p) {
  return std::min((p - box.min).minCoeff(), (box.max - p).minCoeff());
}

/// Limits that leave about half of a map.
inline FlightLimits random_limits(std::mt19937& random, const Box& bounds) {
  const auto share = [&] { return static_cast<double>(random() % 1001) / 1000.0; };
  const Point extent = bounds.max - bounds.min;
  FlightLimits limits;
  const int axis = static_cast<int>(random() % 3);
  limits.keep_in.min[axis] = bounds.min[axis] + 0.3 * share() * extent[axis];
  limits.keep_in.max[axis] = bounds.max[axis] - 0.3 * share() * extent[axis];
  for (unsigned i = 0; i < random() % 3; ++i) {
    const Point low = bounds.min + Point{share(), share(), share()}.cwiseProduct(extent);
    limits.keep_out.push_back(
        {low, low + 0.4 * Point{share(), share(), share() + 0.2}.cwiseProduct(extent) +
                  Point::Constant(0.01)});
  }
  return limits;
}

/// Whether moves may lead over a voxel: its centre is kept in, and it shares no room with a box
/// that is kept out of. By coordinates alone, apart from the library's own answer.
inline bool is_within(const FlightLimits& limits, const VoxelIndex& v, double voxel_size) {
  const Point low = Point(v.x, v.y, v.z) * voxel_size;
  const Point high = low + Point::Constant(voxel_size);
  if (depth(limits.keep_in, 0.5 * (low + high)) < -1e-9) return false;
  for (const Box& box : limits.keep_out)
    if (((high.cwiseMin(box.max) - low.cwiseMax(box.min)).array() > 1e-7).all()) return false;
  return true;
}

}  // namespace ridgeway::testing
