// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "short_path.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "any_angle_search.hpp"
#include "detour.hpp"
#include "path_cost.hpp"
#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"
#include "roadmap/cell_search.hpp"
#include "voxel_route.hpp"

namespace ridgeway::detail {
CellRoute path_over_cells(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                          const AttachWay& from, const AttachWay& to, double known,
                          const Deadline& deadline) {
  CellQuery cells{query.start, query.goal, from, to, query.radius};
  if (known > 0.0) cells.longest = kPlanning.as_found * known;
  CellRoute route = search_cells(roadmap, space, cells, deadline);
  const double longest = known > 0.0 ? known : std::numeric_limits<double>::infinity();
  route.waypoints =
      shorten_below(space, std::move(route.waypoints), query.radius, longest, deadline);
  return route;
}

Route shorten_below(const FreeSpace& space, Route route, double radius, double longest,
                    const Deadline& deadline) {
  route = skip_waypoints(space, std::move(route), radius, deadline);
  if (length_of(route) > kPlanning.as_found * longest) return {};
  return draw_corners_in(space, route, radius, deadline);
}

Route past_what_blocks(const EsdfMap& esdf, const FreeSpace& space, const RouteQuery& query,
                       Route path, const Deadline& deadline) {
  Route redirected = redirect(esdf, space, path, query.radius, deadline);
  if (redirected == path) return path;
  return shorten(space, std::move(redirected), query.radius, deadline);
}

Route path_over_voxels(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                       double length, const CellGuide* guide, int most_voxels,
                       const Deadline& deadline) {
  constexpr double kOffCentres = 1.8;  // voxels, of both ends together at most
  const EsdfMap& esdf = roadmap.esdf;
  const bool is_guided = guide != nullptr;
  const double longest = is_guided ? kPlanning.as_found * length : length;
  const LatticeOptions options{.guide = guide,
                               .longest = longest / esdf.voxel_size + kOffCentres,
                               .most_expansions = most_voxels};
  const LatticePath path =
      search_lattice(space, query.from, query.to, query.radius, options, deadline);
  if (path.status != SearchStatus::kFound) return {};
  return shorten(space, route_over_voxels(esdf, query, path.voxels), query.radius, deadline);
}

Route shortest_over_voxels(const EsdfMap& esdf, const FreeSpace& space, const RouteQuery& query,
                           const Deadline& deadline) {
  const LatticePath path = search_any_angle(space, query.from, query.to, query.radius, deadline);
  if (path.status != SearchStatus::kFound) return {};
  return shorten(space, route_over_voxels(esdf, query, path.voxels), query.radius, deadline);
}

CheapestRoute cheapest(const FreeSpace& space, const RouteQuery& query, std::vector<Route> as_found,
                       Route short_path, const Deadline& deadline) {
  const PathCost cost(space, query.radius, query.prefer_clearance);
  const auto is_kept = [&](std::span<const Point> before, std::span<const Point> after) {
    return cost.is_kept(before, after);
  };
  CheapestRoute best{std::move(short_path), std::nullopt};
  double least = cost.of(best.route);
  for (std::size_t i = 0; i < as_found.size(); ++i) {
    Route route = shorten(space, std::move(as_found[i]), query.radius, deadline, is_kept);
    const double own = cost.of(route);
    if (own >= least) continue;
    least = own;
    best = {std::move(route), i};
  }
  return best;
}

}  // namespace ridgeway::detail
