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
constexpr double kRounding = 1e-9;    // of the radius and the height: what touches does not collide

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

  bool is_free() const { return is_free_in(floor_to_int(bottom_), floor_to_int(top_)); }

 private:
  /// What it passes through of some layers of voxels. The ball that the field keeps free around the
  /// middle of that may hold all of it, or what that ball touches may be in its way; where neither
  /// tells, halves are asked, down to the layers of one block, which are looked at.
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
        const VoxelIndex site = voxel + VoxelIndex{o.x, o.y, o.z};
        if (!is_clear_of_any(site.z, site.z, site.x, site.y, 1)) return false;
      }
    }
    if (first >> kBlockBits == last >> kBlockBits) return looks_free_in(first, last);
    const int between = std::max((first + last + 1) / 2 & -kBlockSide, (first | 7) + 1);
    return is_free_in(first, between - 1) && is_free_in(between, last);
  }

  /// The same of layers of one block, by a look at all voxels within reach.
  bool looks_free_in(int first, int last) const {
    const Eigen::Vector3d reach(radius_, radius_, 0.0);
    const VoxelIndex low = voxel_at(Eigen::Vector3d(a_.cwiseMin(b_) - reach), 1.0);
    const VoxelIndex high = voxel_at(Eigen::Vector3d(a_.cwiseMax(b_) + reach), 1.0);
    const BlockIndex begin = block_of({low.x, low.y, first}),
                     end = block_of({high.x, high.y, first});
    for (int y = begin.y; y <= end.y; ++y)
      for (int x = begin.x; x <= end.x; ++x)
        if (!is_clear_of_block({x, y, begin.z}, first, last)) return false;
    return true;
  }

  bool is_clear_of_block(const BlockIndex& index, int first, int last) const {
    const VoxelIndex corner = voxel_of(index, 0);
    const std::uint32_t slot = esdf_.layout.find_block(index);
    if (slot == BlockLayout::kNoBlock)
      return !esdf_.is_obstacle(kNoVoxel) ||
             is_clear_of_any(first, last, corner.x, corner.y, kBlockSide);
    const VoxelMask::Block& block = esdf_.obstacle.block(slot);
    std::uint64_t any = 0;
    for (int layer = first; layer <= last; ++layer)
      any |= block[static_cast<std::size_t>(layer - corner.z)];
    if (any == 0 || is_clear_of_any(first, last, corner.x, corner.y, kBlockSide)) return true;
    for (int layer = first; layer <= last; ++layer)
      for (std::uint64_t bits = block[static_cast<std::size_t>(layer - corner.z)]; bits != 0;
           bits &= bits - 1) {
        const int i = std::countr_zero(bits);
        if (!is_clear_of_any(layer, layer, corner.x + i % 8, corner.y + i / 8, 1)) return false;
      }
    return true;
  }

  /// Whether it keeps its radius from a square of voxels in each of some layers.
  bool is_clear_of_any(int first, int last, int x, int y, int side) const {
    for (int layer = first; layer <= last; ++layer) {
      const Part part = part_in_layer(a_.z(), b_.z(), layer, half_height_);
      if (part.is_empty()) continue;
      Eigen::Vector3d from = a_ + part.begin * (b_ - a_), to = a_ + part.end * (b_ - a_);
      from.z() = to.z() = 0.0;  // heights count no more
      if (!is_clear_of(from, to, radius_, x, y, x + side, y + side)) return false;
      if (a_.z() == b_.z()) break;  // as in the other layers
    }
    return true;
  }

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
                       radius * (1.0 - kRounding), half_height * (1.0 - kRounding))
             .is_free())
      return false;
  return true;
}

}  // namespace ridgeway::detail
