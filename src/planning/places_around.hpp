// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>
#include <tuple>

#include "layout_box.hpp"
#include "paths/deadline.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Traversable voxel centres around a point, nearest first, found best first in a tree of cubes
/// that halve: as distances change no faster than places, a cube is passed over where its middle
/// is too near to an obstacle for any of its voxels to be free.
class PlacesAround {
 public:
  /// `farthest`: metres from the point.
  PlacesAround(const EsdfMap& esdf, const Point& point, double radius, double farthest)
      : esdf_(esdf),
        finder_(esdf.layout),
        box_(esdf.layout),
        point_(point / esdf.voxel_size),
        threshold_(least_clearance(radius, esdf.voxel_size)),
        farthest_(farthest / esdf.voxel_size) {
    open_roots();
  }

  /// The next place; nothing where there are no more, or time is up.
  std::optional<Point> next(const Deadline& deadline) {
    while (!open_.empty()) {
      if (++looks_ % kBetweenLooks == 0 && deadline.has_passed()) return std::nullopt;
      const Cube cube = open_.top();
      open_.pop();
      if (cube.side == 1) return centre_of(cube.low, esdf_.voxel_size);
      const int half = cube.side / 2;
      for (int part = 0; part < 8; ++part)
        offer({cube.low.x + half * (part & 1), cube.low.y + half * (part >> 1 & 1),
               cube.low.z + half * (part >> 2)},
              half);
    }
    return std::nullopt;
  }

 private:
  static constexpr double kSlack = 1e-9;
  static constexpr int kBetweenLooks = 256;  // at the clock

  struct Cube {
    double distance;  // from the point to the nearest of its voxels' centres, voxels
    VoxelIndex low;
    int side;  // voxels, a power of two

    bool operator<(const Cube& other) const {  // the top of the queue: nearest first, whole first
      return std::tie(distance, other.side, low) > std::tie(other.distance, side, other.low);
    }
  };

  /// All places, as cubes that voxels' indices stay within.
  void open_roots() {
    constexpr int kSide = 1 << 30;
    for (int z = -1; z <= 0; ++z)
      for (int y = -1; y <= 0; ++y)
        for (int x = -1; x <= 0; ++x) offer({x * kSide, y * kSide, z * kSide}, kSide);
  }

  void offer(const VoxelIndex& low, int side) {
    const Eigen::Vector3d first(low.x + 0.5, low.y + 0.5, low.z + 0.5);
    const Eigen::Vector3d last = first + Eigen::Vector3d::Constant(side - 1.0);
    const double distance = (point_.cwiseMax(first).cwiseMin(last) - point_).norm();
    if (distance > farthest_ || (side == 1 && distance == 0.0)) return;
    if (may_hold_place(low, side)) open_.push({distance, low, side});
  }

  bool may_hold_place(const VoxelIndex& low, int side) {
    const VoxelIndex last{low.x + (side - 1), low.y + (side - 1), low.z + (side - 1)};
    if (!box_.meets(low, last)) return false;
    const int half = side / 2;
    const VoxelId middle = finder_.find({low.x + half, low.y + half, low.z + half});
    if (middle == kNoVoxel)
      return side > kBlockSide &&
             (esdf_.unknown != UnknownPolicy::kObstacle || reaches(SquaredHalves(), half));
    if (side == 1 && !esdf_.is_open(middle)) return false;
    return esdf_.squared[middle] == kNoSite || reaches(esdf_.squared[middle], half);
  }

  /// Whether a voxel of a cube may be free whose middle is at a squared distance.
  bool reaches(SquaredHalves squared, int half) const {
    if (half == 0) return squared >= threshold_;
    const double most = 0.5 * std::sqrt(squared.value) + std::numbers::sqrt3 * half;
    return most * (1.0 + kSlack) >= 0.5 * std::sqrt(threshold_.value);
  }

  const EsdfMap& esdf_;
  VoxelFinder finder_;
  const LayoutBox box_;
  const Eigen::Vector3d point_;  // voxels
  const SquaredHalves threshold_;
  const double farthest_;
  std::priority_queue<Cube> open_;
  int looks_ = 0;
};

}  // namespace ridgeway::detail
