// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "limited_route.hpp"

#include <algorithm>
#include <limits>

#include "common/rounding.hpp"
#include "paths/shorten.hpp"
#include "roadmap/best_first_search.hpp"
#include "voxel_route.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::size_t kLooksForAVertex = 16;  // at the nearest, from either end

/// The cost of a way to a vertex, and of one over it to the goal at least.
struct Bound {
  double whole, cost;
  bool operator<(const Bound& other) const { return whole < other.whole; }
};

/// A way from an end of the query to the graph.
struct Leg {
  VertexId vertex = kNoVertex;
  Route places;         // the end first; without the vertex
  double length = 0.0;  // with the piece to the vertex
};

class LimitedSearch {
 public:
  LimitedSearch(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query)
      : graph_(roadmap.graph), space_(space), query_(query) {}

  /// Along the way to the graph, and straight to vertices that the end sees.
  std::vector<Leg> legs_from(const Point& end, const AttachWay& way) const {
    std::vector<Leg> legs;
    const auto add = [&](VertexId v, Route places) {
      const double length = length_of(places) + (place_of(v) - places.back()).norm();
      legs.push_back({v, std::move(places), length});
    };
    if (way.reached()) {
      RouteQuery query = query_;
      query.start = end;
      Route places = route_over_voxels(space_.map(), query, way.voxels);
      places.pop_back();  // the goal
      for (std::size_t i = 1; i < places.size(); ++i) places[i] = moved_in(places[i]);
      const bool is_open = is_free(places);
      if (places.size() > 1) places.pop_back();  // the vertex
      if (is_open) add(way.vertex, std::move(places));
    }
    for (const VertexId v : nearest_vertices(end))
      if (space_.is_free(end, place_of(v), query_.radius)) add(v, {end});
    return legs;
  }

  /// The shortest way over the graph from one of some legs to one of others; empty where there is
  /// none.
  Route run(const std::vector<Leg>& first, const std::vector<Leg>& last,
            const Deadline& deadline) const {
    BestFirstSearch<VertexId, double, Bound> search(graph_.vertices.size(),
                                                    std::numeric_limits<double>::infinity());
    const auto reach = [&](VertexId v, double cost, VertexId from) {
      if (search.improve(v, cost, from))
        search.enqueue(v, {cost + (place_of(v) - query_.goal).norm(), cost});
    };
    for (const Leg& leg : first) reach(leg.vertex, leg.length, leg.vertex);
    const Leg* arrival = nullptr;
    double shortest = std::numeric_limits<double>::infinity();
    constexpr int kBetweenLooks = 64;  // at the clock
    int taken = 0;
    search.run([&](VertexId v) {
      if (++taken % kBetweenLooks == 0 && deadline.has_passed()) return false;
      const double cost = search.cost(v);
      if (cost + (place_of(v) - query_.goal).norm() >= shortest) return false;
      for (const Leg& leg : last)
        if (leg.vertex == v && cost + leg.length < shortest) {
          shortest = cost + leg.length;
          arrival = &leg;
        }
      for (const Link& link : graph_.links_of(v)) {
        const double there = cost + (place_of(link.vertex) - place_of(v)).norm();
        if (there < search.cost(link.vertex) && can_fly(v, link)) reach(link.vertex, there, v);
      }
      return true;
    });
    if (arrival == nullptr) return {};
    return route_over(search.way_to(arrival->vertex), first, *arrival);
  }

 private:
  Route route_over(const std::vector<VertexId>& vertices, const std::vector<Leg>& first,
                   const Leg& last) const {
    const VertexId head = vertices.front();
    const Leg* begin = &first.front();  // the shortest that leads there
    for (const Leg& leg : first)
      if (leg.vertex == head && (begin->vertex != head || leg.length < begin->length)) begin = &leg;
    Route route = begin->places;
    for (const VertexId v : vertices) route.push_back(place_of(v));
    route.insert(route.end(), last.places.rbegin(), last.places.rend());
    return route;
  }

  Point place_of(VertexId v) const { return moved_in(graph_.vertices[number(v)].position); }
  Point moved_in(const Point& p) const { return space_.nearest_within(p); }

  bool is_free(const Route& places) const {
    for (std::size_t i = 1; i < places.size(); ++i)
      if (!space_.is_free(places[i - 1], places[i], query_.radius)) return false;
    return true;
  }

  bool can_fly(VertexId from, const Link& link) const {
    const Point a = place_of(from), b = place_of(link.vertex);
    const bool was_moved = a != graph_.vertices[number(from)].position ||
                           b != graph_.vertices[number(link.vertex)].position;
    const double clearance = graph_.edges[number(link.edge)].clearance;
    if (!was_moved && is_as_wide(clearance, space_.outer_radius(query_.radius)))
      return space_.is_within_limits(a, b);
    if (!was_moved && !is_as_wide(clearance, space_.inner_radius(query_.radius))) return false;
    return space_.is_free(a, b, query_.radius);
  }

  std::vector<VertexId> nearest_vertices(const Point& end) const {
    std::vector<std::pair<double, std::uint32_t>> vertices;
    for (std::uint32_t v = 0; v < graph_.vertices.size(); ++v)
      vertices.emplace_back((place_of(VertexId{v}) - end).squaredNorm(), v);
    const std::size_t count = std::min(kLooksForAVertex, vertices.size());
    std::partial_sort(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count),
                      vertices.end());
    std::vector<VertexId> nearest;
    for (std::size_t i = 0; i < count; ++i) nearest.push_back(VertexId{vertices[i].second});
    return nearest;
  }

  const SparseGraph& graph_;
  const FreeSpace& space_;
  const RouteQuery& query_;
};

}  // namespace

RouteResult find_limited_route(const Roadmap& roadmap, const FreeSpace& space,
                               const RouteQuery& query, const AttachWay& from, const AttachWay& to,
                               const Deadline& deadline) {
  RouteResult result;
  const LimitedSearch search(roadmap, space, query);
  const std::vector<Leg> first = search.legs_from(query.start, from);
  if (first.empty()) return result;
  const std::vector<Leg> last = search.legs_from(query.goal, to);
  if (last.empty()) return result;
  result.route = search.run(first, last, deadline);
  if (!result.route.empty()) result.status = SearchStatus::kFound;
  return result;
}

}  // namespace ridgeway::detail
