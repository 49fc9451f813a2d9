// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "editable_graph.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {

void EditableGraph::Links::put(Number neighbour, const Link& link) {
  const auto place = lower_bound(entries_, neighbour);
  if (place != entries_.end() && place->first == neighbour) {
    place->second = link;
  } else {
    entries_.emplace(place, neighbour, link);
  }
}

void EditableGraph::Links::erase(Number neighbour) {
  const auto place = lower_bound(entries_, neighbour);
  if (place != entries_.end() && place->first == neighbour) entries_.erase(place);
}

EditableGraph::EditableGraph(const SparseGraph& graph)
    : graph_(graph),
      links_(graph.vertices.size()),
      changes_(graph.vertices.size(), 0),
      search_(graph.vertices.size(), std::numeric_limits<double>::infinity()) {
  for (const Edge& edge : graph.edges)
    link(static_cast<Number>(edge.from), static_cast<Number>(edge.to), {edge.clearance});
}

void EditableGraph::link(Number a, Number b, const Link& value) {
  links_[a].put(b, value);
  links_[b].put(a, value);
  ++changes_[a];
  ++changes_[b];
}

void EditableGraph::unlink(Number a, Number b) {
  links_[a].erase(b);
  links_[b].erase(a);
  ++changes_[a];
  ++changes_[b];
}

double EditableGraph::length(const std::vector<Number>& way) const {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) sum += length(way[i], way[i + 1]);
  return sum;
}

void EditableGraph::mark_widest_ways(const std::function<double(double)>& width) {
  std::vector<std::tuple<double, double, Number, Number>> edges;
  for (Number v = 0; v < links_.size(); ++v)
    for (const auto& [w, link] : links_[v])
      if (v < w) edges.emplace_back(-width(link.clearance), length(v, w), v, w);
  tbb::parallel_sort(edges.begin(), edges.end());
  DisjointSets parts(links_.size());
  for (const auto& [narrowness, length, v, w] : edges) {
    const bool widest = parts.find(v) != parts.find(w);
    if (widest) parts.join(v, w);
    Link& there = links_[v].at(w);
    if (there.widest == widest) continue;
    there.widest = links_[w].at(v).widest = widest;
    ++changes_[v];
    ++changes_[w];
  }
}

std::vector<EditableGraph::Number> EditableGraph::way_to_fork(Number end) const {
  std::vector<Number> way{end, links_[end].begin()->first};
  while (links_[way.back()].size() == 2) {
    const Links& links = links_[way.back()];
    const bool first_is_back = links.begin()->first == way[way.size() - 2];
    way.push_back(first_is_back ? links.rbegin()->first : links.begin()->first);
  }
  return way;
}

std::vector<EditableGraph::Number> EditableGraph::other_way(Number from, Number to, double longest,
                                                            double width) {
  search_.restart();
  search_.offer(from, 0.0, from);
  search_.run([&](Number v) {
    if (v == to) return false;
    for (const auto& [w, link] : links_[v]) {
      const double next = search_.cost(v) + length(v, w);
      if (link.clearance >= width && (v != from || w != to) && next + length(w, to) <= longest)
        search_.offer(w, next, v);
    }
    return true;
  });
  return search_.is_reached(to) ? search_.way_to(to) : std::vector<Number>{};
}

SparseGraph EditableGraph::result() const {
  SparseGraph simple;
  simple.min_clearance = graph_.min_clearance;
  std::vector<VertexId> id(links_.size(), kNoVertex);
  for (Number v = 0; v < links_.size(); ++v) {
    const bool dropped = links_[v].empty() && !graph_.links_of(VertexId{v}).empty();
    if (dropped) continue;
    id[v] = VertexId{static_cast<Number>(simple.vertices.size())};
    simple.vertices.push_back(graph_.vertices[v]);
  }
  for (Number v = 0; v < links_.size(); ++v)
    for (const auto& [w, link] : links_[v])
      if (v < w) simple.edges.push_back({id[v], id[w], length(v, w), link.clearance});
  index_links(simple);
  return simple;
}

}  // namespace ridgeway::detail
