// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "query.hpp"

#include <algorithm>
#include <span>

#include "../paths/shorten.hpp"
#include "endpoint.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kUnknownStep = 8.0;      // voxels between looks at what the path borders
constexpr double kMostUnknownLooks = 32;  // with more between them on long paths

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

/// Exact.
double clearance_of(const FreeSpace& space, std::span<const Point> route,
                    const KnownStretch& known) {
  const double before = space.clearance(route.first(known.first + 1), known.clearance);
  return space.clearance(route.subspan(known.last), before);
}

bool borders_unknown(const EsdfMap& esdf, VoxelFinder& finder, const Point& p) {
  const VoxelIndex v = voxel_at(p, esdf.voxel_size);
  const VoxelId id = finder.find(v);
  if (id == kNoVoxel || esdf.squared[id] == kNoSite) return false;
  const SiteOffset o = esdf.site[id];
  const VoxelId site = finder.find(v + VoxelIndex{o.x, o.y, o.z});
  return site == kNoVoxel || esdf.state[site] == VoxelState::kUnknown;
}

/// The share of a path on which the nearest obstacle is unknown space, from looks at the middles
/// of equal pieces of it.
double unknown_share(const EsdfMap& esdf, std::span<const Point> path, double length) {
  if (length <= 0.0) return 0.0;
  const int pieces = static_cast<int>(
      std::min(1.0 + length / (kUnknownStep * esdf.voxel_size), kMostUnknownLooks));
  const double piece = length / pieces;
  VoxelFinder finder(esdf.layout);
  int looks = 0, unknown = 0;
  double before = 0.0;  // length up to the segment
  for (std::size_t i = 1; i < path.size() && looks < pieces; ++i) {
    const Point along = path[i] - path[i - 1];
    const double own = along.norm();
    for (; looks < pieces && (looks + 0.5) * piece <= before + own; ++looks)
      unknown += borders_unknown(esdf, finder,
                                 path[i - 1] + along * (((looks + 0.5) * piece - before) / own));
    before += own;
  }
  return static_cast<double>(unknown) / pieces;
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

void describe(const EsdfMap& esdf, const FreeSpace& space, const KnownStretch& known,
              PlanResult& result) {
  result.length = length_of(result.waypoints);
  result.clearance = clearance_of(space, result.waypoints, known);
  result.unknown_share = unknown_share(esdf, result.waypoints, result.length);
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
