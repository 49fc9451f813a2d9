// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "detour.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

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

}  // namespace

std::optional<Point> find_detour(const EsdfMap& esdf, const FreeSpace& space, const Point& a,
                                 const Point& b, double radius, double budget) {
  std::optional<Point> best;
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
    const double offset = first_fit(esdf, blocked, direction, radius, 0.5 * budget);
    const Point p = blocked + kPlanning.detour_offset * offset * direction;
    const double own = (p - a).norm() + (b - p).norm();
    if (own >= budget || !space.is_free(a, p, radius) || !space.is_free(p, b, radius)) continue;
    best = p;
    budget = own;
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
      const std::optional<Point> detour =
          find_detour(esdf, space, *first, *last, radius, length * (1.0 - kPlanning.tight_gain));
      if (!detour) continue;
      path.insert(path.erase(first + 1, last), *detour);
      stretch = std::min(stretch, path.size() - 1);
    }
    stretch = std::min(stretch, path.size());
  }
  return path;
}

}  // namespace ridgeway::detail
