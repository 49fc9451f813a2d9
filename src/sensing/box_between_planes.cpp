// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "box_between_planes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ridgeway::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFar = 1e9;  // metres: a corner as far away is one of open space

constexpr std::size_t kMostPlanes = 200;  // whose corners are looked for, of all triples

/// By the planes along the axes alone, exactly.
std::pair<Point, Point> box_along_axes(std::span<const SolidPlane> planes) {
  std::pair<Point, Point> box = {Point::Constant(-kInfinity), Point::Constant(kInfinity)};
  for (const SolidPlane& plane : planes)
    for (int axis = 0; axis < 3; ++axis) {
      if (plane.normal[axis] == 1.0) box.first[axis] = std::max(box.first[axis], plane.offset);
      if (plane.normal[axis] == -1.0) box.second[axis] = std::min(box.second[axis], -plane.offset);
    }
  return box;
}

bool is_along_axis(const SolidPlane& plane) { return plane.normal.cwiseAbs().maxCoeff() == 1.0; }

}  // namespace

std::pair<Point, Point> box_between(std::span<const SolidPlane> planes) {
  auto box = box_along_axes(planes);
  if (planes.size() > kMostPlanes || std::all_of(planes.begin(), planes.end(), is_along_axis))
    return box;
  // The corners of what is left of a huge box: each is where three of the planes meet.
  std::vector<SolidPlane> all(planes.begin(), planes.end());
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0})
      all.push_back({side * Eigen::Vector3d::Unit(axis), -kFar});
  Point low = Point::Constant(kInfinity), high = Point::Constant(-kInfinity);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        Eigen::Matrix3d normals;
        normals << all[i].normal.transpose(), all[j].normal.transpose(), all[k].normal.transpose();
        const Eigen::FullPivLU<Eigen::Matrix3d> meeting(normals);
        if (!meeting.isInvertible()) continue;
        const Point corner =
            meeting.solve(Eigen::Vector3d(all[i].offset, all[j].offset, all[k].offset));
        const double slack = 1e-9 * (1.0 + corner.cwiseAbs().maxCoeff());
        if (std::any_of(all.begin(), all.end(), [&](const SolidPlane& plane) {
              return plane.normal.dot(corner) < plane.offset - slack;
            }))
          continue;
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
  for (int axis = 0; axis < 3; ++axis) {
    if (low[axis] > -0.5 * kFar) box.first[axis] = std::max(box.first[axis], low[axis]);
    if (high[axis] < 0.5 * kFar) box.second[axis] = std::min(box.second[axis], high[axis]);
  }
  return box;
}

}  // namespace ridgeway::detail
