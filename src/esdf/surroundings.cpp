// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "block_tree.hpp"
#include "common/rounding.hpp"
#include "obstacle_scan.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;
using detail::ObstacleScan;

constexpr double kPiece = 8.0;              // voxels of a path that are looked at as one
constexpr double kResolution = 1.0 / 16.0;  // voxels; of the places where paths come too near

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

struct Surroundings::Kind {
  VoxelMask members;
  bool absent_is_member = false;
  detail::BlockTree blocks{};  ///< with members, and beside allocated ones those that are absent
};

/// Distances to the voxels of one kind, in voxels.
class Surroundings::Nearest {
 public:
  Nearest(const EsdfMap& esdf, const Kind& kind) : esdf_(esdf), kind_(kind) {}

  /// From a segment, or `at_most` (which may be infinite) where none is nearer.
  double distance(const Vector& a, const Vector& b, double at_most) const {
    if (kind_.blocks.empty()) return at_most;
    const detail::SolidVoxels solid{esdf_.layout, kind_.members, kind_.absent_is_member,
                                    esdf_.planar};
    ObstacleScan scan(solid, a, b);
    // Where it is, as what is absent there may have no allocated block beside it.
    const double here = scan.run_over(scan.box_within(0.0), at_most * at_most);
    const double squared = kind_.blocks.search(
        here,
        [&](const BlockIndex& first, const BlockIndex& last) { return scan.bound(first, last); },
        [&](const BlockIndex& block, double best) {
          return scan.run_over({block, block}, best);
        });
    return squared < at_most * at_most ? std::sqrt(squared) : at_most;
  }

  /// Smallest along a path. A piece is looked at closely only where its middle lies so near that
  /// some of it may be nearer than all before: distances change no faster than places.
  double along(std::span<const Point> path) const {
    double best = std::numeric_limits<double>::infinity();
    for_each_piece(path, esdf_.voxel_size, [&](const Vector& a, const Vector& b) {
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
  const EsdfMap& esdf_;
  const Kind& kind_;
};

Surroundings::Surroundings(const EsdfMap& esdf)
    : esdf_(esdf),
      known_(voxels_of(VoxelState::kOccupied)),
      unknown_(voxels_of(VoxelState::kUnknown)) {}

std::shared_ptr<const Surroundings::Kind> Surroundings::voxels_of(VoxelState state) const {
  const BlockLayout& layout = esdf_.layout;
  Kind kind{VoxelMask(layout), state == VoxelState::kUnknown};
  std::vector<char> has_some(layout.block_count());
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t index) {
        const auto slot = static_cast<std::uint32_t>(index);
        const VoxelState* states = esdf_.state.block(slot);
        VoxelMask::Block& block = kind.members.block(slot);
        block = block_where([&](int v) { return states[v] == state; });
        has_some[index] = !detail::is_empty(block);
      },
      16);
  std::vector<BlockIndex> blocks;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    if (has_some[slot] != 0) blocks.push_back(layout.block(slot));
    if (!kind.absent_is_member) continue;
    for (const Direction d : kFaceDirections) {  // as near as those across an edge or a corner
      const VoxelIndex& o = offset_of(d);
      if (esdf_.planar && o.z != 0) continue;
      if (layout.neighbour_block(slot, d) == BlockLayout::kNoBlock)
        blocks.push_back(layout.block(slot) + BlockIndex{o.x, o.y, o.z});
    }
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  kind.blocks = detail::BlockTree(std::move(blocks));
  return std::make_shared<const Kind>(std::move(kind));
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
  result.known = s * Nearest(esdf_, *known_).along(path);
  const Nearest unknown(esdf_, *unknown_);
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
