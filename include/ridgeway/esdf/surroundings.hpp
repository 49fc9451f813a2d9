// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {

/// What a path runs beside, whatever the map's policy takes for an obstacle.
struct PathSurroundings {
  /// Smallest distance along the path to an occupied voxel, and to one that is unknown, allocated
  /// or not, metres; exact. Infinite where there is none, or no path.
  double known = std::numeric_limits<double>::infinity();
  double unknown = std::numeric_limits<double>::infinity();  ///< see `known`
  /// Share of the path's length that is nearer to unknown space than the radius asked for: that of
  /// some radius within a sixteenth of a voxel of it, and none at all where all keeps the radius.
  double unknown_share = 0.0;
  /// Share of the path's length in unknown voxels: 0 but where unknown space is taken for free.
  double unknown_inside = 0.0;
};

/// Measures paths against known obstacles and against unknown space, apart. Made in time linear in
/// voxels (a look at every state); a path then takes a fraction of a millisecond, and more where it
/// runs beside the unknown for long: often more than a query, so that plan() leaves it to whoever
/// wants to know. A view: the EsdfMap must outlive it. Thread-safe.
class Surroundings {
 public:
  explicit Surroundings(const EsdfMap& esdf);  ///< Looks through all states of the map.
  explicit Surroundings(const EsdfMap&&) = delete;

  /// `path`: points joined by straight segments, metres, world frame. `radius`: metres, above 0.
  /// Throws InputError for points beyond all maps.
  PathSurroundings along(std::span<const Point> path, double radius) const;

 private:
  struct Kind;  ///< the voxels of one state
  class Nearest;

  std::shared_ptr<const Kind> voxels_of(VoxelState state) const;

  const EsdfMap& esdf_;
  std::shared_ptr<const Kind> known_, unknown_;
};

}  // namespace ridgeway
