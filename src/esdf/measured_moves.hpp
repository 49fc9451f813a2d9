// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>

#include "ridgeway/voxel/voxel_mask.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {

class RememberedSpace;

/// A move between neighbours: the voxel from which, 32 times, and the direction, above kCentre.
using OfMove = std::uint64_t;

inline OfMove move_from(VoxelId from, int direction) {
  return std::uint64_t{from} << 5 | static_cast<unsigned>(direction);
}

/// Clearances of the moves between voxels of a set that take a look at obstacles, measured by all
/// threads: for what goes through the voxels one by one.
class MeasuredMoves {
 public:
  MeasuredMoves(const RememberedSpace& space, const VoxelMask& among);

  /// 4 d^2 / s^2 at the narrowest place, or null where it has not been measured.
  const double* find(OfMove move) const { return clearance_.find(move, mixed(move)); }

 private:
  FlatTable<OfMove, double> clearance_;
};

}  // namespace ridgeway::detail
