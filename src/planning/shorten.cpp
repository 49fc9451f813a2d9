// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "shorten.hpp"

#include <algorithm>

namespace ridgeway::detail {
namespace {

constexpr int kRounds = 8;
constexpr int kBisections = 4;
constexpr double kWorthwhile = 1e-3;  // relative gain that makes another round worth it

/// Skips waypoints: from each one goes on to the farthest that can be seen, found by doubling
/// the stride and then halving it.
std::vector<Point> skip_waypoints(const FreeSpace& space, const std::vector<Point>& path,
                                  double radius) {
  std::vector<Point> result{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t seen = at + 1, blind = path.size();
    for (std::size_t stride = 2; at + stride < path.size(); stride *= 2) {
      if (!space.is_free(path[at], path[at + stride], radius)) {
        blind = at + stride;
        break;
      }
      seen = at + stride;
    }
    if (blind == path.size() && seen + 1 < blind &&
        space.is_free(path[at], path.back(), radius))
      seen = path.size() - 1;
    while (seen + 1 < blind) {
      const std::size_t middle = (seen + blind) / 2;
      (space.is_free(path[at], path[middle], radius) ? seen : blind) = middle;
    }
    result.push_back(path[seen]);
    at = seen;
  }
  return result;
}

/// Moves a corner towards the nearest point of the line between its neighbours, as far as both
/// its segments stay free. True: it can go altogether.
bool draw_in(const FreeSpace& space, const Point& before, Point& corner, const Point& after,
             double radius) {
  if (space.is_free(before, after, radius)) return true;
  const Point along = after - before;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((corner - before).dot(along) / squared, 0.0, 1.0)
                                 : 0.0;
  const Point target = before + t * along;
  double good = 0.0, bad = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (good + bad);
    const Point p = corner + middle * (target - corner);
    const bool free = space.is_free(before, p, radius) && space.is_free(p, after, radius);
    (free ? good : bad) = middle;
  }
  corner += good * (target - corner);
  return false;
}

}  // namespace

double length_of(const std::vector<Point>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::vector<Point> shorten(const FreeSpace& space, std::vector<Point> path, double radius,
                           const Deadline& deadline) {
  if (path.size() < 3) return path;
  path = skip_waypoints(space, path, radius);
  double length = length_of(path);
  for (int round = 0; round < kRounds && path.size() > 2 && !deadline.has_passed(); ++round) {
    for (std::size_t i = 1; i + 1 < path.size();) {
      if (draw_in(space, path[i - 1], path[i], path[i + 1], radius)) {
        path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
    const double before = length;
    length = length_of(path);
    if (length > before * (1.0 - kWorthwhile)) break;
  }
  return path;
}

}  // namespace ridgeway::detail
