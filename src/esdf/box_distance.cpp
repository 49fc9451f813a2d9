// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "box_distance.hpp"

#include <algorithm>
#include <array>

namespace ridgeway::detail {

double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const VoxelBox& box) {
  const Eigen::Vector3d along = b - a;
  std::array<double, 8> knots{0.0, 1.0};
  std::size_t count = 2;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.0) continue;
    for (const double face : {box.min[axis], box.max[axis]}) {
      const double t = (face - a[axis]) / along[axis];
      if (t <= 0.0 || t >= 1.0) continue;
      std::size_t place = count++;  // keeps the knots sorted
      for (; knots[place - 1] > t; --place) knots[place] = knots[place - 1];
      knots[place] = t;
    }
  }
  double best = squared_distance(a, box);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double t0 = knots[i], t1 = knots[i + 1], middle = 0.5 * (t0 + t1);
    // On this piece each axis is either inside the box's slab or beyond one known face.
    double slope = 0.0, curvature = 0.0;  // of half the squared distance, at t0
    for (int axis = 0; axis < 3; ++axis) {
      const double at_middle = a[axis] + middle * along[axis];
      const double face = at_middle < box.min[axis]   ? box.min[axis]
                          : at_middle > box.max[axis] ? box.max[axis]
                                                      : at_middle;
      if (face == at_middle) continue;
      slope += (a[axis] + t0 * along[axis] - face) * along[axis];
      curvature += along[axis] * along[axis];
    }
    const double t = curvature > 0.0 ? std::clamp(t0 - slope / curvature, t0, t1) : t0;
    best = std::min(
        {best, squared_distance(a + t * along, box), squared_distance(a + t1 * along, box)});
  }
  return best;
}

}  // namespace ridgeway::detail
