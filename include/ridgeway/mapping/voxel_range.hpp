// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// Voxels min .. max, both included; empty where max < min in some axis.
struct VoxelRange {
  VoxelIndex min;
  VoxelIndex max;

  friend bool operator==(const VoxelRange&, const VoxelRange&) = default;
  bool empty() const { return max.x < min.x || max.y < min.y || max.z < min.z; }
  bool contains(const VoxelIndex& v) const {
    return v.x >= min.x && v.x <= max.x && v.y >= min.y && v.y <= max.y && v.z >= min.z &&
           v.z <= max.z;
  }
  /// How many blocks the range touches; as a double, for it may be astronomic.
  double block_count() const;
};

/// All voxels that a map can hold, of the lattice and counted from its origin.
inline constexpr VoxelRange kAllVoxels = {{-kMaxVoxelIndex, -kMaxVoxelIndex, -kMaxVoxelIndex},
                                          {kMaxVoxelIndex, kMaxVoxelIndex, kMaxVoxelIndex}};

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
