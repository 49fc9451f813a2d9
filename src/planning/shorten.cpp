// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "shorten.hpp"

#include <algorithm>
#include <array>

#include "detour.hpp"

namespace ridgeway::detail {
namespace {

constexpr int kRounds = 8;
constexpr int kBisections = 4;
constexpr double kWorthwhile = 1e-3;  // relative gain that makes another round worth it
constexpr double kStep = 0.25;        // metres between the places that skipping may choose from
constexpr double kSuspicious = 1.02;  // over the straight line: a stretch worth a detour search
constexpr int kDetourCorners = 2;

/// Skips waypoints: from each one goes on to the farthest that can be seen, found by doubling
/// the stride and then halving it.
std::vector<Point> skip_waypoints(const FreeSpace& space, const std::vector<Point>& path,
                                  double radius, const MayReplace& may_replace) {
  const auto can_skip = [&](std::size_t from, std::size_t to) {
    if (!space.is_free(path[from], path[to], radius)) return false;
    return !may_replace || may_replace(std::span(path).subspan(from, to - from + 1),
                                       std::array{path[from], path[to]});
  };
  std::vector<Point> result{path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t seen = at + 1, blind = path.size();
    for (std::size_t stride = 2; at + stride < path.size(); stride *= 2) {
      if (!can_skip(at, at + stride)) {
        blind = at + stride;
        break;
      }
      seen = at + stride;
    }
    if (blind == path.size() && seen + 1 < blind && can_skip(at, path.size() - 1))
      seen = path.size() - 1;
    while (seen + 1 < blind) {
      const std::size_t middle = (seen + blind) / 2;
      (can_skip(at, middle) ? seen : blind) = middle;
    }
    result.push_back(path[seen]);
    at = seen;
  }
  return result;
}

/// Points along a path no farther apart than a step.
std::vector<Point> subdivide(const std::vector<Point>& path, double step) {
  std::vector<Point> result{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point& from = path[i - 1];
    const Point along = path[i] - from;
    const int pieces = static_cast<int>(along.norm() / step) + 1;
    for (int k = 1; k < pieces; ++k) result.emplace_back(from + along * k / pieces);
    result.push_back(path[i]);
  }
  return result;
}

/// Largest share in [0, 1) found by halving at which `is_free` holds; it holds at 0.
template <typename IsFree>
double largest_free_share(const IsFree& is_free) {
  double good = 0.0, bad = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (good + bad);
    (is_free(middle) ? good : bad) = middle;
  }
  return good;
}

/// Moves a corner where that shortens the way over it: along one of its two segments, or towards
/// the line between its neighbours, as far as it stays free. True: it can go altogether.
bool draw_in(const FreeSpace& space, const Point& before, Point& corner, const Point& after,
             double radius, const MayReplace& may_replace) {
  const auto may_become = [&, old = std::array{before, corner, after}](const auto& stretch) {
    return !may_replace || may_replace(old, stretch);
  };
  if (space.is_free(before, after, radius) && may_become(std::array{before, after})) return true;
  // Along its own segments first: one of the two new segments is part of an old one.
  const double back = largest_free_share([&](double share) {
    const Point p = corner + share * (before - corner);
    return space.is_clearly_free(p, after, radius) && may_become(std::array{before, p, after});
  });
  const double on = largest_free_share([&](double share) {
    const Point p = corner + share * (after - corner);
    return space.is_clearly_free(before, p, radius) && may_become(std::array{before, p, after});
  });
  const Point backward = corner + back * (before - corner);
  const Point onward = corner + on * (after - corner);
  const auto length_over = [&](const Point& p) { return (p - before).norm() + (after - p).norm(); };
  corner = length_over(backward) < length_over(onward) ? backward : onward;
  const Point along = after - before;
  const double squared = along.squaredNorm();
  const double t =
      squared > 0.0 ? std::clamp((corner - before).dot(along) / squared, 0.0, 1.0) : 0.0;
  const Point target = before + t * along;
  const double in = largest_free_share([&](double share) {
    const Point p = corner + share * (target - corner);
    return space.is_clearly_free(before, p, radius) && space.is_clearly_free(p, after, radius) &&
           may_become(std::array{before, p, after});
  });
  corner += in * (target - corner);
  return false;
}

}  // namespace

double length_of(const std::vector<Point>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::vector<Point> shorten(const FreeSpace& space, std::vector<Point> path, double radius,
                           const Deadline& deadline, const MayReplace& may_replace) {
  if (path.size() < 3) return path;
  for (int direction = 0; direction < 2; ++direction) {  // what one end cannot see, the other may
    path = skip_waypoints(space, subdivide(path, kStep), radius, may_replace);
    std::reverse(path.begin(), path.end());
  }
  double length = length_of(path);
  for (int round = 0; round < kRounds && path.size() > 2 && !deadline.has_passed(); ++round) {
    for (std::size_t i = 1; i + 1 < path.size();) {
      if (draw_in(space, path[i - 1], path[i], path[i + 1], radius, may_replace)) {
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

std::vector<Point> redirect(const EsdfMap& esdf, const FreeSpace& space, std::vector<Point> path,
                            double radius, const Deadline& deadline) {
  // The longest stretches first: what they find makes the shorter ones needless.
  for (std::size_t stretch = path.size() - 1; stretch >= 2; --stretch) {
    for (std::size_t i = 0; i + stretch < path.size() && !deadline.has_passed(); ++i) {
      const auto first = path.begin() + static_cast<std::ptrdiff_t>(i);
      const auto last = first + static_cast<std::ptrdiff_t>(stretch);
      double length = 0.0;
      for (auto p = first; p != last; ++p) length += (*(p + 1) - *p).norm();
      if (length < kSuspicious * (*last - *first).norm()) continue;
      const Detour detour = find_detour(esdf, space, *first, *last, radius,
                                        length * (1.0 - kWorthwhile), kDetourCorners);
      if (!detour.found()) continue;
      const auto place = path.erase(first + 1, last);
      path.insert(place, detour.corners.begin(), detour.corners.end());
      stretch = std::min(stretch, path.size() - 1);
    }
    stretch = std::min(stretch, path.size());
  }
  return path;
}

}  // namespace ridgeway::detail
