// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "escape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "places_around.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kFarthest = 2.0;           // radii
constexpr double kEscapeStep = 1.0 / 32.0;  // voxels between looks at the distance
constexpr double kEnd = 1e-3;               // voxels before the end, for a last look
constexpr double kLeastDistance = 1e-6;     // metres: what is less may be none but for rounding
constexpr double kEscapeSlack = 1e-9;       // metres; rounding
constexpr int kBetweenLooksAtTheClock = 256;

/// Whether the distance to obstacles never falls from a to b, by looks at most so many metres
/// apart. False where time is up.
bool rises_in_steps(const FreeSpace& space, const Point& a, const Point& b, double step,
                    const Deadline& deadline) {
  const double steps = 1.0 + std::floor((b - a).norm() / step);
  double last = space.distance(a);
  int looks = 0;
  for (double k = 1.0; k <= steps; ++k) {
    const double here = space.distance(a + (b - a) * (k / steps));
    if (here < last - kEscapeSlack) return false;
    if (++looks % kBetweenLooksAtTheClock == 0 && deadline.has_passed()) return false;
    last = here;
  }
  return true;
}

/// Whether it never falls by half a small step or more, as between two looks it changes by no more
/// than the way, nor at the very end, nor below what it is at `a`. Most that fall show it in steps
/// of a voxel.
bool rises(const FreeSpace& space, const Point& a, const Point& b, const Deadline& deadline) {
  const double voxel = space.map().voxel_size;
  if (!rises_in_steps(space, a, b, voxel, deadline) ||
      !rises_in_steps(space, a, b, kEscapeStep * voxel, deadline))
    return false;
  const double end = std::min(kEnd * voxel / (b - a).norm(), 0.5);
  return space.distance(b) >= space.distance(b + end * (a - b)) - kEscapeSlack &&
         space.clearance(a, b) >= space.distance(a) - kEscapeSlack;
}

}  // namespace

EscapeResult find_escape(const FreeSpace& space, const Point& point, double radius,
                         const Deadline& deadline) {
  const EsdfMap& esdf = space.map();
  if (!(space.distance(point) >= kLeastDistance)) return {};
  PlacesAround places(esdf, point, space.inner_radius(radius), kFarthest * radius);
  for (std::optional<Point> place; !deadline.has_passed() && (place = places.next(deadline));)
    if (space.is_known_free(point, *place) && space.is_within_limits(point, *place) &&
        space.is_free(*place, radius) && rises(space, point, *place, deadline))
      return {SearchStatus::kFound, *place};
  return {deadline.has_passed() ? SearchStatus::kTimeout : SearchStatus::kNoRoute};
}

}  // namespace ridgeway::detail
