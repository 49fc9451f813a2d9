// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "route.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <span>

#include "any_angle_search.hpp"
#include "endpoint.hpp"
#include "limited_route.hpp"
#include "path_cost.hpp"
#include "paths/shorten.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "roadmap/attach_way.hpp"
#include "roadmap/graph_search.hpp"
#include "voxel_route.hpp"

namespace ridgeway::detail {
namespace {

constexpr int kSearches = 3;
constexpr float kPenalty = 1.6f;  // on edges that an earlier route took

Route route_over_vertices(const Roadmap& roadmap, const RouteQuery& query, const AttachWay& from,
                          const AttachWay& to, const std::vector<VertexId>& vertices) {
  RouteQuery leg = query;
  Route route = route_over_voxels(roadmap.esdf, leg, from.voxels);
  route.pop_back();  // the goal
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
    route.push_back(roadmap.graph.vertices[number(vertices[i])].position);
  std::swap(leg.start, leg.goal);
  Route back = route_over_voxels(roadmap.esdf, leg, to.voxels);
  back.pop_back();
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
  const KnownStretch& known() const { return known_; }

  std::optional<Route> next() {
    while (searches_++ < kSearches) {
      std::vector<VertexId> vertices =
          search_graph(roadmap_.graph, roadmap_.landmarks, from_.vertex, to_.vertex, query_.radius,
                       penalty_.empty() ? nullptr : &penalty_);
      if (vertices.empty()) return std::nullopt;
      penalty_.resize(roadmap_.graph.edges.size(), 1.0f);
      Route route = route_over_vertices(roadmap_, query_, from_, to_, vertices);
      // All but the ways from the start and to the goal into their voxels.
      known_ = {1, route.size() - 2, std::min(from_.clearance, to_.clearance)};
      for (std::size_t i = 1; i < vertices.size(); ++i) {
        const EdgeId edge = edge_between(roadmap_.graph, vertices[i - 1], vertices[i]);
        penalty_[number(edge)] *= kPenalty;
        known_.clearance = std::min(known_.clearance, roadmap_.graph.edges[number(edge)].clearance);
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
  KnownStretch known_;
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

void search_voxels(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                   Planner planner, const Deadline& deadline, RouteResult& result) {
  const bool any_angle = planner == Planner::kThetaStar;
  result.answered_by = any_angle ? Planner::kThetaStar : Planner::kEsdf;
  LatticePath path = any_angle
                         ? search_any_angle(space, query.from, query.to, query.radius, deadline)
                         : search_lattice(space, query.from, query.to, query.radius, {}, deadline);
  result.status = path.status;
  if (path.status == SearchStatus::kFound)
    result.route = route_over_voxels(roadmap.esdf, query, path.voxels);
}

/// A* along the diagram between the places where the two ways meet it.
void search_diagram(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                    AttachWay from, AttachWay to, const Deadline& deadline, RouteResult& result) {
  const auto cut_at_diagram = [&](std::vector<VoxelId>& way) {
    const auto first = std::find_if(way.begin(), way.end(),
                                    [&](VoxelId id) { return roadmap.diagram.voxels.test(id); });
    if (first != way.end()) way.erase(first + 1, way.end());
  };
  cut_at_diagram(from.voxels);
  cut_at_diagram(to.voxels);
  LatticePath path = search_lattice(space, from.voxels.back(), to.voxels.back(), query.radius,
                                    {.within = &roadmap.diagram.voxels}, deadline);
  result.answered_by = Planner::kDiagram;
  result.status = path.status;
  if (path.status != SearchStatus::kFound) return;
  std::vector<VoxelId> voxels = std::move(from.voxels);
  voxels.insert(voxels.end(), path.voxels.begin() + 1, path.voxels.end());
  voxels.insert(voxels.end(), to.voxels.rbegin() + 1, to.voxels.rend());
  result.route = route_over_voxels(roadmap.esdf, query, voxels);
}

}  // namespace

RouteResult find_route(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                       Planner planner, const Deadline& deadline) {
  RouteResult result;
  const double began = seconds_now();
  if (planner == Planner::kEsdf || planner == Planner::kThetaStar) {
    search_voxels(roadmap, space, query, planner, deadline, result);
    result.search_seconds = seconds_now() - began;
    return result;
  }
  RouteQuery sphere = query;  // what it cannot do the robot cannot either
  sphere.radius = space.inner_radius(query.radius);
  AttachWay from = follow_attach(roadmap, query.from, sphere.radius);
  AttachWay to = follow_attach(roadmap, query.to, sphere.radius);
  const Reach reach = compare_ways(roadmap, sphere, from, to);
  const double attached = seconds_now();
  result.attach_seconds = attached - began;
  if (space.is_narrowed()) {
    if (reach != Reach::kApart && planner == Planner::kGraph)
      result = find_limited_route(roadmap, space, query, from, to);
    if (reach != Reach::kApart && result.status == SearchStatus::kNoRoute)
      search_voxels(roadmap, space, query, Planner::kEsdf, deadline, result);
    result.attach_seconds = attached - began;
    result.search_seconds = seconds_now() - attached;
    return result;
  }
  if (reach == Reach::kJoined) {
    result.status = SearchStatus::kFound;
    result.route = route_over_voxels(roadmap.esdf, query, join_ways(from.voxels, to.voxels));
  } else if (reach != Reach::kApart) {
    if (reach == Reach::kSearch && planner == Planner::kGraph) {
      const auto routes = std::make_shared<GraphRoutes>(roadmap, query, from, to);
      if (std::optional<Route> first = routes->next()) {
        result.status = SearchStatus::kFound;
        result.route = std::move(*first);
        result.known = routes->known();
        result.next_alternative = [routes] { return routes->next(); };
      }
    }
    if (result.status == SearchStatus::kNoRoute && from.met_diagram && to.met_diagram)
      search_diagram(roadmap, space, query, std::move(from), std::move(to), deadline, result);
    if (result.status == SearchStatus::kNoRoute)
      search_voxels(roadmap, space, query, Planner::kEsdf, deadline, result);
  }
  result.search_seconds = seconds_now() - attached;
  return result;
}

}  // namespace ridgeway::detail
