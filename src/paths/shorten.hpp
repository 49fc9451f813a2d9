// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "deadline.hpp"
#include "planning_constants.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway::detail {

/// Whether a stretch of a path may become another with the same ends; null: any may.
using MayReplace = std::function<bool(std::span<const Point>, std::span<const Point>)>;

/// Pulls a free path tight: skips waypoints, then draws the remaining corners in. Every segment of
/// the result is free at the radius.
std::vector<Point> shorten(const FreeSpace& space, std::vector<Point> path, double radius,
                           const Deadline& deadline, const MayReplace& may_replace = {});

/// Its first half: from each waypoint goes on to about the farthest that can be seen, found by
/// doubling the stride and then halving it, until an eighth of it is left in doubt. What is left
/// once time is up stays as it is.
std::vector<Point> skip_waypoints(const FreeSpace& space, std::vector<Point> path, double radius,
                                  const Deadline& deadline, const MayReplace& may_replace = {});

/// How closely corners are drawn in.
struct DrawingIn {
  double worthwhile = kPlanning.tight_gain;  ///< of the path's length: what a move must gain
  /// Waypoints between which the path is tight: those inside are tried only once others move.
  std::size_t settled_first = 0, settled_last = 0;
};

/// Its second half: moves each corner along its segments and towards the line between its
/// neighbours as far as they stay free, until that gains next to nothing.
std::vector<Point> draw_corners_in(const FreeSpace& space, const std::vector<Point>& path,
                                   double radius, const Deadline& deadline,
                                   const MayReplace& may_replace = {},
                                   const DrawingIn& drawing = {});

}  // namespace ridgeway::detail
