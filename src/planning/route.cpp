// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "route.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <span>

#include "any_angle_search.hpp"
#include "attach_way.hpp"
#include "endpoint.hpp"
#include "graph_search.hpp"
#include "path_cost.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "shorten.hpp"
#include "voxel_route.hpp"

namespace ridgeway::detail {
namespace {

constexpr int kSearches = 3;
constexpr float kPenalty = 1.6f;          // on edges that an earlier route took
constexpr double kNearlyStraight = 1.01;  // over the straight line: not worth another route
constexpr double kSuspicious = 1.15;      // over the straight line: worth a second opinion
constexpr double kVerySuspicious = 1.25;  // worth a finer one
constexpr double kQuickWeight = 1.2;      // of those searches' heuristic
constexpr int kQuickExpansions = 2000;    // about a millisecond
constexpr double kLatticeExcess = 1.05;   // by which a lattice path shrinks when it is shortened
constexpr double kMostlyShrinksTo = 0.7;  // of its length a route seldom becomes shorter

Route route_over_vertices(const Roadmap& roadmap, const RouteQuery& query, const AttachWay& from,
                          const AttachWay& to, const std::vector<VertexId>& vertices,
                          EdgeStretch& edges) {
  RouteQuery leg = query;
  Route route = route_over_voxels(roadmap.esdf, leg, from.voxels);
  route.pop_back();  // the goal
  edges = {.first = route.size() - 1};
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
    route.push_back(roadmap.graph.vertices[number(vertices[i])].position);
  std::swap(leg.start, leg.goal);
  Route back = route_over_voxels(roadmap.esdf, leg, to.voxels);
  back.pop_back();
  edges.last = route.size();
  route.insert(route.end(), back.rbegin(), back.rend() - 1);
  route.push_back(query.goal);
  return route;
}

/// Routes over the graph, each further one shunning the edges of those before.
class GraphRoutes {
 public:
  GraphRoutes(const Roadmap& roadmap, const RouteQuery& query, AttachWay from, AttachWay to)
      : roadmap_(roadmap), query_(query), from_(std::move(from)), to_(std::move(to)) {
    if (query.prefer_clearance > 0.0) charge_for_walls();
  }

  /// Of the last route.
  const EdgeStretch& edges() const { return edges_; }

  std::optional<Route> next() {
    while (searches_++ < kSearches) {
      std::vector<VertexId> vertices =
          search_graph(roadmap_.graph, from_.vertex, to_.vertex, query_.radius,
                       penalty_.empty() ? nullptr : &penalty_);
      if (vertices.empty()) return std::nullopt;
      penalty_.resize(roadmap_.graph.edges.size(), 1.0f);
      Route route = route_over_vertices(roadmap_, query_, from_, to_, vertices, edges_);
      for (std::size_t i = 1; i < vertices.size(); ++i) {
        const EdgeId edge = edge_between(roadmap_.graph, vertices[i - 1], vertices[i]);
        penalty_[number(edge)] *= kPenalty;
        edges_.clearance = std::min(edges_.clearance, roadmap_.graph.edges[number(edge)].clearance);
      }
      if (std::find(taken_.begin(), taken_.end(), vertices) != taken_.end()) continue;
      taken_.push_back(vertices);
      return route;
    }
    return std::nullopt;
  }

 private:
  void charge_for_walls() {
    const FreeSpace space(roadmap_.esdf);
    const PathCost cost(space, query_.radius, query_.prefer_clearance);
    for (const Edge& edge : roadmap_.graph.edges)
      penalty_.push_back(static_cast<float>(cost.factor(edge.clearance)));
  }

  const Roadmap& roadmap_;
  const RouteQuery query_;
  const AttachWay from_, to_;
  int searches_ = 0;
  EdgeStretch edges_;
  std::vector<float> penalty_;  // by edge
  std::vector<std::vector<VertexId>> taken_;
};

/// What following the attach field from both ends shows before any search.
enum class Reach { kJoined, kApart, kSearch, kUnclear };

Reach compare_ways(const Roadmap& roadmap, const RouteQuery& query, const AttachWay& from,
                   const AttachWay& to) {
  if (from.voxels.back() == to.voxels.back()) return Reach::kJoined;
  if (from.reached() && to.reached()) {
    const double widest = widest_way(roadmap.graph, roadmap.tree, from.vertex, to.vertex);
    return widest >= query.radius * (1.0 - 1e-9) ? Reach::kSearch : Reach::kApart;
  }
  // A way that stops before it meets the diagram stops at the end of all that its voxel can
  // reach at this radius, and that end is the same for all voxels of such a region.
  if (!roadmap.diagram.complete) return Reach::kUnclear;
  const bool from_is_pocket = !from.reached() && !from.met_diagram;
  const bool to_is_pocket = !to.reached() && !to.met_diagram;
  return from_is_pocket || to_is_pocket ? Reach::kApart : Reach::kUnclear;
}

void search_voxels(const Roadmap& roadmap, const RouteQuery& query, Planner planner,
                   const Deadline& deadline, RouteResult& result) {
  const bool any_angle = planner == Planner::kThetaStar;
  result.answered_by = any_angle ? Planner::kThetaStar : Planner::kEsdf;
  LatticePath path =
      any_angle ? search_any_angle(roadmap.esdf, query.from, query.to, query.radius, deadline)
                : search_lattice(roadmap.esdf, query.from, query.to, query.radius, {}, deadline);
  result.status = path.status;
  if (path.status == SearchStatus::kFound)
    result.route = route_over_voxels(roadmap.esdf, query, path.voxels);
}

/// A* along the diagram between the places where the two ways meet it.
void search_diagram(const Roadmap& roadmap, const RouteQuery& query, AttachWay from, AttachWay to,
                    const Deadline& deadline, RouteResult& result) {
  const auto cut_at_diagram = [&](std::vector<VoxelId>& way) {
    const auto first = std::find_if(way.begin(), way.end(),
                                    [&](VoxelId id) { return roadmap.diagram.voxels.test(id); });
    if (first != way.end()) way.erase(first + 1, way.end());
  };
  cut_at_diagram(from.voxels);
  cut_at_diagram(to.voxels);
  LatticePath path = search_lattice(roadmap.esdf, from.voxels.back(), to.voxels.back(),
                                    query.radius, {.within = &roadmap.diagram.voxels}, deadline);
  result.answered_by = Planner::kDiagram;
  result.status = path.status;
  if (path.status != SearchStatus::kFound) return;
  std::vector<VoxelId> voxels = std::move(from.voxels);
  voxels.insert(voxels.end(), path.voxels.begin() + 1, path.voxels.end());
  voxels.insert(voxels.end(), to.voxels.rbegin() + 1, to.voxels.rend());
  result.route = route_over_voxels(roadmap.esdf, query, voxels);
}

}  // namespace

RouteResult find_route(const Roadmap& roadmap, const RouteQuery& query, Planner planner,
                       const Deadline& deadline) {
  RouteResult result;
  const double began = seconds_now();
  if (planner == Planner::kEsdf || planner == Planner::kThetaStar) {
    search_voxels(roadmap, query, planner, deadline, result);
    result.search_seconds = seconds_now() - began;
    return result;
  }
  AttachWay from = follow_attach(roadmap, query.from, query.radius);
  AttachWay to = follow_attach(roadmap, query.to, query.radius);
  const Reach reach = compare_ways(roadmap, query, from, to);
  const double attached = seconds_now();
  result.attach_seconds = attached - began;
  if (reach == Reach::kJoined) {
    result.status = SearchStatus::kFound;
    result.route = route_over_voxels(roadmap.esdf, query, join_ways(from.voxels, to.voxels));
  } else if (reach != Reach::kApart) {
    if (reach == Reach::kSearch && planner == Planner::kGraph) {
      const auto routes = std::make_shared<GraphRoutes>(roadmap, query, from, to);
      if (std::optional<Route> first = routes->next()) {
        result.status = SearchStatus::kFound;
        result.route = std::move(*first);
        result.edges = routes->edges();
        result.next_alternative = [routes] { return routes->next(); };
      }
    }
    if (result.status == SearchStatus::kNoRoute && from.met_diagram && to.met_diagram)
      search_diagram(roadmap, query, std::move(from), std::move(to), deadline, result);
    if (result.status == SearchStatus::kNoRoute)
      search_voxels(roadmap, query, Planner::kEsdf, deadline, result);
  }
  result.search_seconds = seconds_now() - attached;
  return result;
}

namespace {

/// The nearest voxel with even coordinates that a point can move to.
VoxelId even_voxel(const EsdfMap& esdf, const FreeSpace& space, const Point& p, double radius) {
  const VoxelIndex v = voxel_at(p, esdf.voxel_size);
  const double threshold = squared_threshold(radius, esdf.voxel_size);
  for (int i = 0; i < 8; ++i) {
    const auto even = [&](int at, int bit) { return (at & ~1) + 2 * (at & 1 & (i >> bit)); };
    const VoxelIndex near{even(v.x, 0), even(v.y, 1), even(v.z, 2)};
    const VoxelId id = esdf.layout.find(near);
    if (id != kNoVoxel && esdf.state[id] == VoxelState::kFree && esdf.squared[id] >= threshold &&
        space.is_free(p, centre_of(near, esdf.voxel_size), radius))
      return id;
  }
  return kNoVoxel;
}

/// A second opinion on a path that stays long: a quick search over every voxel, or every second
/// one, for one that is shorter. Empty where it finds none in its small budget.
Route search_quickly(const EsdfMap& esdf, const FreeSpace& space, const Point& start,
                     const Point& goal, double radius, int stride, double longest,
                     const Deadline& deadline) {
  const auto voxel_of = [&](const Point& p) {
    return stride == 1 ? find_endpoint(esdf, p, radius).voxel : even_voxel(esdf, space, p, radius);
  };
  const VoxelId from = voxel_of(start), to = voxel_of(goal);
  if (from == kNoVoxel || to == kNoVoxel) return {};
  const LatticeOptions options{.stride = stride,
                               .weight = kQuickWeight,
                               .longest = longest * kLatticeExcess / esdf.voxel_size,
                               .most_expansions = kQuickExpansions};
  const LatticePath path = search_lattice(esdf, from, to, radius, options, deadline);
  if (path.status != SearchStatus::kFound) return {};
  return route_over_voxels(esdf, {from, to, start, goal, radius}, path.voxels);
}

/// As tightest(), by cost; short paths count among what it chooses from.
Route cheapest(const EsdfMap& esdf, const FreeSpace& space, RouteResult& found,
               const RouteQuery& query, const Deadline& deadline) {
  const PathCost cost(space, query.radius, query.prefer_clearance);
  const auto is_kept = [&](std::span<const Point> before, std::span<const Point> after) {
    return cost.is_kept(before, after);
  };
  Route best;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](Route route) {
    const double own = cost.of(route);
    if (own >= least) return;
    least = own;
    best = std::move(route);
  };
  if (space.is_free(query.start, query.goal, query.radius)) offer({query.start, query.goal});
  for (std::optional<Route> route = found.route; route;) {
    Route tight = shorten(space, *route, query.radius, deadline);
    offer(redirect(esdf, space, tight, query.radius, deadline));
    offer(std::move(tight));
    offer(shorten(space, std::move(*route), query.radius, deadline, is_kept));
    if (!found.next_alternative || deadline.has_passed()) break;
    route = found.next_alternative();
  }
  return best;
}

}  // namespace

Route tightest(const EsdfMap& esdf, const FreeSpace& space, RouteResult& found,
               const RouteQuery& query, const Deadline& deadline) {
  if (query.prefer_clearance > 0.0) return cheapest(esdf, space, found, query, deadline);
  const double radius = query.radius;
  Route best = shorten(space, found.route, radius, deadline);
  double shortest = length_of(best);
  const double enough = kNearlyStraight * (best.back() - best.front()).norm();
  while (found.next_alternative && shortest > enough && !deadline.has_passed()) {
    const std::optional<Route> route = found.next_alternative();
    if (!route) break;
    if (length_of(*route) * kMostlyShrinksTo > shortest) continue;
    Route candidate = shorten(space, *route, radius, deadline);
    const double length = length_of(candidate);
    if (length >= shortest) continue;
    shortest = length;
    best = std::move(candidate);
  }
  if (shortest > enough && best.size() > 2)
    best = shorten(space, redirect(esdf, space, best, radius, deadline), radius, deadline);
  for (const int stride : {2, 1}) {  // the coarse one is quick, the fine one fits narrow places
    shortest = length_of(best);
    const double suspicious = stride == 2 ? kSuspicious : kVerySuspicious;
    if (shortest <= suspicious * (best.back() - best.front()).norm() || deadline.has_passed())
      break;
    Route other =
        search_quickly(esdf, space, best.front(), best.back(), radius, stride, shortest, deadline);
    if (!other.empty()) other = shorten(space, std::move(other), radius, deadline);
    if (!other.empty() && length_of(other) < shortest) best = std::move(other);
  }
  return best;
}

}  // namespace ridgeway::detail
