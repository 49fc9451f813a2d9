// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "path_cost.hpp"

#include <algorithm>
#include <cmath>

#include "esdf/near_sites.hpp"
#include "paths/planning_constants.hpp"

namespace ridgeway::detail {
double PathCost::factor(double clearance) const {
  const double share = radius_ / clearance;
  return 1.0 + prefer_clearance_ * share * share;
}

double PathCost::of(std::span<const Point> path) const {
  const EsdfMap& esdf = space_.map();
  VoxelFinder finder(esdf.layout);
  const auto distance = [&](const Point& p) {
    const double squared = squared_to_near_sites(esdf, finder, p / esdf.voxel_size);
    if (!std::isinf(squared)) return esdf.voxel_size * std::sqrt(squared);
    return std::isinf(esdf.max_distance) ? space_.distance(p) : esdf.max_distance;
  };
  double cost = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point along = path[i] - path[i - 1];
    const double length = along.norm();
    if (!prefers_clearance()) {
      cost += length;
      continue;
    }
    constexpr double kMostPieces = 4096;  // robots may be small
    const int pieces =
        1 + static_cast<int>(std::min(length / (kPlanning.look_step * radius_), kMostPieces));
    double factors = 0.0;
    for (int k = 0; k < pieces; ++k)
      factors += factor(distance(path[i - 1] + along * ((k + 0.5) / pieces)));
    cost += length * factors / pieces;
  }
  return cost;
}

bool PathCost::is_kept(std::span<const Point> before, std::span<const Point> after) const {
  return of(after) <= of(before) * (1.0 + kPlanning.cost_slack);
}

}  // namespace ridgeway::detail
