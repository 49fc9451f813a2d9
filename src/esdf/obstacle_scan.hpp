// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "box_distance.hpp"
#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway::detail {

/// Smallest squared distance (voxel units) from a segment (voxel units, a == b for a point) to
/// the obstacles, or `best` where none is nearer. Looks at every obstacle that could be nearer:
/// whole blocks as one box where they are solid, rows of voxels otherwise.
class ObstacleScan {
 public:
  ObstacleScan(const EsdfMap& esdf, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      : esdf_(esdf), a_(a), b_(b), low_(a.cwiseMin(b)), high_(a.cwiseMax(b)) {}

  double run(double best) {
    best_ = best;
    const double reach = std::sqrt(best);
    const BlockIndex first = block_at(low_ - Eigen::Vector3d::Constant(reach));
    const BlockIndex last = block_at(high_ + Eigen::Vector3d::Constant(reach));
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) scan_block({x, y, z});
    return best_;
  }

 private:
  static BlockIndex block_at(const Eigen::Vector3d& p) {
    return block_of(voxel_at(p, 1.0));
  }

  /// Squared distance between the segment's bounding box and a box: never too large.
  double bound(const VoxelBox& box) const {
    return (box.min - high_).cwiseMax(low_ - box.max).cwiseMax(0.0).squaredNorm();
  }

  void consider(const VoxelBox& box) {
    if (bound(box) >= best_) return;
    best_ = std::min(best_, a_ == b_ ? squared_distance(a_, box) : squared_distance(a_, b_, box));
  }

  void scan_block(const BlockIndex& index) {
    const Eigen::Vector3d corner =
        Eigen::Vector3d(index.x, index.y, index.z) * static_cast<double>(kBlockSide);
    const VoxelBox whole{corner, corner + Eigen::Vector3d::Constant(kBlockSide)};
    if (bound(whole) >= best_) return;
    const std::uint32_t slot = esdf_.layout.find_block(index);
    if (slot == BlockLayout::kNoBlock) {
      if (esdf_.unknown == UnknownPolicy::kObstacle) consider(whole);
      return;
    }
    const VoxelMask::Block& block = esdf_.obstacle.block(slot);
    for (int z = 0; z < kBlockSide; ++z) {
      const std::uint64_t layer = block[static_cast<std::size_t>(z)];
      if (layer == 0) continue;
      const double z0 = corner.z() + z;
      const double dz = std::max({z0 - high_.z(), low_.z() - z0 - 1.0, 0.0});
      if (dz * dz >= best_) continue;
      for (int y = 0; y < kBlockSide; ++y) {
        const auto row = static_cast<unsigned>(layer >> (8 * y) & 0xff);
        if (row != 0) scan_row(row, {corner.x(), corner.y() + y, z0});
      }
    }
  }

  void scan_row(unsigned row, const Eigen::Vector3d& corner) {
    while (row != 0) {
      const int first = std::countr_zero(row);
      const int length = std::countr_one(row >> first);
      row &= row + (1u << first);  // clears the lowest run
      const Eigen::Vector3d min = corner + Eigen::Vector3d(first, 0, 0);
      consider({min, min + Eigen::Vector3d(length, 1, 1)});
    }
  }

  const EsdfMap& esdf_;
  const Eigen::Vector3d a_, b_, low_, high_;
  double best_ = 0.0;
};

/// Unit cube of a voxel.
inline VoxelBox cube_of(const VoxelIndex& v) {
  const Eigen::Vector3d min(v.x, v.y, v.z);
  return {min, min + Eigen::Vector3d::Ones()};
}

}  // namespace ridgeway::detail
