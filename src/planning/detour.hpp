// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <vector>

#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Looks for a corner beside the obstacle that blocks the straight line from a to b: rays fan out
/// from the blocked place, across the line, to somewhat beyond where the robot first fits. The one
/// with the shortest way over it, shorter than `budget`, metres; of a free line a place on it.
std::optional<Point> find_detour(const EsdfMap& esdf, const FreeSpace& space, const Point& a,
                                 const Point& b, double radius, double budget);

/// Looks past the corners of a shortened path: where a stretch of it is much longer than the
/// straight line, tries ways on other sides of what blocks the line, and keeps those that are
/// shorter.
std::vector<Point> redirect(const EsdfMap& esdf, const FreeSpace& space, std::vector<Point> path,
                            double radius, const Deadline& deadline);

}  // namespace ridgeway::detail
