// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ridgeway/voxel/block_layout.hpp"
#include "ridgeway/voxel/voxel_field.hpp"

namespace ridgeway {

/// What a map knows of a voxel.
enum class VoxelState : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2 };

/// An axis-aligned box, metres, world frame, min <= max in every axis.
struct Box {
  Point min = Point::Zero();  ///< low corner
  Point max = Point::Zero();  ///< high corner
};

/// Voxel states on sparse blocks. Voxels of blocks that are not allocated are unknown.
/// Invariant: `state` has one value for every voxel of `layout`; voxel_size > 0 and finite; no
/// known voxel lies farther than 1e9 voxels from the world's zero.
/// What makes maps of files, of worlds and of other maps puts the origin at the lowest known voxel
/// of each axis (normalised, mapping/occupancy_builder.hpp): then a map that is moved by whole
/// voxels is the same but for its origin, and so is all that is made of it.
struct OccupancyMap {
  double voxel_size = 0.0;       ///< metres
  VoxelIndex origin = {};        ///< the lattice's voxel that is the map's own (0, 0, 0)
  BlockLayout layout;            ///< of the map's own voxels
  VoxelField<VoxelState> state;  ///< of each voxel of the layout
  /// Of a robot that stays in a plane (flatten): all known voxels are in the blocks with z = 0,
  /// whose eight layers are the same. They stand for one.
  bool planar = false;

  /// Of one of the map's own voxels.
  VoxelState at(const VoxelIndex& voxel) const {
    const VoxelId id = layout.find(voxel);
    return id == kNoVoxel ? VoxelState::kUnknown : state[id];
  }
};

/// A voxel of the lattice, and the state that it now has.
struct VoxelChange {
  VoxelIndex voxel;                         ///< of the lattice
  VoxelState state = VoxelState::kUnknown;  ///< that it now has

  /// Equal in every field.
  friend bool operator==(const VoxelChange&, const VoxelChange&) = default;
};

/// How many voxels are in each state; `unknown` counts allocated blocks only.
struct VoxelCounts {
  std::size_t free = 0;      ///< free voxels
  std::size_t occupied = 0;  ///< occupied voxels
  std::size_t unknown = 0;   ///< unknown voxels of allocated blocks
  /// Free and occupied ones together.
  std::size_t known() const { return free + occupied; }
};
VoxelCounts count_voxels(const OccupancyMap& map);  ///< Looks at every state.

/// Box around all known voxels, in the world, or nothing where none is known; of a planar map as
/// high as the one layer that robots are in.
std::optional<Box> known_bounds(const OccupancyMap& map);

/// Voxels min .. max, both included; empty where max < min in some axis.
struct VoxelRange {
  VoxelIndex min;  ///< the first voxel, along each axis
  VoxelIndex max;  ///< the last one

  /// Equal in every field.
  friend bool operator==(const VoxelRange&, const VoxelRange&) = default;
  /// Whether it holds no voxel.
  bool empty() const { return max.x < min.x || max.y < min.y || max.z < min.z; }
  /// Whether a voxel is one of them.
  bool contains(const VoxelIndex& v) const {
    return v.x >= min.x && v.x <= max.x && v.y >= min.y && v.y <= max.y && v.z >= min.z &&
           v.z <= max.z;
  }
  /// How many blocks the range touches; as a double, for it may be astronomic.
  double block_count() const;
};

/// All voxels that a map can hold, counted from the lattice's zero or from the map's origin.
inline constexpr VoxelRange kAllVoxels = {{-kMaxVoxelIndex, -kMaxVoxelIndex, -kMaxVoxelIndex},
                                          {kMaxVoxelIndex, kMaxVoxelIndex, kMaxVoxelIndex}};

/// Voxels that are in both ranges.
VoxelRange intersection(const VoxelRange& a, const VoxelRange& b);
/// The range grown by a number of voxels on all sides, within kAllVoxels.
VoxelRange grown(const VoxelRange& range, std::int64_t voxels);
/// The range moved by a number of voxels, at most 2 kMaxVoxelIndex along an axis; ends beyond that
/// from zero stay there.
VoxelRange moved(const VoxelRange& range, const VoxelIndex& voxels);

/// Throws InputError, naming `name`, where a range of the lattice reaches beyond kAllVoxels.
void require_within_reach(const VoxelRange& range, const std::string& name);

/// The map's own voxels around all known ones; empty where none is known.
VoxelRange known_range(const OccupancyMap& map);

/// Throws InputError, naming `name` and the value, where a coordinate is not a number or min > max.
/// Infinite coordinates are fine: they mean "no limit".
void validate_box(const Box& box, const std::string& name);

/// Voxels of the lattice that lie wholly inside a box, with a slack of 1e-6 voxels.
VoxelRange voxels_inside(const Box& box, double voxel_size);

/// Voxels of the lattice that share volume with a box, with a slack of 1e-6 voxels. A box without
/// extent along an axis counts as lying in the voxel that holds its coordinate.
VoxelRange voxels_overlapping(const Box& box, double voxel_size);

}  // namespace ridgeway
