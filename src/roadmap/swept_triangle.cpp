// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "swept_triangle.hpp"

namespace ridgeway::detail {
namespace {

/// The segments from `first` to `last` lie in one triangle. No place of it is farther from its
/// sides than the radius of the inscribed circle: if the sides are free for a radius larger by
/// that, all of these segments are free.
bool is_free(const RememberedSpace& space, double radius, const Fan& fan, int first, int last) {
  constexpr int kFew = 8;
  constexpr double kRounding = 1.0 + 1e-8;
  if (last - first < kFew) {
    for (int i = first; i <= last; ++i)
      if (!space.is_free(fan.apex, fan.place(i), radius)) return false;
    return true;
  }
  const Point from = fan.place(first), to = fan.place(last);
  const Point one = from - fan.apex, other = to - fan.apex, across = to - from;
  const double inradius = one.cross(other).norm() / (one.norm() + other.norm() + across.norm());
  const double wide = (radius + inradius) * kRounding;
  if (space.is_free(fan.apex, from, wide) && space.is_free(fan.apex, to, wide) &&
      space.is_free(from, to, wide))
    return true;
  const int middle = first + (last - first) / 2;
  return space.is_free(fan.apex, fan.place(middle), radius) &&
         is_free(space, radius, fan, first, middle - 1) &&
         is_free(space, radius, fan, middle + 1, last);
}

}  // namespace

bool sweeps(const RememberedSpace& space, double radius, const Fan& fan) {
  constexpr int kMany = 32;
  // Where unknown space is ignored, each voxel on the way must be known to be free.
  if (fan.steps < kMany || space.map().unknown == UnknownPolicy::kIgnore)
    return sweeps_plainly(space, radius, fan);
  return is_free(space, radius, fan, 1, fan.steps - 1);
}

}  // namespace ridgeway::detail
