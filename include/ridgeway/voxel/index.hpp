// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace ridgeway {

/// A point or a direction, metres, z up. Points are in one of two frames, parallel to each other:
/// - world: what files, queries, paths and pictures speak of;
/// - local: a map's own, whose zero is the low corner of its own voxel (0, 0, 0).
/// Functions take and give world points unless they say that theirs are local. A map far from the
/// world's zero (UTM: millions of metres) is thus computed on as exactly as one that is not.
using Point = Eigen::Vector3d;

/// Voxels along one side of a block. Eight wastes less than sixteen on real scans (1.84 against
/// 2.57 allocated voxels per known one), and a row of eight voxels is one byte of a bit mask.
inline constexpr int kBlockSide = 8;
inline constexpr int kBlockBits = 3;  ///< Bits of a voxel's place along one side of its block.
inline constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;  ///< Voxels of a block.

/// Three integers on a lattice; the tag keeps voxels and blocks apart. Ordered by (z, y, x).
template <typename Tag>
struct Index3 {
  int x = 0;  ///< along x
  int y = 0;  ///< along y
  int z = 0;  ///< along z

  /// Equal in every field.
  friend constexpr bool operator==(const Index3&, const Index3&) = default;
  /// By z, then y, then x.
  friend constexpr std::strong_ordering operator<=>(const Index3& a, const Index3& b) {
    if (const auto by_z = a.z <=> b.z; by_z != 0) return by_z;
    if (const auto by_y = a.y <=> b.y; by_y != 0) return by_y;
    return a.x <=> b.x;
  }
  /// Along each axis; must not overflow.
  friend constexpr Index3 operator+(const Index3& a, const Index3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  /// Along each axis; must not overflow.
  friend constexpr Index3 operator-(const Index3& a, const Index3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

/// No voxel of a map lies farther from the lattice's zero, or from the map's origin, than this
/// along any axis, so that sums and differences of two indices are numbers too.
/// BlockLayout::kFarthestBlock enforces it.
inline constexpr int kMaxVoxelIndex = 1'000'000'000;

/// A voxel of the unbounded lattice, whose centre is (index + 0.5) * voxel_size in the world; or
/// one of a map's own voxels, counted from its `origin`, which is a voxel of the lattice: then the
/// same is its centre in the map's local frame. Layouts, fields and graphs hold the map's own.
using VoxelIndex = Index3<struct VoxelTag>;
/// A cube of 8 x 8 x 8 voxels: block b holds the voxels 8 b .. 8 b + 7.
using BlockIndex = Index3<struct BlockTag>;

/// A voxel inside the allocated blocks of one BlockLayout: slot of the block * 512 + place in it.
using VoxelId = std::uint32_t;
/// Stands for a voxel whose block is not allocated.
inline constexpr VoxelId kNoVoxel = 0xffffffffu;

/// Block that holds a voxel.
constexpr BlockIndex block_of(const VoxelIndex& v) {
  return {v.x >> kBlockBits, v.y >> kBlockBits, v.z >> kBlockBits};
}

/// Place of a voxel inside its block, x fastest.
constexpr int local_of(const VoxelIndex& v) {
  constexpr int m = kBlockSide - 1;
  return (v.x & m) | (v.y & m) << kBlockBits | (v.z & m) << (2 * kBlockBits);
}

/// The voxel at place `local` of a block.
constexpr VoxelIndex voxel_of(const BlockIndex& b, int local) {
  constexpr int m = kBlockSide - 1;
  return {b.x * kBlockSide + (local & m), b.y * kBlockSide + ((local >> kBlockBits) & m),
          b.z * kBlockSide + (local >> (2 * kBlockBits))};
}

/// A well mixed hash, for tables of blocks.
constexpr std::uint64_t hash_of(const BlockIndex& b) {
  std::uint64_t h = static_cast<std::uint32_t>(b.x) * 0x9e3779b97f4a7c15ull;
  h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(b.y)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(b.z)) * 0x94d049bb133111ebull;
  return h ^ (h >> 32);
}
/// For hash tables of blocks.
struct BlockHash {
  /// The hash of a block.
  std::size_t operator()(const BlockIndex& b) const { return hash_of(b); }
};

/// Centre of a voxel, metres, in the frame that the voxel is counted in.
inline Point centre_of(const VoxelIndex& v, double voxel_size) {
  return Point(v.x + 0.5, v.y + 0.5, v.z + 0.5) * voxel_size;
}

/// The largest whole number not above x, within int. (A plain x86-64 has no instruction for it, and
/// std::floor is a call.)
inline int floor_to_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<double>(truncated) > x ? 1 : 0);
}

/// Whether a point is a number, and not so far out that its voxel has no index.
inline bool has_voxel(const Point& p, double voxel_size) {
  return (p.array().abs() < kMaxVoxelIndex * voxel_size).all();
}

/// The voxel that holds a point, counted in the point's frame, for which has_voxel must hold.
inline VoxelIndex voxel_at(const Point& p, double voxel_size) {
  return {floor_to_int(p.x() / voxel_size), floor_to_int(p.y() / voxel_size),
          floor_to_int(p.z() / voxel_size)};
}

/// A point moved by whole voxels, rounded once.
inline Point moved(const Point& p, const VoxelIndex& voxels, double voxel_size) {
  return {std::fma(voxels.x, voxel_size, p.x()), std::fma(voxels.y, voxel_size, p.y()),
          std::fma(voxels.z, voxel_size, p.z())};
}

/// From a map's local frame to the world; of any map that has `origin` and `voxel_size`.
template <typename Map>
Point to_world(const Map& map, const Point& point_local) {
  return moved(point_local, map.origin, map.voxel_size);
}

/// From the world to a map's local frame. Where the world's coordinates are large they cannot name
/// the centres and faces of voxels exactly; those within their rounding of one are taken to mean
/// it. So places that just fit, as on a lattice many do, fit wherever the map lies.
template <typename Map>
Point to_local(const Map& map, const Point& point_world) {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();  // of a coordinate
  if (map.origin == VoxelIndex{}) return point_world;
  const VoxelIndex back = VoxelIndex{} - map.origin;
  Point local = moved(point_world, back, map.voxel_size);
  const double half = 0.5 * map.voxel_size;
  for (int axis = 0; axis < 3; ++axis) {
    const double nearest = std::round(local[axis] / half) * half;
    if (std::abs(local[axis] - nearest) <= kRounding * std::abs(point_world[axis]))
      local[axis] = nearest;
  }
  return local;
}

/// Length of a path from waypoint to waypoint; 0 where it has fewer than two.
inline double length_of(std::span<const Point> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace ridgeway
