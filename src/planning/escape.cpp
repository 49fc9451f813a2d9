// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "escape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ridgeway::detail {
namespace {

constexpr double kFarthest = 2.0;     // radii
constexpr double kStep = 1.0 / 32.0;  // voxels between looks at the distance
constexpr double kEnd = 1e-3;         // voxels before the end, for a last look
constexpr double kSlack = 1e-9;       // metres; rounding

/// Traversable voxel centres around a point, nearest first.
std::vector<Point> places_around(const EsdfMap& esdf, const Point& point, double radius) {
  const double threshold = squared_threshold(radius, esdf.voxel_size);
  const double farthest = kFarthest * radius;
  const int reach = static_cast<int>(std::ceil(farthest / esdf.voxel_size));
  const VoxelIndex home = voxel_at(point, esdf.voxel_size);
  VoxelFinder finder(esdf.layout);
  std::vector<std::pair<double, Point>> places;
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const VoxelIndex voxel = home + VoxelIndex{x, y, z};
        const Point centre = centre_of(voxel, esdf.voxel_size);
        const double distance = (centre - point).norm();
        if (distance > farthest || distance == 0.0) continue;
        const VoxelId id = finder.find(voxel);
        if (id == kNoVoxel || esdf.state[id] != VoxelState::kFree || esdf.squared[id] < threshold)
          continue;
        places.emplace_back(distance, centre);
      }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Point> result;
  result.reserve(places.size());
  for (const auto& [distance, place] : places) result.push_back(place);
  return result;
}

/// Whether the distance to obstacles never falls from a to b. What falls goes on falling for more
/// than a step, but for the last one, which is looked at once more just before its end.
bool rises(const FreeSpace& space, const Point& a, const Point& b, double voxel_size) {
  const double length = (b - a).norm();
  const auto distance_at = [&](double share) { return space.distance(a + (b - a) * share); };
  const int steps = 1 + static_cast<int>(length / (kStep * voxel_size));
  double last = distance_at(0.0);
  for (int k = 1; k <= steps; ++k) {
    const double here = distance_at(static_cast<double>(k) / steps);
    if (here < last - kSlack) return false;
    last = here;
  }
  const double end = std::min(kEnd * voxel_size / length, 0.5);
  return last >= distance_at(1.0 - end) - kSlack &&
         space.clearance(a, b) >= space.distance(a) - kSlack;
}

}  // namespace

std::optional<Point> find_escape(const EsdfMap& esdf, const Point& point, double radius) {
  const FreeSpace space(esdf);
  if (!(space.distance(point) > 0.0)) return std::nullopt;
  for (const Point& place : places_around(esdf, point, radius))
    if (space.is_known_free(point, place) && rises(space, point, place, esdf.voxel_size))
      return place;
  return std::nullopt;
}

}  // namespace ridgeway::detail
