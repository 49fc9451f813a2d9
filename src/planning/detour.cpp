// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "detour.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"

namespace ridgeway::detail {
namespace {

/// Distance at the centre of the point's voxel, metres; 0 where nothing is known.
double rough_distance(const EsdfMap& esdf, const Point& p) {
  const VoxelId id = esdf.layout.find(voxel_at(p, esdf.voxel_size));
  if (!esdf.is_open(id)) return 0.0;
  return esdf.distance(id);
}

/// How far along a ray the robot first fits, about; beyond `farthest` where it does not.
double first_fit(const EsdfMap& esdf, const Point& origin, const Point& direction, double radius,
                 double farthest) {
  double along = 0.0;
  while (along <= farthest) {
    const double lack = radius - rough_distance(esdf, origin + along * direction);
    if (lack <= 0.0) return along;
    along += std::max(lack, 0.5 * esdf.voxel_size);
  }
  return along;
}

struct Way {
  std::vector<Point> corners;
  bool free = false;
};

/// The straight line, or a way with corners beside it.
Way way_between(const EsdfMap& esdf, const FreeSpace& space, const Point& a, const Point& b,
                double radius, double budget, int corners) {
  if (space.is_free(a, b, radius)) return {{}, true};
  if (corners == 0) return {};
  Detour detour = find_detour(esdf, space, a, b, radius, budget, corners);
  return {std::move(detour.corners), detour.length > 0.0};
}

}  // namespace

Detour find_detour(const EsdfMap& esdf, const FreeSpace& space, const Point& a, const Point& b,
                   double radius, double budget, int corners) {
  Detour best;
  const double length = (b - a).norm();
  if (length < esdf.voxel_size || budget <= length) return best;
  const Point along = (b - a) / length;
  const double from = space.free_length(a, b, radius);
  const double to = length - space.free_length(b, a, radius);
  const Point blocked = a + 0.5 * (from + to) * along;
  const Point u = along.unitOrthogonal(), v = along.cross(u);
  for (int ray = 0; ray < kPlanning.detour_rays; ++ray) {
    const double angle = 2.0 * std::numbers::pi * ray / kPlanning.detour_rays;
    const Point direction = std::cos(angle) * u + std::sin(angle) * v;
    const auto length_over = [&](const Point& p) { return (p - a).norm() + (b - p).norm(); };
    const double farthest = 0.5 * budget;
    double offset = first_fit(esdf, blocked, direction, radius, farthest);
    for (int attempt = 0; attempt < kPlanning.detour_tries;
         ++attempt, offset *= kPlanning.detour_widening) {
      const Point p = blocked + offset * direction;
      const double limit = best.found() ? best.length : budget;
      if (offset > farthest || length_over(p) >= limit) break;
      if (!space.is_free(p, radius)) continue;
      const double left = (p - a).norm(), right = (b - p).norm();
      const bool left_free = space.is_free(a, p, radius);
      if (!left_free && corners < 2) continue;
      Way way_left{{}, left_free};
      const Way way_right =
          way_between(esdf, space, p, b, radius, limit - left, left_free ? corners - 1 : 0);
      if (!way_right.free) continue;
      if (!left_free) way_left = way_between(esdf, space, a, p, radius, limit - right, corners - 1);
      if (!way_left.free) continue;
      Detour found;
      found.corners = std::move(way_left.corners);
      found.corners.push_back(p);
      found.corners.insert(found.corners.end(), way_right.corners.begin(), way_right.corners.end());
      Point last = a;
      for (const Point& corner : found.corners) {
        found.length += (corner - last).norm();
        last = corner;
      }
      found.length += (b - last).norm();
      if (found.length < limit) best = std::move(found);
      break;
    }
  }
  return best;
}

std::vector<Point> redirect(const EsdfMap& esdf, const FreeSpace& space, std::vector<Point> path,
                            double radius, const Deadline& deadline) {
  const double total = length_of(path);
  // The longest stretches first: what they find makes the shorter ones needless.
  for (std::size_t stretch = std::min(kPlanning.detour_stretch, path.size() - 1); stretch >= 2;
       --stretch) {
    for (std::size_t i = 0; i + stretch < path.size() && !deadline.has_passed(); ++i) {
      const auto first = path.begin() + static_cast<std::ptrdiff_t>(i);
      const auto last = first + static_cast<std::ptrdiff_t>(stretch);
      const double length = length_of(std::span<const Point>(&*first, stretch + 1));
      if (length - (*last - *first).norm() < (kPlanning.near - 1.0) * total) continue;
      const Detour detour =
          find_detour(esdf, space, *first, *last, radius, length * (1.0 - kPlanning.tight_gain),
                      kPlanning.detour_corners);
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
