// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tightest.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "detour.hpp"
#include "endpoint.hpp"
#include "path_cost.hpp"
#include "paths/shorten.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "voxel_route.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kTightlyStraight = 1.03;  // over the straight line: not worth another way
constexpr double kMostlyDrawnInTo = 0.9;   // of its length when waypoints are skipped
constexpr double kSuspicious = 1.15;       // over the straight line: worth a second opinion,
constexpr double kUnexpected = 1.1;        // and where that is cheap, as corners are known
constexpr std::array kStrides{2, 1};       // the coarse is quick, the fine fits narrow places
constexpr double kQuickWeight = 1.2;       // of those searches' heuristic
constexpr int kQuickExpansions = 3000;     // less than two milliseconds
constexpr double kLeastInVain = 60.0;      // they give up after so many in a pocket, at least,
constexpr double kInVain = 400.0;          // and so many for each length that shortening saved
constexpr double kLatticeExcess = 1.05;    // by which a lattice path shrinks when it is shortened

/// The nearest voxel with even coordinates that a point can move to.
VoxelId even_voxel(const EsdfMap& esdf, const FreeSpace& space, const Point& p, double radius) {
  const VoxelIndex v = voxel_at(p, esdf.voxel_size);
  const SquaredHalves threshold = least_clearance(space.inner_radius(radius), esdf.voxel_size);
  for (int i = 0; i < 8; ++i) {
    const auto even = [&](int at, int bit) { return (at & ~1) + 2 * (at & 1 & (i >> bit)); };
    const VoxelIndex near{even(v.x, 0), even(v.y, 1), even(v.z, 2)};
    const VoxelId id = esdf.layout.find(near);
    if (esdf.is_open(id) && esdf.squared[id] >= threshold && space.is_within_limits(id) &&
        space.is_free(p, centre_of(near, esdf.voxel_size), radius))
      return id;
  }
  return kNoVoxel;
}

/// A second opinion on a path that stays long: a quick search over every voxel, or every second
/// one, for one that is shorter. Empty where it finds none in its small budget.
Route search_quickly(const EsdfMap& esdf, const FreeSpace& space, const Point& start,
                     const Point& goal, double radius, int stride, double longest, int most_in_vain,
                     const Deadline& deadline) {
  const auto voxel_of = [&](const Point& p) {
    return stride == 1 ? find_endpoint(space, p, radius).voxel : even_voxel(esdf, space, p, radius);
  };
  if (stride > 1 && !space.is_for_sphere()) return {};
  const VoxelId from = voxel_of(start), to = voxel_of(goal);
  if (from == kNoVoxel || to == kNoVoxel) return {};
  const LatticeOptions options{.stride = stride,
                               .weight = kQuickWeight,
                               .longest = longest * kLatticeExcess / esdf.voxel_size,
                               .most_expansions = kQuickExpansions,
                               .most_in_vain = most_in_vain};
  const LatticePath path = search_lattice(space, from, to, radius, options, deadline);
  if (path.status != SearchStatus::kFound) return {};
  return route_over_voxels(esdf, {from, to, start, goal, radius}, path.voxels);
}

/// A tight path past what blocks the straight line, and pulled tight again.
Route redirect_tight(const EsdfMap& esdf, const FreeSpace& space, const Route& path, double radius,
                     const Deadline& deadline) {
  Route redirected = redirect(esdf, space, path, radius, deadline);
  return redirected == path ? path : shorten(space, std::move(redirected), radius, deadline);
}

/// A tight path, or where that is long a shorter one that quick searches find. `as_found`: the
/// length of the route that it was made of. Where that is much longer the graph has little to say
/// on the space around, and searches are worth more; next to nothing where corners could be learnt:
/// paths that turn at few places come out tight without.
Route ask_again(const Roadmap& roadmap, const FreeSpace& space, Route best, double radius,
                double as_found, const Deadline& deadline) {
  const EsdfMap& esdf = roadmap.esdf;
  const bool knows_corners = !roadmap.tangents.empty();
  const double expected =
      (knows_corners ? kUnexpected : kSuspicious) * (best.back() - best.front()).norm();
  for (const int stride : std::span(kStrides).first(knows_corners ? 1 : 2)) {
    const double shortest = length_of(best);
    if (shortest <= expected || deadline.has_passed()) break;
    const double for_saved = knows_corners ? 0.0 : kInVain * (as_found / shortest - 1.0);
    const int most_in_vain =
        static_cast<int>(std::clamp<double>(for_saved, kLeastInVain, kQuickExpansions));
    Route other = search_quickly(esdf, space, best.front(), best.back(), radius, stride, shortest,
                                 most_in_vain, deadline);
    if (!other.empty()) other = shorten(space, std::move(other), radius, deadline);
    if (!other.empty() && length_of(other) < shortest) best = std::move(other);
  }
  return best;
}

/// As tightest(), by cost; short paths count among what it chooses from.
Route cheapest(const Roadmap& roadmap, const FreeSpace& space, RouteResult& found,
               const RouteQuery& query, Route known, const Deadline& deadline) {
  const PathCost cost(space, query.radius, query.prefer_clearance);
  const auto is_kept = [&](std::span<const Point> before, std::span<const Point> after) {
    return cost.is_kept(before, after);
  };
  const double as_found = length_of(found.route);
  Route best, shortest;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](Route route) {
    const double own = cost.of(route);
    if (own >= least) return;
    least = own;
    best = std::move(route);
  };
  if (space.is_free(query.start, query.goal, query.radius)) offer({query.start, query.goal});
  if (!known.empty()) offer(std::move(known));
  for (std::optional<Route> route = found.route; route;) {
    Route tight = shorten(space, *route, query.radius, deadline);
    tight = redirect_tight(roadmap.esdf, space, tight, query.radius, deadline);
    offer(tight);
    offer(shorten(space, std::move(*route), query.radius, deadline, is_kept));
    if (shortest.empty() || length_of(tight) < length_of(shortest)) shortest = std::move(tight);
    if (!found.next_alternative || deadline.has_passed()) break;
    route = found.next_alternative();
  }
  offer(ask_again(roadmap, space, std::move(shortest), query.radius, as_found, deadline));
  return best;
}

/// The shortest of the route found and its alternatives, each pulled tight, up to the first that
/// is no shorter: few are after that.
Route best_of_alternatives(const FreeSpace& space, RouteResult& found, double radius, double enough,
                           const Deadline& deadline) {
  Route best = shorten(space, found.route, radius, deadline);
  double shortest = length_of(best);
  while (found.next_alternative && shortest > enough && !deadline.has_passed()) {
    std::optional<Route> route = found.next_alternative();
    if (!route) break;
    Route candidate = skip_waypoints(space, std::move(*route), radius);
    if (length_of(candidate) * kMostlyDrawnInTo > shortest) break;
    candidate = draw_corners_in(space, candidate, radius, deadline);
    const double length = length_of(candidate);
    if (length >= shortest) break;
    shortest = length;
    best = std::move(candidate);
  }
  return best;
}

}  // namespace

Route tightest(const Roadmap& roadmap, const FreeSpace& space, RouteResult& found,
               const RouteQuery& query, Route known, const Deadline& deadline) {
  if (query.prefer_clearance > 0.0)
    return cheapest(roadmap, space, found, query, std::move(known), deadline);
  const double as_found = length_of(found.route);
  const double enough = kTightlyStraight * (query.goal - query.start).norm();
  Route best = best_of_alternatives(space, found, query.radius, enough, deadline);
  if (!known.empty() && length_of(known) < length_of(best)) best = std::move(known);
  if (length_of(best) > enough)
    best = redirect_tight(roadmap.esdf, space, best, query.radius, deadline);
  return ask_again(roadmap, space, std::move(best), query.radius, as_found, deadline);
}

}  // namespace ridgeway::detail
