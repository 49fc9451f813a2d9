// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>

namespace ridgeway::detail {

/// A closed box in voxel units: the union of the cubes first .. last (corners at integers).
struct VoxelBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

/// Squared distance from a point to a box.
inline double squared_distance(const Eigen::Vector3d& p, const VoxelBox& box) {
  return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).squaredNorm();
}

/// Smallest squared distance from the points of a segment to a box: the distance is convex along
/// the segment and quadratic between the places where it crosses a face's plane.
double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const VoxelBox& box);

}  // namespace ridgeway::detail
