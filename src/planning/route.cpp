// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "route.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "any_angle_search.hpp"
#include "common/rounding.hpp"
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

/// What every edge costs beside its length.
std::vector<float> charge_for_walls(const Roadmap& roadmap, const RouteQuery& query) {
  const FreeSpace space(roadmap.esdf);
  const PathCost cost(space, query.radius, query.prefer_clearance);
  std::vector<float> factors;
  for (const Edge& edge : roadmap.graph.edges)
    factors.push_back(static_cast<float>(cost.factor(edge.clearance)));
  return factors;
}

void search_sparse_graph(const Roadmap& roadmap, const RouteQuery& query,
                         const Attachment& attachment, RouteResult& result) {
  const auto& [from, to, reach] = attachment;
  std::vector<float> charges;
  if (query.prefer_clearance > 0.0) charges = charge_for_walls(roadmap, query);
  const std::vector<VertexId> vertices =
      search_graph(roadmap.graph, roadmap.landmarks, from.vertex, to.vertex, query.radius,
                   charges.empty() ? nullptr : &charges);
  if (vertices.empty()) return;
  result.status = SearchStatus::kFound;
  result.route = route_over_vertices(roadmap, query, from, to, vertices);
  // All but the ways from the start and to the goal into their voxels.
  result.known = {1, result.route.size() - 2, std::min(from.clearance, to.clearance)};
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const EdgeId edge = edge_between(roadmap.graph, vertices[i - 1], vertices[i]);
    result.known.clearance =
        std::min(result.known.clearance, roadmap.graph.edges[number(edge)].clearance);
  }
}

Reach compare_ways(const Roadmap& roadmap, const RouteQuery& query, const AttachWay& from,
                   const AttachWay& to) {
  if (from.voxels.back() == to.voxels.back()) return Reach::kJoined;
  if (from.reached() && to.reached()) {
    const double widest = widest_way(roadmap.graph, roadmap.tree, from.vertex, to.vertex);
    return is_as_wide(widest, query.radius) ? Reach::kConnected : Reach::kApart;
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

Attachment attach(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query) {
  RouteQuery sphere = query;
  sphere.radius = space.inner_radius(query.radius);
  auto [from, to] = follow_attach(roadmap, std::array{query.from, query.to}, sphere.radius);
  Attachment attachment{std::move(from), std::move(to), Reach::kUnclear};
  attachment.reach = compare_ways(roadmap, sphere, attachment.from, attachment.to);
  return attachment;
}

RouteResult find_route(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                       const Attachment& attachment, Planner planner, const Deadline& deadline) {
  RouteResult result;
  if (planner == Planner::kEsdf || planner == Planner::kThetaStar) {
    search_voxels(roadmap, space, query, planner, deadline, result);
    return result;
  }
  const auto& [from, to, reach] = attachment;
  if (reach == Reach::kApart) return result;
  if (space.is_narrowed()) {
    if (planner == Planner::kGraph)
      result = find_limited_route(roadmap, space, query, from, to, deadline);
    if (result.status == SearchStatus::kNoRoute)
      search_voxels(roadmap, space, query, Planner::kEsdf, deadline, result);
    return result;
  }
  if (reach == Reach::kJoined) {
    result.status = SearchStatus::kFound;
    result.route = route_over_voxels(roadmap.esdf, query, join_ways(from.voxels, to.voxels));
    return result;
  }
  if (reach == Reach::kConnected && planner == Planner::kGraph)
    search_sparse_graph(roadmap, query, attachment, result);
  if (result.status == SearchStatus::kNoRoute && from.met_diagram && to.met_diagram)
    search_diagram(roadmap, space, query, from, to, deadline, result);
  if (result.status == SearchStatus::kNoRoute)
    search_voxels(roadmap, space, query, Planner::kEsdf, deadline, result);
  return result;
}

}  // namespace ridgeway::detail
