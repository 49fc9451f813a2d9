// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corner_links.hpp"

#include <cmath>
#include <limits>

#include "best_first_search.hpp"
#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of corners that see each other: those that follow each other on a path, and near ones.
std::vector<Pair> visible_pairs(const FreeSpace& space, double radius,
                                const std::vector<Corner>& corners, std::vector<Pair> pairs) {
  std::vector<std::vector<std::uint32_t>> near(corners.size());
  parallel_for_each_index(corners.size(), [&](std::size_t i) {
    near[i] = nearest_corners(corners, corners[i].place, kPlanning.linked, [&](std::uint32_t j) {
      return j != i && corners[j].part == corners[i].part &&
             may_turn(corners[i], corners[j].place) && may_turn(corners[j], corners[i].place);
    });
  });
  for (std::uint32_t i = 0; i < near.size(); ++i)
    for (const std::uint32_t j : near[i]) pairs.emplace_back(std::minmax(i, j));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<char> is_free(pairs.size());
  parallel_for_each_index(
      pairs.size(),
      [&](std::size_t i) {
        const auto& [a, b] = pairs[i];
        is_free[i] = space.is_free(corners[a].place, corners[b].place, radius);
      },
      16);
  std::vector<Pair> visible;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (is_free[i] != 0) visible.push_back(pairs[i]);
  return visible;
}

/// The shortest pairs first, those alone that no way over shorter ones replaces (greedy spanner,
/// Althoefer et al. 1993).
class Spanner {
 public:
  explicit Spanner(const std::vector<Corner>& corners)
      : corners_(corners),
        links_(corners.size()),
        search_(corners.size(), std::numeric_limits<double>::infinity()) {}

  bool add(const Pair& pair, double length) {
    if (has_way(pair, length)) return false;
    links_[pair.first].emplace_back(pair.second, length);
    links_[pair.second].emplace_back(pair.first, length);
    return true;
  }

 private:
  /// Whether a way no longer than `most` leads from one to the other.
  bool has_way(const Pair& pair, double most) {
    const Point& goal = corners_[pair.second].place;
    search_.restart();
    search_.offer(pair.first, 0.0, pair.first);
    search_.run([&](std::uint32_t v) {
      for (const auto& [next, own] : links_[v])
        if (const double length = search_.cost(v) + own;
            length + (corners_[next].place - goal).norm() <= most)
          search_.offer(next, length, v);
      return !search_.is_reached(pair.second);
    });
    return search_.is_reached(pair.second);
  }

  const std::vector<Corner>& corners_;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> links_;
  BestFirstSearch<std::uint32_t, double> search_;
};

/// The direction away from what a place is beside: the gradient of the distance, of length 1, or
/// shorter where obstacles of several sides meet.
Point outward_at(const EsdfMap& esdf, VoxelId id) {
  const auto distance = [&](int dx, int dy, int dz) {
    const VoxelId near = esdf.layout.step(id, dx, dy, dz);
    const double d = near == kNoVoxel ? 0.0 : esdf.distance(near);
    return std::isinf(d) ? 0.0 : d;
  };
  const Point rise(distance(1, 0, 0) - distance(-1, 0, 0), distance(0, 1, 0) - distance(0, -1, 0),
                   distance(0, 0, 1) - distance(0, 0, -1));
  return rise / (2.0 * esdf.voxel_size);
}

}  // namespace

std::vector<Corner> corners_of(const Roadmap& roadmap, const MergedCorners& merged) {
  const EsdfMap& esdf = roadmap.esdf;
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < merged.voxels.size(); ++i)
    corners.push_back({centre_of(esdf.layout.index_of(merged.voxels[i]), esdf.voxel_size),
                       outward_at(esdf, merged.voxels[i]), merged.parts[i]});
  return corners;
}

bool may_turn(const Corner& corner, const Point& from) {
  const Point along = from - corner.place;
  return along.dot(corner.outward) <= kPlanning.over_tangent * along.norm();
}

SparseGraph link_corners(const Roadmap& roadmap, const MergedCorners& merged,
                         const std::vector<Corner>& corners) {
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  SparseGraph graph;
  graph.min_clearance = roadmap.min_clearance;
  for (const VoxelId id : merged.voxels)
    graph.vertices.push_back({esdf.layout.index_of(id),
                              centre_of(esdf.layout.index_of(id), esdf.voxel_size),
                              esdf.distance(id)});
  std::vector<std::pair<double, Pair>> by_length;
  for (const Pair& pair : visible_pairs(space, roadmap.min_clearance, corners, merged.steps))
    by_length.emplace_back((corners[pair.first].place - corners[pair.second].place).norm(), pair);
  std::sort(by_length.begin(), by_length.end());
  Spanner spanner(corners);
  for (const auto& [length, pair] : by_length)
    if (spanner.add(pair, length))
      graph.edges.push_back({VertexId{pair.first}, VertexId{pair.second}, length, 0.0});
  parallel_for_each_index(graph.edges.size(), [&](std::size_t i) {
    Edge& edge = graph.edges[i];
    edge.clearance = space.clearance(graph.vertices[number(edge.from)].position,
                                     graph.vertices[number(edge.to)].position);
  });
  index_links(graph);
  return graph;
}

}  // namespace ridgeway::detail
