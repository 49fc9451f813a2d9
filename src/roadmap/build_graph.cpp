// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/build_graph.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/require.hpp"
#include "esdf/known_radius.hpp"
#include "esdf/remembered_space.hpp"
#include "graph_of_curves.hpp"
#include "ridgeway/common/parallel.hpp"
#include "segment_fitting.hpp"
#include "vertex_selection.hpp"

namespace ridgeway {
namespace {

using detail::Curve;
using detail::DiagramCurves;
using detail::DiagramNumber;
using detail::require;
using detail::Segment;

/// Straight segments of all curves, each pair of ends once, in ascending order.
std::vector<Segment> fit_all(const EsdfMap& esdf, const DiagramCurves& diagram,
                             const std::vector<Curve>& curves, const GraphConfig& config,
                             detail::SegmentMemory* memory) {
  const detail::FitConfig fit{
      config.min_clearance,
      config.widest_kept > 0.0 ? config.widest_kept : 3.0 * config.min_clearance,
      config.split_deviation > 0.0 ? config.split_deviation : 2.0 * esdf.voxel_size};
  std::vector<std::vector<Segment>> of_curve(curves.size());
  parallel_for_each_index(curves.size(), [&](std::size_t i) {
    detail::fit_segments(esdf, diagram, curves[i], fit, memory, of_curve[i]);
  });
  std::vector<Segment> segments;
  for (const std::vector<Segment>& of_one : of_curve)
    for (const Segment& s : of_one)
      segments.push_back({std::min(s.from, s.to), std::max(s.from, s.to)});
  const auto ends = [](const Segment& s) { return std::pair(s.from, s.to); };
  std::sort(segments.begin(), segments.end(),
            [&](const Segment& a, const Segment& b) { return ends(a) < ends(b); });
  segments.erase(
      std::unique(segments.begin(), segments.end(),
                  [&](const Segment& a, const Segment& b) { return ends(a) == ends(b); }),
      segments.end());
  return segments;
}

SparseGraph make_graph(const EsdfMap& esdf, const DiagramCurves& diagram,
                       std::vector<DiagramNumber> vertices, const std::vector<Segment>& segments,
                       double min_clearance, detail::SegmentMemory* memory) {
  for (const Segment& s : segments) vertices.insert(vertices.end(), {s.from, s.to});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto id_of = [&](DiagramNumber v) {
    const auto place = std::lower_bound(vertices.begin(), vertices.end(), v);
    return VertexId{static_cast<std::uint32_t>(place - vertices.begin())};
  };
  SparseGraph graph;
  graph.min_clearance = min_clearance;
  for (const DiagramNumber v : vertices) {
    const VoxelId id = diagram.voxels[v];
    graph.vertices.push_back({esdf.layout.index_of(id), diagram.position(v), esdf.distance(id)});
  }
  graph.edges.resize(segments.size());
  const detail::RememberedSpace space(esdf, memory);
  parallel_for_each_index(
      segments.size(),
      [&](std::size_t i) {
        const Point a = diagram.position(segments[i].from);
        const Point b = diagram.position(segments[i].to);
        graph.edges[i] = {id_of(segments[i].from), id_of(segments[i].to), (b - a).norm(),
                          space.clearance(a, b)};
      },
      16);
  index_links(graph);
  return graph;
}

}  // namespace

void GraphConfig::validate() const {
  require(min_clearance > 0.0 && std::isfinite(min_clearance), "min_clearance", min_clearance,
          "give the robot's radius in metres, above 0");
  require(prune_radius >= 0.0 && std::isfinite(prune_radius), "prune_radius", prune_radius,
          "give a length in metres, 0 or more");
  require(split_deviation >= 0.0 && std::isfinite(split_deviation), "split_deviation",
          split_deviation, "give a length in metres, 0 for two voxels");
  require(widest_kept >= 0.0 && std::isfinite(widest_kept), "widest_kept", widest_kept,
          "give metres, 0 for three times min_clearance");
}

SparseGraph build_graph(const EsdfMap& esdf, const VoxelMask& diagram, const GraphConfig& config) {
  config.validate();
  detail::require_known_radius(esdf, "min_clearance", config.min_clearance);
  return detail::build_graph(esdf, detail::index_diagram(esdf, diagram, config.min_clearance),
                             config);
}

SparseGraph detail::build_graph(const EsdfMap& esdf, const DiagramCurves& curves,
                                const GraphConfig& config, SegmentMemory* memory) {
  const double s = esdf.voxel_size;
  // On a coarse lattice a junction is a clump of a few voxels, however small the radius.
  const double prune_voxels = std::max(config.prune_radius / s, 2.0);
  const std::vector<DiagramNumber> vertices = detail::select_vertices(curves, prune_voxels);
  const detail::DiagramFlood flood = detail::flood_from(curves, vertices);
  // A loop round even the thinnest obstacle is longer than this.
  const double shortest_loop = 4.0 * config.min_clearance / s;
  const std::vector<Curve> pieces = detail::follow_curves(curves, flood, shortest_loop);
  return make_graph(esdf, curves, vertices, fit_all(esdf, curves, pieces, config, memory),
                    config.min_clearance, memory);
}

AttachField build_attach_field(const EsdfMap& esdf, const VoxelMask& diagram,
                               const SparseGraph& graph, Basins basins) {
  return detail::build_attach_field(esdf, detail::index_diagram(esdf, diagram, graph.min_clearance),
                                    graph, std::move(basins));
}

AttachField detail::build_attach_field(const EsdfMap& esdf, const DiagramCurves& curves,
                                       const SparseGraph& graph, Basins basins) {
  std::vector<DiagramNumber> vertices;
  for (const Vertex& vertex : graph.vertices)
    vertices.push_back(curves.find(esdf.layout.find(vertex.voxel)));
  const detail::DiagramFlood flood = detail::flood_from(curves, vertices);
  assert(basins.next.is_of(esdf.layout));
  AttachField attach{std::move(basins.next)};
  for (DiagramNumber v = 0; v < curves.size(); ++v) {
    const DiagramNumber to = flood.toward[v] == detail::kNowhere ? v : flood.toward[v];
    const VoxelIndex o =
        esdf.layout.index_of(curves.voxels[to]) - esdf.layout.index_of(curves.voxels[v]);
    attach.next[curves.voxels[v]] = static_cast<Direction>(direction_of(o));
  }
  return attach;
}

}  // namespace ridgeway
