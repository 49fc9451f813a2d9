// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "block_rows.hpp"
#include "marked_voxels.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::detail {

/// The way to the nearest obstacle within a voxel's line along x; kNoWay where there is none.
using LineOffset = std::int16_t;
/// The way to the nearest obstacle within a voxel's plane across z; x is kNoWay where there is
/// none.
struct PlaneOffset {
  std::int16_t x = 0;
  std::int16_t y = 0;
  friend constexpr bool operator==(const PlaneOffset&, const PlaneOffset&) = default;
};

/// The same of obstacles that are near.
struct NearLineOffset {
  static constexpr std::int8_t kNoNearWay = -NearSiteOffset::kFarthest - 1;
  std::int8_t x = 0;

  static constexpr bool can_be(LineOffset o) {
    return o == kNoWay || (-NearSiteOffset::kFarthest <= o && o <= NearSiteOffset::kFarthest);
  }
  static constexpr NearLineOffset of(LineOffset o) {
    return {o == kNoWay ? kNoNearWay : static_cast<std::int8_t>(o)};
  }
  // NOLINTNEXTLINE(google-explicit-constructor): the same value
  constexpr operator LineOffset() const { return x == kNoNearWay ? kNoWay : LineOffset{x}; }
};
struct NearPlaneOffset {
  NearLineOffset x, y;

  static constexpr bool can_be(const PlaneOffset& o) {
    return NearLineOffset::can_be(o.x) && NearLineOffset::can_be(o.y);
  }
  static constexpr NearPlaneOffset of(const PlaneOffset& o) {
    return {NearLineOffset::of(o.x), NearLineOffset::of(o.y)};
  }
  // NOLINTNEXTLINE(google-explicit-constructor): the same value
  constexpr operator PlaneOffset() const { return {x, y}; }
};

/// 4 d^2 to it; kNoSite where there is none.
constexpr std::uint32_t line_cost(LineOffset x) {
  return x == kNoWay ? kNoSite : squared_halves(x);
}
constexpr std::uint32_t plane_cost(const PlaneOffset& o) {
  return o.x == kNoWay ? kNoSite : squared_halves(o.x) + squared_halves(o.y);
}

/// A map that changes and the distance field that follows it: the field, and what the sweeps along
/// x and y left, from which those along y and z go on. All fields are on `esdf.layout`; what is
/// farther than `max_distance` is left out by each sweep, as it can be nobody's nearest.
///
/// Offsets are near ones at first, and what is not near is left out too: that is right until a
/// voxel has no near site at all.
struct LiveField {
  EsdfMap esdf;
  OffsetField<NearLineOffset, LineOffset> in_line;
  OffsetField<NearPlaneOffset, PlaneOffset> in_plane;
  bool is_outgrown = false;  ///< a voxel's site is not near: a new field, of any, is to be made
  std::vector<std::uint16_t> known;  ///< voxels whose state is known, by block

  /// By block: 0 where a snapshot has the same memory, which is not to be written to.
  std::vector<std::uint8_t> owns_state, owns_distances;

  // Of the last update, and what it worked with.
  std::vector<std::pair<VoxelId, VoxelState>>
      before;                       ///< voxels whose state changed, and from what
  std::uint32_t first_new = 0;      ///< slots from here on are not swept yet
  std::uint32_t first_of_last = 0;  ///< and from here on they came with the last update
  MarkedVoxels flipped;             ///< those that became obstacles or ceased to be
  MarkedVoxels changed;             ///< those whose distance or site the last update changed
  MarkedVoxels due, passed;         ///< for updates: what a sweep has to look at

  /// Of a map without any block. `near_only`: for sites that are near.
  LiveField(double voxel_size, const VoxelIndex& origin, const EsdfConfig& config, bool near_only);

  /// How far sites count, voxels.
  double farthest() const {
    const double asked = esdf.max_distance / esdf.voxel_size;
    return esdf.site.has_near_only() ? std::min(asked, double{NearSiteOffset::kFarthest}) : asked;
  }
  bool solid_outside() const { return esdf.unknown == UnknownPolicy::kObstacle; }
};

/// Before states, or distances and sites, of a block are written: gives them memory of their own
/// where a snapshot has it. For one thread a block.
void own_state(LiveField& field, std::uint32_t slot);
void own_distances(LiveField& field, std::uint32_t slot);

/// The field for a snapshot, in the same memory, which is copied from now on before it is written.
EsdfMap share(LiveField& field);

/// The map alone: the blocks in which something is known.
OccupancyMap map_of(const LiveField& field);

/// Adds blocks of voxels that are unknown. Where unknown space is solid nothing else changes.
void add_blocks(LiveField& field, std::span<const BlockIndex> blocks);

/// Sets the states of voxels of the lattice, adding the blocks of those that become known; of
/// several changes of one voxel the last counts. Distances do not follow yet.
void apply_changes(LiveField& field, std::span<const VoxelChange> changes);

/// Takes the states back to what they were before the last changes, whatever has failed since.
/// Neither obstacles nor distances follow: a new field is to be made of map_of().
void undo_changes(LiveField& field) noexcept;

/// Gives up the distances, to make room: what is left is of no use, but for its map.
void drop_distances(LiveField& field);

/// Brings the distances up to date after `esdf.obstacle` has changed where `flipped` says. Same
/// bytes as compute_esdf of the whole map, by induction over its three sweeps: a run between
/// obstacles is swept again only where it holds a voxel that the sweep before has changed.
///
/// Where unknown space is ignored, the layout must hold the blocks that sweeps pass through.
/// Where it comes out as `is_outgrown`, the distances are not right.
/// An exception leaves the field of no use, but for its map.
void update_distances(LiveField& field);

}  // namespace ridgeway::detail
