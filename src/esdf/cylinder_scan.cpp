// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cylinder_scan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "box_distance.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kPieceLength = 4.0;  // voxels of a segment at a time: its box stays small

/// The part of a segment, shares of it, at which the cylinder reaches into a layer of voxels.
struct Part {
  double begin = 0.0, end = 1.0;
  bool is_empty() const { return begin > end; }
};

Part part_in_layer(double z0, double z1, double layer, double half_height) {
  const double low = layer - half_height, high = layer + 1.0 + half_height;  // of the centre
  const double along = z1 - z0;
  if (along == 0.0) return z0 > low && z0 < high ? Part{} : Part{1.0, 0.0};
  const double to_low = (low - z0) / along, to_high = (high - z0) / along;
  Part part{std::max(0.0, std::min(to_low, to_high)), std::min(1.0, std::max(to_low, to_high))};
  if (part.begin == part.end && (part.begin == 0.0 || part.end == 1.0)) return {1.0, 0.0};
  return part;
}

/// Whether a piece of a segment, seen from above, keeps a distance from a rectangle.
bool is_clear_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius, double x0,
                 double y0, double x1, double y1) {
  const VoxelBox box{Eigen::Vector3d(x0, y0, 0.0), Eigen::Vector3d(x1, y1, 0.0)};
  return (a == b ? squared_distance(a, box) : squared_distance(a, b, box)) >= radius * radius;
}

/// And from the voxels of one layer. Heights count no more.
bool is_clear_of_layer(const EsdfMap& esdf, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       int layer, double radius) {
  const Eigen::Vector3d a(from.x(), from.y(), 0.0), b(to.x(), to.y(), 0.0);
  const Eigen::Vector3d reach(radius, radius, 0.0);
  const VoxelIndex low = voxel_at(Eigen::Vector3d(a.cwiseMin(b) - reach), 1.0);
  const VoxelIndex high = voxel_at(Eigen::Vector3d(a.cwiseMax(b) + reach), 1.0);
  const BlockIndex first = block_of({low.x, low.y, layer}),
                   last = block_of({high.x, high.y, layer});
  for (int by = first.y; by <= last.y; ++by)
    for (int bx = first.x; bx <= last.x; ++bx) {
      const VoxelIndex corner = voxel_of({bx, by, first.z}, 0);
      const std::uint32_t slot = esdf.layout.find_block({bx, by, first.z});
      if (slot == BlockLayout::kNoBlock) {
        if (esdf.is_obstacle(kNoVoxel) &&
            !is_clear_of(a, b, radius, corner.x, corner.y, corner.x + kBlockSide,
                         corner.y + kBlockSide))
          return false;
        continue;
      }
      std::uint64_t bits = esdf.obstacle.block(slot)[static_cast<std::size_t>(layer - corner.z)];
      for (; bits != 0; bits &= bits - 1) {
        const int i = std::countr_zero(bits), x = corner.x + i % 8, y = corner.y + i / 8;
        const bool is_near = x >= low.x && x <= high.x && y >= low.y && y <= high.y;
        if (is_near && !is_clear_of(a, b, radius, x, y, x + 1.0, y + 1.0)) return false;
      }
    }
  return true;
}

/// A short piece of a segment that an upright cylinder moves along, in voxels.
class CylinderPiece {
 public:
  CylinderPiece(const EsdfMap& esdf, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                double radius, double half_height)
      : esdf_(esdf),
        a_(a),
        b_(b),
        radius_(radius),
        half_height_(half_height),
        bottom_(std::min(a.z(), b.z()) - half_height),
        top_(std::max(a.z(), b.z()) + half_height) {}

  bool is_free() const {
    constexpr double kSmall = 16.0;  // voxels: what is within reach is soon looked at
    const int first = floor_to_int(bottom_), last = floor_to_int(top_);
    return radius_ + half_height_ < kSmall ? looks_free_in(first, last) : is_free_in(first, last);
  }

 private:
  /// What it passes through of some layers of voxels. The ball that the field keeps free around the
  /// middle of that may hold all of it, or what that ball touches may be in its way; where neither
  /// tells, halves are asked, down to the layers of one block.
  bool is_free_in(int first, int last) const {
    const double low = std::max<double>(first, bottom_), high = std::min(last + 1.0, top_);
    const Eigen::Vector3d middle(0.5 * (a_.x() + b_.x()), 0.5 * (a_.y() + b_.y()),
                                 0.5 * (low + high));
    const VoxelIndex voxel = voxel_at(middle, 1.0);
    if (const VoxelId id = esdf_.layout.find(voxel); id != kNoVoxel) {
      const double across = radius_ + 0.5 * (b_ - a_).head<2>().norm(), up = 0.5 * (high - low);
      const double reach =
          std::sqrt(across * across + up * up) + (middle - centre_of(voxel, 1.0)).norm();
      if (0.25 * esdf_.known_squared(id).value >= reach * reach) return true;
      if (esdf_.squared[id] != kNoSite) {
        const SiteOffset o = esdf_.site[id];
        if (!is_clear_of_voxel(voxel + VoxelIndex{o.x, o.y, o.z})) return false;
      }
    }
    if (first >> kBlockBits == last >> kBlockBits) return looks_free_in(first, last);
    const int between = std::max((first + last + 1) / 2 & -kBlockSide, (first | 7) + 1);
    return is_free_in(first, between - 1) && is_free_in(between, last);
  }

  /// The same by a look at all voxels within reach.
  bool looks_free_in(int first, int last) const {
    for (int layer = first; layer <= last; ++layer) {
      const Part part = part_in_layer(a_.z(), b_.z(), layer, half_height_);
      if (!part.is_empty() &&
          !is_clear_of_layer(esdf_, at(part.begin), at(part.end), layer, radius_))
        return false;
    }
    return true;
  }

  bool is_clear_of_voxel(const VoxelIndex& v) const {
    const Part part = part_in_layer(a_.z(), b_.z(), v.z, half_height_);
    if (part.is_empty()) return true;
    Eigen::Vector3d from = at(part.begin), to = at(part.end);
    from.z() = to.z() = 0.0;  // heights count no more
    return is_clear_of(from, to, radius_, v.x, v.y, v.x + 1.0, v.y + 1.0);
  }

  Eigen::Vector3d at(double share) const { return a_ + share * (b_ - a_); }

  const EsdfMap& esdf_;
  const Eigen::Vector3d a_, b_;
  const double radius_, half_height_, bottom_, top_;
};

}  // namespace

bool cylinder_is_free(const EsdfMap& esdf, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double radius, double half_height) {
  const double pieces = std::max(1.0, std::ceil((b - a).norm() / kPieceLength));
  for (double k = 0.0; k < pieces; ++k)
    if (!CylinderPiece(esdf, a + (b - a) * (k / pieces), a + (b - a) * ((k + 1.0) / pieces),
                       radius * (1.0 - kCylinderRounding), half_height * (1.0 - kCylinderRounding))
             .is_free())
      return false;
  return true;
}

}  // namespace ridgeway::detail
