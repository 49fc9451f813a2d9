// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <limits>

#include "bounded_hub_labels.hpp"
#include "corner_links.hpp"
#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/tangent_graph.hpp"

namespace ridgeway {
namespace {

/// The voxel nearest to where a corner comes to lie when it is moved outwards until a robot of a
/// radius fits, of the 27 around that place; kNoVoxel where it fits on none.
VoxelId moved_outwards(const EsdfMap& esdf, VoxelId corner, double radius) {
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  if (esdf.squared[corner] >= threshold) return corner;
  const Point outward = detail::outward_at(esdf, corner);
  if (outward.norm() == 0.0) return kNoVoxel;
  const Point place = centre_of(esdf.layout.index_of(corner), esdf.voxel_size) +
                      (radius - esdf.distance(corner)) * outward.normalized();
  const VoxelId home = esdf.layout.find(voxel_at(place, esdf.voxel_size));
  VoxelId best = kNoVoxel;
  double nearest = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 27 && home != kNoVoxel; ++d) {
    const VoxelId id = esdf.layout.neighbour(home, d);
    if (id == kNoVoxel || esdf.state[id] != VoxelState::kFree || esdf.squared[id] < threshold)
      continue;
    const double off = (centre_of(esdf.layout.index_of(id), esdf.voxel_size) - place).squaredNorm();
    if (off >= nearest) continue;
    nearest = off;
    best = id;
  }
  return best;
}

SparseGraph widened(const EsdfMap& esdf, const SparseGraph& narrow, double radius) {
  SparseGraph graph{radius, narrow.vertices, {}, {}, {}};
  std::vector<char> fits(graph.vertices.size());
  parallel_for_each_index(fits.size(), [&](std::size_t v) {
    Vertex& vertex = graph.vertices[v];
    const VoxelId id = moved_outwards(esdf, esdf.layout.find(vertex.voxel), radius);
    fits[v] = id != kNoVoxel;
    if (!fits[v]) return;
    vertex.voxel = esdf.layout.index_of(id);
    vertex.position = centre_of(vertex.voxel, esdf.voxel_size);
    vertex.clearance = esdf.distance(id);
  });
  const FreeSpace space(esdf);
  std::vector<Edge> edges = narrow.edges;
  parallel_for_each_index(
      edges.size(),
      [&](std::size_t i) {
        Edge& edge = edges[i];
        edge.clearance = 0.0;
        const Point& from = graph.vertices[number(edge.from)].position;
        const Point& to = graph.vertices[number(edge.to)].position;
        if (!fits[number(edge.from)] || !fits[number(edge.to)] || !space.is_free(from, to, radius))
          return;
        edge.length = (to - from).norm();
        edge.clearance = space.clearance(from, to);
      },
      16);
  std::erase_if(edges, [](const Edge& edge) { return edge.clearance == 0.0; });
  graph.edges = std::move(edges);
  index_links(graph);
  return graph;
}

}  // namespace

std::vector<TangentGraph::Wider> widen_corners(const EsdfMap& esdf, const TangentGraph& tangents) {
  std::vector<TangentGraph::Wider> result;
  if (tangents.empty() || tangents.hubs.labels.size() > detail::kPlanning.wide_labels)
    return result;
  for (const double level : detail::kRadiusLevels) {
    const double radius = level * tangents.graph.min_clearance;
    if (level == 1.0 || radius > esdf.max_distance - 2.0 * esdf.voxel_size) continue;
    TangentGraph::Wider wider{widened(esdf, tangents.graph, radius), {}};
    auto hubs = detail::label_hubs_within(wider.graph);
    if (!hubs) continue;
    wider.hubs = *std::move(hubs);
    result.push_back(std::move(wider));
  }
  return result;
}

}  // namespace ridgeway
