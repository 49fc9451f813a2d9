// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "common/rounding.hpp"
#include "obstacle_scan.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;
using detail::ObstacleScan;
using BlockBox = ObstacleScan::BlockBox;

constexpr double kPiece = 8.0;              // voxels of a path that are looked at as one
constexpr double kResolution = 1.0 / 16.0;  // voxels; of the places where paths come too near
constexpr double kFirstReach = 8.0;         // voxels; doubled until something is found,
constexpr double kFarthest = 5e8;           // or indices would overflow

double volume_of(const BlockBox& box) {
  return (box.last.x - box.first.x + 1.0) * (box.last.y - box.first.y + 1.0) *
         (box.last.z - box.first.z + 1.0);
}

BlockIndex least(const BlockIndex& a, const BlockIndex& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
BlockIndex most(const BlockIndex& a, const BlockIndex& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
BlockBox hull_of(const BlockBox& a, const BlockBox& b) {
  return {least(a.first, b.first), most(a.last, b.last)};
}
/// Of two that share some.
BlockBox common(const BlockBox& a, const BlockBox& b) {
  return {most(a.first, b.first), least(a.last, b.last)};
}

/// Calls body(a, b) for pieces of a path, in voxels.
template <typename Body>
void for_each_piece(std::span<const Point> path, double voxel_size, const Body& body) {
  for (std::size_t i = path.size() == 1 ? 0 : 1; i < path.size(); ++i) {
    const Vector a = path[i == 0 ? 0 : i - 1] / voxel_size, along = path[i] / voxel_size - a;
    const double pieces = std::max(1.0, std::ceil(along.norm() / kPiece));
    for (double k = 0.0; k < pieces; ++k) {
      detail::stop_if_cancelled();
      body(Vector(a + along * (k / pieces)), Vector(a + along * ((k + 1.0) / pieces)));
    }
  }
}

/// Share of a path's length in voxels of which nothing is known; 0 for no length.
double share_in_unknown(const EsdfMap& esdf, std::span<const Point> path) {
  double length = 0.0, inside = 0.0;
  for_each_piece(path, esdf.voxel_size, [&](const Vector& a, const Vector& b) {
    const Vector along = b - a;
    for (double t = 0.0; t < 1.0;) {  // from one crossing of the lattice's planes to the next
      double next = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0) continue;
        const double here = a[axis] + t * along[axis];
        const double plane =
            along[axis] > 0.0 ? std::floor(here + 1e-9) + 1.0 : std::ceil(here - 1e-9) - 1.0;
        next = std::min(next, (plane - a[axis]) / along[axis]);
      }
      const double part = (next - t) * along.norm();
      const VoxelId id = esdf.layout.find(voxel_at(Vector(a + 0.5 * (t + next) * along), 1.0));
      length += part;
      if (id == kNoVoxel || esdf.state[id] == VoxelState::kUnknown) inside += part;
      t = next;
    }
  });
  return length > 0.0 ? inside / length : 0.0;
}

}  // namespace

/// Distances to the voxels of one kind, in voxels.
class Surroundings::Nearest {
 public:
  Nearest(const Surroundings& around, const Kind& kind) : around_(around), kind_(kind) {}

  /// From a segment, or `at_most` (which may be infinite) where none is nearer.
  double distance(const Vector& a, const Vector& b, double at_most) const {
    if (kind_.slots.empty()) return at_most;
    const detail::SolidVoxels solid{around_.esdf_.layout, kind_.members, kind_.absent_is_member,
                                    around_.esdf_.planar};
    ObstacleScan scan(solid, a, b);
    const BlockBox all = hull_of(scan.box_within(0.0), {around_.low_, around_.high_});
    for (double reach = kFirstReach;; reach *= 2.0) {
      double limit = std::min(reach, at_most);
      const BlockBox box = reach > kFarthest ? all : common(scan.box_within(limit), all);
      if (box.first == all.first && box.last == all.last) limit = at_most;
      const double squared = run(scan, box, limit * limit);
      if (squared < limit * limit) return std::sqrt(squared);
      if (limit == at_most) return at_most;
    }
  }

  /// Smallest along a path. A piece is looked at closely only where its middle lies so near that
  /// some of it may be nearer than all before: distances change no faster than places.
  double along(std::span<const Point> path) const {
    double best = std::numeric_limits<double>::infinity();
    for_each_piece(path, around_.esdf_.voxel_size, [&](const Vector& a, const Vector& b) {
      const Vector middle = 0.5 * (a + b);
      const double half = 0.5 * (b - a).norm();
      const double at_middle = distance(middle, middle, best + half);
      if (at_middle < best + half) best = distance(a, b, std::min(best, at_middle));
    });
    return best;
  }

  /// Length, voxels, of what is nearer than a radius (voxels) of a segment.
  double length_within(const Vector& a, const Vector& b, double radius) const {
    const Vector middle = 0.5 * (a + b);
    const double length = (b - a).norm(), half = 0.5 * length;
    const double at_middle = distance(middle, middle, radius + half);
    if (at_middle >= radius + half) return 0.0;
    if (at_middle + half < radius) return length;
    if (half <= kResolution) return at_middle < radius ? length : 0.0;
    return length_within(a, middle, radius) + length_within(middle, b, radius);
  }

 private:
  double run(ObstacleScan& scan, const BlockBox& box, double best) const {
    // Where blocks are few in a large box, they are cheaper one by one, each with its neighbours.
    if (volume_of(box) <= 27.0 * static_cast<double>(kind_.slots.size()))
      return scan.run_over(box, best);
    for (const std::uint32_t slot : kind_.slots) {
      const BlockIndex block = around_.esdf_.layout.block(slot);
      best = scan.run_over({block - BlockIndex{1, 1, 1}, block + BlockIndex{1, 1, 1}}, best);
    }
    return best;
  }

  const Surroundings& around_;
  const Kind& kind_;
};

Surroundings::Surroundings(const EsdfMap& esdf)
    : esdf_(esdf),
      known_(voxels_of(VoxelState::kOccupied)),
      unknown_(voxels_of(VoxelState::kUnknown)) {
  if (esdf.layout.block_count() == 0) return;
  low_ = high_ = esdf.layout.block(0);
  for (const BlockIndex& b : esdf.layout.blocks()) {
    low_ = least(low_, b);
    high_ = most(high_, b);
  }
  low_ = low_ - BlockIndex{1, 1, 1};  // what is unknown because it is not allocated begins there
  high_ = high_ + BlockIndex{1, 1, 1};
}

Surroundings::Kind Surroundings::voxels_of(VoxelState state) const {
  const BlockLayout& layout = esdf_.layout;
  Kind kind{VoxelMask(layout), state == VoxelState::kUnknown, {}};
  std::vector<char> has_some(layout.block_count());
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t index) {
        const auto slot = static_cast<std::uint32_t>(index);
        const VoxelState* states = esdf_.state.block(slot);
        VoxelMask::Block& block = kind.members.block(slot);
        block = block_where([&](int v) { return states[v] == state; });
        has_some[index] = !detail::is_empty(block);
        for (int d = 0; kind.absent_is_member && d < 27; ++d)
          has_some[index] |= layout.neighbour_block(slot, d) == BlockLayout::kNoBlock;
      },
      16);
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    if (has_some[slot] != 0) kind.slots.push_back(slot);
  return kind;
}

PathSurroundings Surroundings::along(std::span<const Point> path_world, double radius) const {
  std::vector<Point> path;
  for (const Point& p : path_world) {
    path.push_back(flight_place(esdf_, p));
    if (!has_voxel(path.back(), esdf_.voxel_size))
      throw InputError("path", "has a point that is no place of the map", "give finite metres");
  }
  PathSurroundings result;
  const double s = esdf_.voxel_size;
  result.known = s * Nearest(*this, known_).along(path);
  const Nearest unknown(*this, unknown_);
  result.unknown = s * unknown.along(path);
  if (esdf_.unknown == UnknownPolicy::kFree) result.unknown_inside = share_in_unknown(esdf_, path);
  const double least = detail::least_fit(radius) / s;
  if (result.unknown >= s * least) return result;
  double length = 0.0, near = 0.0;
  for_each_piece(path, s, [&](const Vector& a, const Vector& b) {
    length += (b - a).norm();
    near += unknown.length_within(a, b, least);
  });
  if (length > 0.0) result.unknown_share = near / length;
  return result;
}

}  // namespace ridgeway
