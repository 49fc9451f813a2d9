// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// What unknown space is to the robot.
enum class UnknownPolicy : std::uint8_t {
  kObstacle = 0,  ///< as solid as a wall: a sphere of the robot's radius never reaches into it
  kIgnore = 1,    ///< pushes no distances, but a path stays in known-free voxels
  kFree = 2,      ///< as free as what was seen to be, in the box of blocks around what is known
};

/// Whether voxels of a state are obstacles: what is occupied, and under UnknownPolicy::kObstacle
/// what is unknown, allocated or not. No branches, so that loops over states become vector code.
constexpr bool is_obstacle(VoxelState state, UnknownPolicy unknown) {
  return (state == VoxelState::kOccupied) |
         ((state == VoxelState::kUnknown) & (unknown == UnknownPolicy::kObstacle));
}

/// Whether the robot's centre may be in voxels of a state at all.
constexpr bool is_open(VoxelState state, UnknownPolicy unknown) {
  return (state == VoxelState::kFree) |
         ((state == VoxelState::kUnknown) & (unknown == UnknownPolicy::kFree));
}

/// Throws InputError where a policy is no enumerator.
void validate_policy(UnknownPolicy policy);

/// Longest distance that is ever stored, voxels; farther voxels have no site.
inline constexpr int kFarthestSite = 16000;

/// Offset from a voxel to its nearest site, voxels.
struct SiteOffset {
  static constexpr int kFarthest = kFarthestSite;  ///< the longest part

  std::int16_t x = 0;  ///< along x
  std::int16_t y = 0;  ///< along y
  std::int16_t z = 0;  ///< along z
  /// Equal in every field.
  friend constexpr bool operator==(const SiteOffset&, const SiteOffset&) = default;
};

/// The same in half the memory, where no part of it is longer than kFarthest.
struct NearSiteOffset {
  static constexpr int kFarthest = 127;  ///< the longest part

  std::int8_t x = 0;  ///< along x
  std::int8_t y = 0;  ///< along y
  std::int8_t z = 0;  ///< along z

  /// Whether an offset can be one.
  static constexpr bool can_be(const SiteOffset& o) {
    const auto fits = [](int k) { return -kFarthest <= k && k <= kFarthest; };
    return fits(o.x) && fits(o.y) && fits(o.z);
  }
  /// Of one that can.
  static constexpr NearSiteOffset of(const SiteOffset& o) {
    return {static_cast<std::int8_t>(o.x), static_cast<std::int8_t>(o.y),
            static_cast<std::int8_t>(o.z)};
  }
  /// As any offset.
  // NOLINTNEXTLINE(google-explicit-constructor): the same value
  constexpr operator SiteOffset() const { return {x, y, z}; }
  /// Equal in every field.
  friend constexpr bool operator==(const NearSiteOffset&, const NearSiteOffset&) = default;
};

/// From each voxel to its nearest site.
using SiteField = OffsetField<NearSiteOffset, SiteOffset>;

/// A squared distance as the field has it, in squared half voxels: 4 d^2 / s^2, which is a whole
/// number from a voxel's centre to a closed cube. Larger is farther; numbers of other units neither
/// compare with it nor turn into it unasked.
struct SquaredHalves {
  double value = 0.0;  ///< squared half voxels

  constexpr SquaredHalves() = default;
  /// Of a number in that unit.
  constexpr explicit SquaredHalves(double squared_halves) : value(squared_halves) {}
  /// Of a number that the field holds.
  template <std::same_as<std::uint32_t> OfField>
  // NOLINTNEXTLINE(google-explicit-constructor): the unit is the same
  constexpr SquaredHalves(OfField squared_halves) : value(squared_halves) {}

  /// The distance itself, metres.
  double metres(double voxel_size) const { return 0.5 * voxel_size * std::sqrt(value); }

  /// By the number.
  friend constexpr auto operator<=>(const SquaredHalves&, const SquaredHalves&) = default;
};

/// Squared distance from a voxel's centre to the closed cube at an offset, in squared half voxels:
/// the sum over the axes of max(2 |k| - 1, 0)^2.
constexpr std::uint32_t squared_halves(int k) {
  const int twice = 2 * (k < 0 ? -k : k) - (k != 0);  // no branch: zero is hard to foresee
  return static_cast<std::uint32_t>(twice) * static_cast<std::uint32_t>(twice);
}
/// The sum over the axes, to the cube at an offset from a voxel.
constexpr std::uint32_t squared_halves(const SiteOffset& o) {
  return squared_halves(o.x) + squared_halves(o.y) + squared_halves(o.z);
}

/// Where the robot's centre may be. Limits are no walls: whatever the robot's size, its centre may
/// go up to them, and no distance to them is kept. Metres; within 10 nanometres is on the face.
/// A place is within where it is in `keep_in`, faces included, and in the inside of no box of
/// `keep_out`. A voxel is within where its centre is in `keep_in` and no part of it is in a box of
/// `keep_out`: so all moves between such voxels are within, too.
struct FlightLimits {
  /// The box that flights stay in; infinite: everywhere
  Box keep_in = {Point::Constant(-std::numeric_limits<double>::infinity()),
                 Point::Constant(std::numeric_limits<double>::infinity())};
  std::vector<Box> keep_out;  ///< boxes that they stay out of

  bool any() const;  ///< whether there is one at all
  /// Whether a place is within.
  bool allow(const Point& p) const { return allow(p, p); }
  bool allow(const Point& a, const Point& b) const;  ///< all of a segment
  bool allow(std::span<const Point> path) const;     ///< all of a path of straight segments
  /// Whether a voxel of a size, counted in the frame of the limits, is within.
  bool allow_voxel(const VoxelIndex& voxel, double voxel_size) const;
  /// Whether a segment stays in `keep_in`, and at least `margin` metres away from every box of
  /// `keep_out` along some axis.
  bool allow(const Point& a, const Point& b, double margin) const;
  bool keeps_in(const Point& p) const;  ///< whether it is in `keep_in`
  /// The nearest place in `keep_in`.
  Point nearest_within(const Point& p) const {
    return p.cwiseMax(keep_in.min).cwiseMin(keep_in.max);
  }

  /// Throws InputError naming the bad field: a box of which a coordinate is not a number, or whose
  /// corners are swapped; `keep_in` that holds nothing; a box of `keep_out` without volume.
  void validate() const;

  friend bool operator==(const FlightLimits& a, const FlightLimits& b);  ///< Equal in every field.
};

/// Limits that hold where both do.
FlightLimits both_of(const FlightLimits& a, const FlightLimits& b);

struct EsdfMap;
/// Limits of the world in a map's local frame. In a planar map heights play no part: boxes reach
/// through its layer, whatever theirs.
FlightLimits limits_in_local(const EsdfMap& esdf, const FlightLimits& limits_world);
/// Those of the map, in the world.
FlightLimits limits_in_world(const EsdfMap& esdf);
/// Whether limits (local) of a map say more than which layer a planar one has.
bool has_flight_limits(const EsdfMap& esdf, FlightLimits limits);
/// Throws InputError where `keep_in` (local) is so flat that it holds the centre of no voxel.
void require_room(const EsdfMap& esdf, const FlightLimits& limits);

/// The layer of a planar map's blocks that robots are in: one with others on both sides.
inline constexpr int kPlanarLayer = 3;
/// `squared` of a voxel without a site.
inline constexpr std::uint32_t kNoSite = 0xffffffffu;

/// Euclidean distance field over the blocks of a map (method: exact distances from voxel centres
/// to closed obstacle cubes; ties between sites go to the smallest (z, y, x)).
/// Invariants: obstacle voxels have `squared` 0 and `site` {0,0,0}; a voxel farther than
/// `max_distance` from every obstacle has `squared` kNoSite.
struct EsdfMap {
  double voxel_size = 0.0;  ///< metres
  VoxelIndex origin = {};   ///< the lattice's voxel that is the map's own (0, 0, 0); to_world()
  UnknownPolicy unknown = UnknownPolicy::kObstacle;  ///< what unknown space was taken for
  double max_distance = std::numeric_limits<double>::infinity();  ///< metres
  FlightLimits limits;  ///< of every flight on this map, in its local frame
  /// Of a planar map: distances count along x and y alone, and flights stay at the centre of the
  /// layer kPlanarLayer.
  bool planar = false;
  BlockLayout layout;                 ///< of the map's own voxels
  VoxelField<VoxelState> state;       ///< what the map knows of each
  VoxelField<std::uint32_t> squared;  ///< to the site, squared half voxels (SquaredHalves)
  SiteField site;                     ///< from each to its nearest obstacle
  VoxelMask obstacle;                 ///< those that are obstacles

  /// Whether the robot's centre may be in a voxel; never in kNoVoxel.
  bool is_open(VoxelId id) const { return id != kNoVoxel && ridgeway::is_open(state[id], unknown); }
  /// Whether a voxel is an obstacle, kNoVoxel being unknown.
  bool is_obstacle(VoxelId id) const {
    return id == kNoVoxel ? ridgeway::is_obstacle(VoxelState::kUnknown, unknown)
                          : obstacle.test(id);
  }
  /// Distance from a voxel's centre to the nearest obstacle cube, metres; infinite without a site.
  double distance(VoxelId id) const {
    return squared[id] == kNoSite ? std::numeric_limits<double>::infinity()
                                  : SquaredHalves(squared[id]).metres(voxel_size);
  }
  /// 4 d^2 / s^2 of that, and of a voxel without a site what it is at least.
  SquaredHalves known_squared(VoxelId id) const {
    if (squared[id] != kNoSite) return squared[id];
    const double far = std::min(max_distance / voxel_size, static_cast<double>(kFarthestSite));
    return SquaredHalves(4.0 * far * far);
  }
};

/// Whether voxel i of a block is of the map: a planar one fills its blocks with copies of its
/// layer.
inline bool is_of_map(const EsdfMap& esdf, int i) {
  return !esdf.planar || i / (kBlockSide * kBlockSide) == kPlanarLayer;
}

/// A place of the world in a map's local frame, where a robot flies: in a planar map at the height
/// of its layer, whatever its own.
inline Point flight_place(const EsdfMap& esdf, const Point& point_world) {
  Point place = to_local(esdf, point_world);
  if (esdf.planar) place.z() = (kPlanarLayer + 0.5) * esdf.voxel_size;
  return place;
}

/// The least distance at which a voxel counts as free at a radius: inclusive, with a relative slack
/// of 1e-9 on the radius, so that r / s a whole number is no matter of rounding.
inline SquaredHalves least_clearance(double radius, double voxel_size) {
  const double r = radius * (1.0 - 1e-9) / voxel_size;
  return SquaredHalves(4.0 * r * r);
}

/// What distances are measured to, and how far.
struct EsdfConfig {
  UnknownPolicy unknown = UnknownPolicy::kObstacle;  ///< what unknown space is to the robot
  double max_distance = std::numeric_limits<double>::infinity();  ///< metres
  FlightLimits limits = {};  ///< world frame; they change no distance

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Exact Euclidean distances and nearest sites for all allocated voxels, batch: three separable
/// sweeps, linear in voxels, parallel, the same bytes for any number of threads. The field
/// keeps the map's origin.
///
/// Under UnknownPolicy::kIgnore the result also allocates the blocks around the map's blocks, so
/// that every known voxel has its 26 neighbours, in a plane 8; under kFree all blocks of the box
/// around those in which something is known. Throws InputError where memory would not do.
///
/// The map is taken by value, as its states become the field's: who moves it in spares a byte a
/// voxel, who hands in a copy keeps the map.
EsdfMap compute_esdf(OccupancyMap map, const EsdfConfig& config = {});

/// Largest robot radius, metres, that the distances of a map are known far enough for: infinite
/// unless it was computed with a max_distance.
double largest_radius(const EsdfMap& esdf);

/// The occupancy that a distance field was computed from, a copy.
OccupancyMap occupancy_of(const EsdfMap& esdf);

}  // namespace ridgeway
