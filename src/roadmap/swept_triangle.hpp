// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>

#include "esdf/remembered_space.hpp"

namespace ridgeway::detail {

/// Segments from a point to places along another segment, which sweep the triangle of the two.
struct Fan {
  Point apex, a, b;
  int steps = 0;  ///< that the places divide the segment into

  Fan(const Point& from, const Point& first, const Point& last, double radius)
      : apex(from),
        a(first),
        b(last),
        steps(static_cast<int>(std::ceil((last - first).norm() / radius))) {}
  Point place(int i) const { return a + (b - a) * (static_cast<double>(i) / steps); }
};

/// Whether a triangle can be swept: each segment of the fan, a radius apart, is free for that
/// radius, one by one. The plain form of sweeps().
inline bool sweeps_plainly(const RememberedSpace& space, double radius, const Fan& fan) {
  for (int i = 1; i < fan.steps; ++i)
    if (!space.is_free(fan.apex, fan.place(i), radius)) return false;
  return true;
}

/// The same, in less than the square of a long fan's length where space is open.
bool sweeps(const RememberedSpace& space, double radius, const Fan& fan);

}  // namespace ridgeway::detail
