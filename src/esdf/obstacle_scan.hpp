// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "box_distance.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Voxels of a layout that distances are measured to, and whether what is not allocated is one: of
/// a planar map, beside its blocks alone.
struct SolidVoxels {
  const BlockLayout& layout;
  const VoxelMask& members;
  bool absent_is_solid;
  bool planar = false;
};

/// Smallest squared distance (voxel units) from a segment (voxel units, a == b for a point) to
/// the obstacles, or `best` where none is nearer. Looks at every obstacle that could be nearer:
/// whole blocks as one box where they are solid, rows of voxels otherwise; none that lies inside
/// the ball which the distance field keeps free around the middle of the segment.
/// Plain form: brute_squared_distance() in plain_distances.hpp; docs/fast-kernels.md, section 2
/// (7).
class ObstacleScan {
 public:
  ObstacleScan(const SolidVoxels& solid, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      : solid_(solid), a_(a), b_(b), low_(a.cwiseMin(b)), high_(a.cwiseMax(b)) {}

  ObstacleScan(const EsdfMap& esdf, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      : ObstacleScan(
            {esdf.layout, esdf.obstacle, esdf.unknown == UnknownPolicy::kObstacle, esdf.planar}, a,
            b) {
    const VoxelIndex middle = voxel_at(0.5 * (a + b), 1.0);
    const VoxelId id = esdf.layout.find(middle);
    if (id == kNoVoxel || esdf.squared[id] == kNoSite) return;
    ball_centre_ = centre_of(middle, 1.0);
    ball_squared_ = 0.25 * esdf.squared[id];
  }

  double run(double best) {
    const BlockBox box = box_within(std::sqrt(best));
    return has_many_more_than_all(box) ? run_over_all(best) : run_over(box, best);
  }

  /// As run(), but of an obstacle whose distance is least at an end of the segment nothing needs to
  /// be known: what is between the two planes across the ends is looked at, a ring around the
  /// segment.
  double run_across(double best) {
    along_ = b_ - a_;
    return run(best);
  }

  /// Blocks from `first` to `last`, both inclusive.
  struct BlockBox {
    BlockIndex first, last;
  };
  /// All blocks that are within reach of the segment, voxels.
  BlockBox box_within(double reach) const {
    return {block_at(low_ - Eigen::Vector3d::Constant(reach)),
            block_at(high_ + Eigen::Vector3d::Constant(reach))};
  }

  /// As run(), of some blocks alone.
  double run_over(const BlockBox& box, double best) {
    set_best(best);
    for (int z = box.first.z; z <= box.last.z; ++z)
      for (int y = box.first.y; y <= box.last.y; ++y) {
        const BlockRow row = row_in_reach(y, z, box.first.x, box.last.x);
        std::uint32_t before = BlockLayout::kNoBlock;  // slot of the block scanned last in this row
        for (int x = row.first; x <= row.last; ++x) {
          if (x == row.free_first && x <= row.free_last) {
            before = BlockLayout::kNoBlock;
            x = row.free_last;
            continue;
          }
          before = scan_block({x, y, z}, before);
        }
      }
    return best_;
  }

  /// Squared distance between the segment's bounding box and all blocks from one to another: never
  /// too large.
  double bound(const BlockIndex& first, const BlockIndex& last) const {
    return bound({corner_of(first), corner_of(last) + Eigen::Vector3d::Constant(kBlockSide)});
  }

 private:
  static Eigen::Vector3d corner_of(const BlockIndex& block) {
    return Eigen::Vector3d(block.x, block.y, block.z) * static_cast<double>(kBlockSide);
  }

  void set_best(double best) {
    constexpr double kSlack = 1e-6;
    best_ = best;
    reach_ = std::sqrt(best) + kSlack;
  }

  /// Whether it is quicker to go through the layout, where what is not in it is no obstacle.
  bool has_many_more_than_all(const BlockBox& box) const {
    constexpr double kMany = 1 << 20;
    const auto side = [](int first, int last) { return static_cast<double>(last) - first + 1.0; };
    const double blocks = side(box.first.x, box.last.x) * side(box.first.y, box.last.y) *
                          side(box.first.z, box.last.z);
    return !solid_.absent_is_solid && blocks > kMany &&
           blocks > static_cast<double>(solid_.layout.blocks().size());
  }

  double run_over_all(double best) {
    set_best(best);
    for (const BlockIndex& block : solid_.layout.blocks()) scan_block(block, BlockLayout::kNoBlock);
    return best_;
  }

  static BlockIndex block_at(const Eigen::Vector3d& p) { return block_of(voxel_at(p, 1.0)); }

  /// Blocks of a row along x, both inclusive, and those of them that lie in the free ball.
  struct BlockRow {
    int first, last, free_first, free_last;
  };

  /// What of a row is in reach of the segment's bounding box, and between the planes across its
  /// ends if nothing else is asked for.
  BlockRow row_in_reach(int y, int z, int first, int last) const {
    constexpr BlockRow kNothing{0, -1, 0, -1};
    constexpr double kSide = kBlockSide, kSlack = 1e-6;
    const double y0 = y * kSide, y1 = y0 + kSide, z0 = z * kSide, z1 = z0 + kSide;
    const double dy = std::max({y0 - high_.y(), low_.y() - y1, 0.0});
    const double dz = std::max({z0 - high_.z(), low_.z() - z1, 0.0});
    const double left = best_ - dy * dy - dz * dz;
    if (left < 0.0) return kNothing;
    const double reach = std::sqrt(left) + kSlack;
    double x0 = std::max(low_.x() - reach, first * kSide);
    double x1 = std::min(high_.x() + reach, last * kSide + kSide - kSlack);
    if (along_ != Eigen::Vector3d::Zero()) {
      // Of a point of the row, along . p less its part along x lies between these.
      const double most =
          std::max(along_.y() * y0, along_.y() * y1) + std::max(along_.z() * z0, along_.z() * z1);
      const double least =
          std::min(along_.y() * y0, along_.y() * y1) + std::min(along_.z() * z0, along_.z() * z1);
      const double begin = along_.dot(a_) - most - kSlack, end = along_.dot(b_) - least + kSlack;
      if (along_.x() == 0.0) {
        if (begin > 0.0 || end < 0.0) return kNothing;
      } else {
        const double p = begin / along_.x(), q = end / along_.x();
        x0 = std::max(x0, std::min(p, q));
        x1 = std::min(x1, std::max(p, q));
      }
    }
    if (x0 > x1) return kNothing;
    BlockRow row{floor_to_int(x0 / kSide), floor_to_int(x1 / kSide), 0, -1};
    const double fy = std::max(ball_centre_.y() - y0, y1 - ball_centre_.y());
    const double fz = std::max(ball_centre_.z() - z0, z1 - ball_centre_.z());
    if (const double rest = ball_squared_ - fy * fy - fz * fz; rest > 0.0) {
      const double half = std::sqrt(rest) - kSlack;
      row.free_first = std::max(floor_to_int((ball_centre_.x() - half) / kSide) + 1, row.first);
      row.free_last = std::min(floor_to_int((ball_centre_.x() + half) / kSide) - 1, row.last);
    }
    return row;
  }

  /// Squared distance between the segment's bounding box and a box: never too large.
  double bound(const VoxelBox& box) const {
    return (box.min - high_).cwiseMax(low_ - box.max).cwiseMax(0.0).squaredNorm();
  }

  /// Whether the field already says that nothing in a box is an obstacle.
  bool is_in_free_ball(const VoxelBox& box) const {
    return (ball_centre_ - box.min).cwiseMax(box.max - ball_centre_).squaredNorm() < ball_squared_;
  }

  void consider(const VoxelBox& box) {
    if (bound(box) >= best_) return;
    best_ = std::min(best_, a_ == b_ ? squared_distance(a_, box) : squared_distance(a_, b_, box));
  }

  /// Returns the block's slot, or kNoBlock where it was not even looked up.
  std::uint32_t scan_block(const BlockIndex& index, std::uint32_t before) {
    const Eigen::Vector3d corner = corner_of(index);
    const VoxelBox whole{corner, corner + Eigen::Vector3d::Constant(kBlockSide)};
    if (bound(whole) >= best_ || is_in_free_ball(whole)) return BlockLayout::kNoBlock;
    constexpr int kNextAlongX = 14;
    const std::uint32_t slot = before != BlockLayout::kNoBlock
                                   ? solid_.layout.neighbour_block(before, kNextAlongX)
                                   : solid_.layout.find_block(index);
    if (slot == BlockLayout::kNoBlock) {
      if (solid_.absent_is_solid && !(solid_.planar && index.z != 0)) consider(whole);
      return slot;
    }
    const VoxelMask::Block& block = solid_.members.block(slot);
    std::uint64_t all = ~std::uint64_t{0};
    for (const std::uint64_t layer : block) all &= layer;
    if (all == ~std::uint64_t{0}) {
      consider(whole);
      return slot;
    }
    scan_layers(block, corner);
    return slot;
  }

  /// Of the places along an axis of a block in reach, those in reach of the segment's bounding box,
  /// both inclusive.
  struct Places {
    int first, last;
  };
  Places places_in_reach(int axis, const Eigen::Vector3d& corner) const {
    const double first = low_[axis] - reach_ - corner[axis];
    const double last = high_[axis] + reach_ - corner[axis];
    return {first > 0.0 ? static_cast<int>(first) : 0,
            last < kBlockSide ? static_cast<int>(std::max(last, 0.0)) : kBlockSide - 1};
  }

  void scan_layers(const VoxelMask::Block& block, const Eigen::Vector3d& corner) {
    const Places rows = places_in_reach(1, corner), layers = places_in_reach(2, corner);
    for (int z = layers.first; z <= layers.last; ++z) {
      const std::uint64_t layer = block[static_cast<std::size_t>(z)];
      if (layer == 0) continue;
      const double z0 = corner.z() + z;
      const double dz = std::max({z0 - high_.z(), low_.z() - z0 - 1.0, 0.0});
      if (dz * dz >= best_) continue;
      for (int y = rows.first; y <= rows.last; ++y) {
        const auto row = static_cast<unsigned>(layer >> (8 * y) & 0xff);
        if (row == 0) continue;
        const double y0 = corner.y() + y;
        const double dy = std::max({y0 - high_.y(), low_.y() - y0 - 1.0, 0.0});
        const double near = dy * dy + dz * dz;
        if (near < best_) scan_row(row, {corner.x(), y0, z0}, near);
      }
    }
  }

  /// `near`: squared distance of the row from the segment's bounding box, across the row.
  void scan_row(unsigned row, const Eigen::Vector3d& corner, double near) {
    while (row != 0) {
      const int first = std::countr_zero(row);
      const int length = std::countr_one(row >> first);
      row &= row + (1u << first);  // clears the lowest run
      const double x0 = corner.x() + first, x1 = x0 + length;
      const double dx = std::max({x0 - high_.x(), low_.x() - x1, 0.0});
      constexpr double kSlack = 1.0 + 1e-12;  // for rounding
      if (near + dx * dx > best_ * kSlack) continue;
      consider({{x0, corner.y(), corner.z()}, {x1, corner.y() + 1.0, corner.z() + 1.0}});
    }
  }

  const SolidVoxels solid_;
  const Eigen::Vector3d a_, b_, low_, high_;
  Eigen::Vector3d along_ = Eigen::Vector3d::Zero();  // of the planes across its ends; 0: no such
  Eigen::Vector3d ball_centre_ = Eigen::Vector3d::Zero();
  double ball_squared_ = 0.0;  // its inside, without the border, is free
  double best_ = 0.0;
  double reach_ = 0.0;  // voxels, never too small
};

/// Unit cube of a voxel.
inline VoxelBox cube_of(const VoxelIndex& v) {
  const Eigen::Vector3d min(v.x, v.y, v.z);
  return {min, min + Eigen::Vector3d::Ones()};
}

}  // namespace ridgeway::detail
