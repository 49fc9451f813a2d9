// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "best_first_search.hpp"
#include "common/rounding.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway {
namespace {

/// In each connected part the first vertex with the largest value, as sources.
Sources farthest(const GraphComponents& parts, const std::vector<double>& value) {
  Sources result(parts.count, {kNoVertex, 0.0});
  for (std::uint32_t v = 0; v < value.size(); ++v) {
    VertexId& best = result[parts.label[v]].first;
    if (best == kNoVertex || value[v] > value[number(best)]) best = VertexId{v};
  }
  return result;
}

}  // namespace

std::vector<double> lengths_from(const SparseGraph& graph, const Sources& sources, double radius) {
  detail::BestFirstSearch<VertexId, double> search(graph.vertices.size(),
                                                   std::numeric_limits<double>::infinity());
  for (const auto& [vertex, length] : sources) search.offer(vertex, length, vertex);
  search.run([&](VertexId v) {
    for (const Link& link : graph.links_of(v)) {
      const Edge& edge = graph.edges[number(link.edge)];
      if (detail::is_as_wide(edge.clearance, radius))
        search.offer(link.vertex, search.cost(v) + edge.length, v);
    }
    return true;
  });
  std::vector<double> lengths;
  lengths.reserve(graph.vertices.size());
  for (std::uint32_t v = 0; v < graph.vertices.size(); ++v)
    lengths.push_back(search.cost(VertexId{v}));
  return lengths;
}

Landmarks place_landmarks(const SparseGraph& graph) {
  Landmarks landmarks;
  landmarks.lengths.resize(graph.vertices.size());
  const GraphComponents parts = connected_components(graph);
  std::vector<double> nearest(graph.vertices.size(), 0.0);  // landmark; at first the first vertices
  nearest = lengths_from(graph, farthest(parts, nearest), 0.0);
  for (std::size_t k = 0; k < Landmarks::kCount; ++k) {
    const std::vector<double> lengths = lengths_from(graph, farthest(parts, nearest), 0.0);
    for (std::size_t v = 0; v < lengths.size(); ++v) {
      landmarks.lengths[v][k] = lengths[v];
      nearest[v] = k == 0 ? lengths[v] : std::min(nearest[v], lengths[v]);
    }
  }
  return landmarks;
}

double length_bound(const Landmarks& landmarks, VertexId a, VertexId b) {
  if (landmarks.lengths.empty()) return 0.0;
  const auto& from_a = landmarks.lengths[number(a)];
  const auto& from_b = landmarks.lengths[number(b)];
  double bound = 0.0;
  for (std::size_t k = 0; k < Landmarks::kCount; ++k)
    bound = std::max(bound, std::abs(from_a[k] - from_b[k]));
  return bound;
}

}  // namespace ridgeway
