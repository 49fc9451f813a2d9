// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corner_sampling.hpp"

#include <optional>
#include <utility>

#include "attach_way.hpp"
#include "common/random.hpp"
#include "graph_search.hpp"
#include "paths/shorten.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

constexpr int kTries = 1000;  // to meet a traversable voxel

VoxelId random_voxel(const Roadmap& roadmap, Random& random) {
  const VoxelField<Direction>& next = roadmap.attach.next;
  for (int i = 0; i < kTries; ++i) {
    const VoxelId id =
        roadmap.esdf.layout.voxel_at_order(static_cast<std::uint32_t>(random.below(next.size())));
    if (next[id] != AttachField::kNotTraversable) return id;
  }
  return kNoVoxel;
}

VoxelId random_vertex(const Roadmap& roadmap, Random& random) {
  const std::vector<Vertex>& vertices = roadmap.graph.vertices;
  if (vertices.empty()) return kNoVoxel;
  return roadmap.esdf.layout.find(vertices[random.below(vertices.size())].voxel);
}

/// The path over the graph between two voxels, pulled tight; none where they see each other.
std::optional<SampledPath> tight_path(const Roadmap& roadmap, const GraphComponents& parts,
                                      const FreeSpace& space, VoxelId from, VoxelId to) {
  const EsdfMap& esdf = roadmap.esdf;
  const double radius = roadmap.min_clearance;
  const auto centre = [&](VoxelId id) {
    return centre_of(esdf.layout.index_of(id), esdf.voxel_size);
  };
  if (space.is_free(centre(from), centre(to), radius)) return std::nullopt;
  const AttachWay start = follow_attach(roadmap, from, radius);
  const AttachWay goal = follow_attach(roadmap, to, radius);
  if (!start.reached() || !goal.reached()) return std::nullopt;
  const std::vector<VertexId> vertices =
      search_graph(roadmap.graph, roadmap.landmarks, start.vertex, goal.vertex, radius);
  if (vertices.empty()) return std::nullopt;
  std::vector<Point> path;
  for (const VoxelId id : start.voxels) path.push_back(centre(id));
  for (std::size_t i = 1; i < vertices.size(); ++i)
    path.push_back(roadmap.graph.vertices[number(vertices[i])].position);
  for (auto id = goal.voxels.rbegin() + 1; id < goal.voxels.rend(); ++id)
    path.push_back(centre(*id));
  return SampledPath{from, to, parts.label[number(start.vertex)],
                     shorten(space, std::move(path), radius, Deadline::never())};
}

}  // namespace

std::vector<SampledPath> sample_paths(const Roadmap& roadmap, std::size_t first_pair,
                                      std::size_t pairs) {
  const FreeSpace space(roadmap.esdf);
  const GraphComponents parts = connected_components(roadmap.graph);
  std::vector<std::optional<SampledPath>> by_pair(pairs);
  parallel_for_each_index(pairs, [&](std::size_t i) {
    Random random(first_pair + i);
    // Queries start anywhere, and where the graph has most vertices there is most to go around.
    const VoxelId from = random_voxel(roadmap, random);
    const VoxelId to = i % 2 == 0 ? random_voxel(roadmap, random) : random_vertex(roadmap, random);
    if (from != kNoVoxel && to != kNoVoxel)
      by_pair[i] = tight_path(roadmap, parts, space, from, to);
  });
  std::vector<SampledPath> paths;
  for (std::optional<SampledPath>& path : by_pair)
    if (path) paths.push_back(*std::move(path));
  return paths;
}

}  // namespace ridgeway::detail
