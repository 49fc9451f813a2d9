// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "example_query.hpp"

#include <cmath>
#include <vector>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/components.hpp"

namespace ridgeway::cli {
namespace {

/// Vertices of the largest part of traversable space.
std::vector<VertexId> vertices_of_largest(const ComponentReport& parts) {
  std::vector<VertexId> vertices;
  for (std::uint32_t v = 0; v < parts.asked.size(); ++v)
    if (parts.asked[v] == 0) vertices.push_back(VertexId{v});
  return vertices;
}

/// The vertex to which the way is longest, of those that have one.
VertexId farthest(const Roadmap& roadmap, const std::vector<VertexId>& vertices, VertexId from) {
  const std::vector<double> lengths =
      lengths_from(roadmap.graph, {{from, 0.0}}, roadmap.min_clearance);
  VertexId best = from;
  for (const VertexId v : vertices)
    if (std::isfinite(lengths[number(v)]) && lengths[number(v)] > lengths[number(best)]) best = v;
  return best;
}

Point to_the_millimetre(const Point& p) { return (p * 1000.0).array().round() / 1000.0; }

}  // namespace

std::optional<std::pair<Point, Point>> example_query(const Roadmap& roadmap) {
  std::vector<VoxelId> voxels;
  for (const Vertex& vertex : roadmap.graph.vertices)
    voxels.push_back(roadmap.esdf.layout.find(vertex.voxel));
  if (voxels.empty()) return std::nullopt;
  const ComponentReport parts = SpaceParts(roadmap.esdf).report(roadmap.min_clearance, voxels);
  const std::vector<VertexId> vertices = vertices_of_largest(parts);
  if (vertices.empty()) return std::nullopt;
  // Of a tree the second search ends at the longest of all ways; of a graph it is nearly that.
  const VertexId first = farthest(roadmap, vertices, vertices.front());
  const VertexId second = farthest(roadmap, vertices, first);
  const auto place_of = [&](VertexId v) {
    return to_world(roadmap.esdf, roadmap.graph.vertices[number(v)].position);
  };
  // A room with one vertex has its widest place besides.
  const std::pair exact(place_of(first),
                        first == second ? parts.components.front().widest : place_of(second));
  if (exact.first == exact.second) return std::nullopt;  // nowhere to go
  const std::pair rounded(to_the_millimetre(exact.first), to_the_millimetre(exact.second));
  for (const auto& query : {rounded, exact})
    if (plan(roadmap, query.first, query.second).ok()) return query;
  return std::nullopt;
}

}  // namespace ridgeway::cli
