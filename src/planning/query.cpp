// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "query.hpp"

#include <span>

#include "endpoint.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"
#include "shorten.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kUnknownStep = 8.0;  // voxels between looks at what the path borders

PlanStatus status_of(EndpointStatus status, bool is_start) {
  switch (status) {
    case EndpointStatus::kOutsideMap:
      return is_start ? PlanStatus::kStartOutsideMap : PlanStatus::kGoalOutsideMap;
    case EndpointStatus::kUnknown:
      return is_start ? PlanStatus::kStartUnknown : PlanStatus::kGoalUnknown;
    case EndpointStatus::kInCollision:
      return is_start ? PlanStatus::kStartInCollision : PlanStatus::kGoalInCollision;
    case EndpointStatus::kOk:
      break;
  }
  return PlanStatus::kOk;
}

void require_finite(const Point& p, const char* name) {
  if (!p.allFinite())
    throw InputError(name, "is not a finite point", "give three finite coordinates in metres");
}

/// Exact; of the graph's edges the clearance is known.
double clearance_of(const FreeSpace& space, std::span<const Point> route,
                    const EdgeStretch& edges) {
  const double before = space.clearance(route.first(edges.first + 1), edges.clearance);
  return space.clearance(route.subspan(edges.last), before);
}

}  // namespace

void validate_query(const EsdfMap& esdf, const Point& start, const Point& goal, double radius) {
  require_finite(start, "start");
  require_finite(goal, "goal");
  if (radius > largest_radius(esdf))
    throw InputError("radius " + number_text(radius), "is beyond the distances that the map holds",
                     "build the map with a larger --max-distance, or without one");
}

QueryEnds find_ends(const EsdfMap& esdf, const Point& start, const Point& goal, double radius) {
  const Endpoint from = find_endpoint(esdf, start, radius);
  if (from.status != EndpointStatus::kOk) return {.status = status_of(from.status, true)};
  const Endpoint to = find_endpoint(esdf, goal, radius);
  return {status_of(to.status, false), from.voxel, to.voxel};
}

void describe(const EsdfMap& esdf, const FreeSpace& space, const EdgeStretch& edges,
              PlanResult& result) {
  result.length = length_of(result.waypoints);
  result.clearance = clearance_of(space, result.waypoints, edges);
  VoxelFinder finder(esdf.layout);
  double bordering = 0.0;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i) {
    const Point& a = result.waypoints[i - 1];
    const Point& b = result.waypoints[i];
    const double length = (b - a).norm();
    const int pieces = 1 + static_cast<int>(length / (kUnknownStep * esdf.voxel_size));
    int unknown = 0;
    for (int k = 0; k < pieces; ++k) {
      const VoxelIndex v = voxel_at(a + (b - a) * ((k + 0.5) / pieces), esdf.voxel_size);
      const VoxelId id = finder.find(v);
      if (id == kNoVoxel || esdf.squared[id] == kNoSite) continue;
      const SiteOffset o = esdf.site[id];
      const VoxelId site = finder.find(v + VoxelIndex{o.x, o.y, o.z});
      unknown += site == kNoVoxel || esdf.state[site] == VoxelState::kUnknown;
    }
    bordering += length * unknown / pieces;
  }
  result.unknown_share = result.length > 0.0 ? bordering / result.length : 0.0;
}

bool is_verified(const EsdfMap& esdf, const FreeSpace& space, const PlanResult& result,
                 double radius) {
  if (result.clearance < radius * (1.0 - 1e-9)) return false;
  if (esdf.unknown == UnknownPolicy::kObstacle) return true;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i)
    if (!space.is_known_free(result.waypoints[i - 1], result.waypoints[i])) return false;
  return true;
}

}  // namespace ridgeway::detail
