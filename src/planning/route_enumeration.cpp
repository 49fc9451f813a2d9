// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "route_enumeration.hpp"

#include <algorithm>
#include <array>

#include "common/rounding.hpp"
#include "deformation.hpp"
#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"
#include "roadmap/attach_way.hpp"
#include "roadmap/graph_search.hpp"
#include "voxel_route.hpp"

namespace ridgeway::detail {

RouteEnumeration::RouteEnumeration(const Roadmap& roadmap, const FreeSpace& space,
                                   const RouteQuery& query, const Deadline& deadline)
    : roadmap_(roadmap),
      space_(space),
      query_(query),
      deadline_(deadline),
      starts_(legs_from(query.start, query.from)),
      goals_(legs_from(query.goal, query.to)) {
  Sources goals;
  for (const auto& [vertex, leg] : goals_) goals.emplace_back(vertex, length_of(leg));
  rest_ = lengths_from(roadmap.graph, goals, space_.inner_radius(query.radius));
  for (const auto& [vertex, leg] : starts_)
    push({.vertex = vertex, .length = length_of(leg)}, rest_[number(vertex)]);
}

std::optional<Route> RouteEnumeration::next() {
  while (!open_.empty() && expansions_ < kPlanning.most_forks && !time_is_up()) {
    const std::uint32_t piece = open_.top().piece;
    open_.pop();
    ++expansions_;
    if (pieces_[piece].vertex == kNoVertex) return route_to(piece);
    if (!is_redundant(piece)) expand(piece);
  }
  return std::nullopt;
}

RouteEnumeration::Legs RouteEnumeration::legs_from(const Point& end, VoxelId voxel) {
  const AttachWay way = follow_attach(roadmap_, voxel, space_.inner_radius(query_.radius));
  if (!way.reached()) return {};
  RouteQuery leg = query_;
  leg.start = end;
  Route route = route_over_voxels(roadmap_.esdf, leg, way.voxels);
  route.pop_back();  // the goal
  Legs legs;
  for (std::size_t i = 1; i < route.size(); ++i) route[i] = space_.nearest_within(route[i]);
  if (!space_.is_narrowed() || is_free(route)) legs.emplace(way.vertex, std::move(route));
  constexpr std::uint32_t kBetweenLooks = 256;  // at the clock
  std::vector<bool> seen(roadmap_.graph.vertices.size());
  for (std::uint32_t v = 0; v < seen.size() && (v % kBetweenLooks != 0 || !time_is_up()); ++v)
    seen[v] = space_.is_free(end, place_of(VertexId{v}), query_.radius);
  for (std::uint32_t v = 0; v < seen.size() && !time_is_up(); ++v) {
    if (!seen[v]) continue;
    const Point position = place_of(VertexId{v});
    const auto leads_here = [&](const Link& link) {
      const Point nearer = place_of(link.vertex);
      return seen[number(link.vertex)] && may_be_taken(VertexId{v}, link) &&
             (nearer - end).norm() < (position - end).norm() &&
             deforms_into(space_, std::array{end, nearer, position}, std::array{end, position},
                          query_.radius);
    };
    const auto links = roadmap_.graph.links_of(VertexId{v});
    if (std::none_of(links.begin(), links.end(), leads_here)) legs[VertexId{v}] = {end, position};
  }
  return legs;
}

bool RouteEnumeration::time_is_up() {
  is_cut_short_ = is_cut_short_ || deadline_.has_passed();
  return is_cut_short_;
}

bool RouteEnumeration::is_wide_enough(const Link& link) const {
  return is_as_wide(roadmap_.graph.edges[number(link.edge)].clearance, query_.radius);
}

bool RouteEnumeration::may_be_taken(VertexId from, const Link& link) const {
  return space_.is_narrowed() ? space_.is_free(place_of(from), place_of(link.vertex), query_.radius)
                              : is_wide_enough(link);
}

Point RouteEnumeration::place_of(VertexId v) const {
  return space_.nearest_within(roadmap_.graph.vertices[number(v)].position);
}

bool RouteEnumeration::is_free(const Route& route) const {
  for (std::size_t i = 1; i < route.size(); ++i)
    if (!space_.is_free(route[i - 1], route[i], query_.radius)) return false;
  return true;
}

void RouteEnumeration::push(Piece piece, double rest) {
  if (rest == std::numeric_limits<double>::infinity()) return;
  open_.push({piece.length + rest, static_cast<std::uint32_t>(pieces_.size())});
  pieces_.push_back(piece);
}

void RouteEnumeration::expand(std::uint32_t piece) {
  const Piece here = pieces_[piece];
  const auto goal_leg = goals_.find(here.vertex);
  if (goal_leg != goals_.end())
    push({.from = piece, .length = here.length + length_of(goal_leg->second)}, 0.0);
  const std::vector<VertexId> passed = vertices_to(piece);
  for (const Link& link : roadmap_.graph.links_of(here.vertex)) {
    if (!may_be_taken(here.vertex, link)) continue;
    if (std::binary_search(passed.begin(), passed.end(), link.vertex)) continue;
    push({link.vertex, piece, here.length + roadmap_.graph.edges[number(link.edge)].length},
         rest_[number(link.vertex)]);
  }
}

/// Sorted.
std::vector<VertexId> RouteEnumeration::vertices_to(std::uint32_t piece) const {
  std::vector<VertexId> vertices;
  for (; piece != kNone; piece = pieces_[piece].from) vertices.push_back(pieces_[piece].vertex);
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

Route RouteEnumeration::route_to(std::uint32_t piece) const {
  Route route;  // backwards
  if (pieces_[piece].vertex == kNoVertex) {
    piece = pieces_[piece].from;
    route = goals_.at(pieces_[piece].vertex);
    route.pop_back();
  }
  for (; pieces_[piece].from != kNone; piece = pieces_[piece].from)
    route.push_back(place_of(pieces_[piece].vertex));
  const Route& leg = starts_.at(pieces_[piece].vertex);
  route.insert(route.end(), leg.rbegin(), leg.rend());
  std::reverse(route.begin(), route.end());
  return route;
}

bool RouteEnumeration::is_redundant(std::uint32_t piece) {
  const VertexId fork = pieces_[piece].vertex;
  if (roadmap_.graph.links_of(fork).size() < 3) return false;
  std::vector<Followed>& others = followed_[fork];
  Followed here{route_to(piece), vertices_to(piece)};
  int alike = 0;
  // One over some of the same vertices is enough: those first.
  for (const bool is_over_fewer : {true, false})
    for (const Followed& other : others) {
      if (std::includes(here.vertices.begin(), here.vertices.end(), other.vertices.begin(),
                        other.vertices.end()) != is_over_fewer)
        continue;
      if (time_is_up()) return true;
      if (!deforms_into(space_, other.route, here.route, query_.radius)) continue;
      if (is_over_fewer || ++alike == kPlanning.most_alike) return true;
    }
  others.push_back(std::move(here));
  return false;
}

}  // namespace ridgeway::detail
