// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "../paths/shorten.hpp"
#include "corner_merging.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "taut_search.hpp"

namespace ridgeway {
namespace {

using detail::MergedCorners;
using detail::SampledPath;

constexpr double kMergeDistance = 1.0;    // radii: nearer corners may become one
constexpr std::size_t kNeighbours = 16;   // a corner is linked to the nearest of those it can see
constexpr double kStretch = 1.005;        // an edge goes that saves less than this over others
constexpr double kOverTangent = 0.2;      // sine of the angle above a corner's tangent plane
constexpr std::size_t kMostSeen = 24;     // corners listed for a cell
constexpr std::size_t kMostTried = 72;    // looks at corners for it
constexpr std::size_t kFirstPairs = 250;  // of places to learn from
constexpr std::size_t kAskedPairs = 100;  // between which new paths show how much is known
constexpr std::size_t kLeastAsked = 20;   // paths
constexpr double kAboutAsShort = 1.1;     // as the tight path between the places
constexpr double kKnown = 0.85;           // of the paths: that is enough
constexpr double kHopeless = 0.65;        // that is too little to go on

/// A corner and the direction away from what it goes around: the gradient of the distance, shorter
/// where obstacles of several sides meet.
struct Corner {
  Point place, outward;
};

Corner corner_at(const EsdfMap& esdf, VoxelId id) {
  Corner corner{centre_of(esdf.layout.index_of(id), esdf.voxel_size), Point::Zero()};
  const auto distance = [&](int dx, int dy, int dz) {
    const VoxelId near = esdf.layout.step(id, dx, dy, dz);
    const double d = near == kNoVoxel ? 0.0 : esdf.distance(near);
    return std::isinf(d) ? 0.0 : d;
  };
  const Point rise(distance(1, 0, 0) - distance(-1, 0, 0), distance(0, 1, 0) - distance(0, -1, 0),
                   distance(0, 0, 1) - distance(0, 0, -1));
  corner.outward = rise / (2.0 * esdf.voxel_size);
  return corner;
}

/// Whether a tight path may come to a corner from a place, or leave to it: not from above what it
/// goes around, or the path would not turn there.
bool may_turn(const Corner& corner, const Point& from) {
  const Point along = from - corner.place;
  return along.dot(corner.outward) <= kOverTangent * along.norm();
}

/// The corners that path may turn at coming from a place, nearest first.
template <typename MayTurn>
std::vector<std::uint32_t> nearest_corners(const std::vector<Corner>& corners, const Point& place,
                                           std::size_t most, const MayTurn& may) {
  std::vector<std::pair<double, std::uint32_t>> near;
  for (std::uint32_t i = 0; i < corners.size(); ++i)
    if (may(i)) near.emplace_back((corners[i].place - place).squaredNorm(), i);
  const auto last = near.begin() + static_cast<std::ptrdiff_t>(std::min(most, near.size()));
  std::partial_sort(near.begin(), last, near.end());
  std::vector<std::uint32_t> result;
  for (auto it = near.begin(); it != last; ++it) result.push_back(it->second);
  return result;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of corners that see each other: those that follow each other on a path, and near ones.
std::vector<Pair> visible_pairs(const FreeSpace& space, double radius,
                                const std::vector<Corner>& corners, std::vector<Pair> pairs) {
  std::vector<std::vector<std::uint32_t>> near(corners.size());
  parallel_for_each_index(corners.size(), [&](std::size_t i) {
    near[i] = nearest_corners(corners, corners[i].place, kNeighbours, [&](std::uint32_t j) {
      return j != i && may_turn(corners[i], corners[j].place) &&
             may_turn(corners[j], corners[i].place);
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
      : corners_(corners), links_(corners.size()), lengths_(corners.size(), kFar) {}

  bool add(const Pair& pair, double length) {
    if (shortest_way(pair, kStretch * length)) return false;
    links_[pair.first].emplace_back(pair.second, length);
    links_[pair.second].emplace_back(pair.first, length);
    return true;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  bool shortest_way(const Pair& pair, double most) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<std::uint32_t> touched;
    const Point& goal = corners_[pair.second].place;
    const auto reach = [&](std::uint32_t v, double length) {
      if (length >= lengths_[v] || length + (corners_[v].place - goal).norm() > most) return;
      lengths_[v] = length;
      touched.push_back(v);
      open.emplace(length, v);
    };
    reach(pair.first, 0.0);
    bool found = false;
    while (!open.empty() && !found) {
      const auto [length, v] = open.top();
      open.pop();
      found = v == pair.second;
      if (length > lengths_[v]) continue;
      for (const auto& [next, own] : links_[v]) reach(next, length + own);
    }
    for (const std::uint32_t v : touched) lengths_[v] = kFar;
    return found;
  }

  const std::vector<Corner>& corners_;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> links_;
  std::vector<double> lengths_;
};

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

/// The widest traversable voxel of every cell, or kNoVoxel.
std::vector<VoxelId> widest_of_cells(const Roadmap& roadmap, const BlockCells& cells) {
  const EsdfMap& esdf = roadmap.esdf;
  std::vector<VoxelId> widest(cells.count, kNoVoxel);
  for (VoxelId id = 0; id < roadmap.attach.next.size(); ++id) {
    if (roadmap.attach.next[id] == AttachField::kNotTraversable) continue;
    VoxelId& best = widest[cells.cell_of_block[id / kBlockVoxels]];
    if (best == kNoVoxel || esdf.squared[id] > esdf.squared[best]) best = id;
  }
  return widest;
}

/// The corners that can be seen from a place and that a tight path from there may turn at.
std::vector<VertexId> look_around(const FreeSpace& space, double radius,
                                  const std::vector<Corner>& corners, const Point& place) {
  std::vector<VertexId> seen;
  for (const std::uint32_t i : nearest_corners(corners, place, kMostTried, [&](std::uint32_t j) {
         return may_turn(corners[j], place);
       })) {
    if (!space.is_free(place, corners[i].place, radius)) continue;
    seen.push_back(VertexId{i});
    if (seen.size() == kMostSeen) break;
  }
  return seen;
}

/// Learns corners, each time from as many paths as before, until it knows the way of most new ones.
class Learning {
 public:
  explicit Learning(const Roadmap& roadmap)
      : roadmap_(roadmap),
        space_(roadmap.esdf),
        merging_(roadmap, kMergeDistance * roadmap.min_clearance) {
    BlockCells cells = number_cells(roadmap.esdf.layout);
    widest_ = widest_of_cells(roadmap, cells);
    taut_.cell_of_block = std::move(cells.cell_of_block);
  }

  TautGraph run(std::size_t most_pairs) {
    std::size_t more = kFirstPairs;
    while (pairs_ + more + kAskedPairs <= most_pairs) {
      learn(sample(more));
      link();
      const std::vector<SampledPath> unseen = sample(kAskedPairs);
      const double known = share_known(unseen);
      if (known < kHopeless) break;
      learn(unseen);
      more = pairs_;
      if (known < kKnown) continue;
      link();
      list_seen();
      return std::move(taut_);
    }
    return {};  // too much to learn: queries had better not rely on it
  }

 private:
  std::vector<SampledPath> sample(std::size_t pairs) {
    pairs_ += pairs;
    return detail::sample_paths(roadmap_, pairs_ - pairs, pairs);
  }

  void learn(const std::vector<SampledPath>& paths) {
    for (const SampledPath& path : paths) merging_.add(path);
  }

  void link() {
    const MergedCorners merged = merging_.merged();
    corners_.clear();
    for (const VoxelId id : merged.voxels) corners_.push_back(corner_at(roadmap_.esdf, id));
    taut_.graph = link_corners(roadmap_, merged, corners_);
    taut_.landmarks = place_landmarks(taut_.graph);
  }

  /// Of the shorter paths between two places, the share for which there is a route about as short.
  /// Nothing is known where there are next to none.
  double share_known(const std::vector<SampledPath>& paths) const {
    std::vector<const SampledPath*> asked;
    for (const SampledPath& path : paths)
      if (asked.empty() || asked.back()->from != path.from) asked.push_back(&path);
    if (asked.size() < kLeastAsked) return 0.0;
    std::vector<char> is_known(asked.size());
    parallel_for_each_index(asked.size(), [&](std::size_t i) {
      is_known[i] =
          route_length(*asked[i]) <= kAboutAsShort * detail::length_of(asked[i]->waypoints);
    });
    return static_cast<double>(std::count(is_known.begin(), is_known.end(), 1)) /
           static_cast<double>(asked.size());
  }

  double route_length(const SampledPath& path) const {
    const auto seen_from = [&](VoxelId id) {
      return look_around(space_, roadmap_.min_clearance, corners_,
                         place_of(widest_[taut_.cell_of_block[id / kBlockVoxels]]));
    };
    const std::vector<VertexId> from = seen_from(path.from), to = seen_from(path.to);
    const std::vector<VertexId> route = detail::search_taut(
        taut_.graph, taut_.landmarks, space_,
        {path.waypoints.front(), path.waypoints.back(), roadmap_.min_clearance, from, to});
    if (route.empty()) return std::numeric_limits<double>::infinity();
    double length = 0.0;
    Point last = path.waypoints.front();
    for (const VertexId v : route) {
      length += (corners_[number(v)].place - last).norm();
      last = corners_[number(v)].place;
    }
    return length + (path.waypoints.back() - last).norm();
  }

  void list_seen() {
    std::vector<std::vector<VertexId>> seen(widest_.size());
    parallel_for_each_index(seen.size(), [&](std::size_t cell) {
      if (widest_[cell] != kNoVoxel)
        seen[cell] = look_around(space_, roadmap_.min_clearance, corners_, place_of(widest_[cell]));
    });
    taut_.first_seen.push_back(0);
    for (const std::vector<VertexId>& own : seen) {
      taut_.seen.insert(taut_.seen.end(), own.begin(), own.end());
      taut_.first_seen.push_back(static_cast<std::uint32_t>(taut_.seen.size()));
    }
  }

  Point place_of(VoxelId id) const {
    return centre_of(roadmap_.esdf.layout.index_of(id), roadmap_.esdf.voxel_size);
  }

  const Roadmap& roadmap_;
  const FreeSpace space_;
  detail::CornerMerging merging_;
  std::size_t pairs_ = 0;        // of places that paths were sampled between
  std::vector<VoxelId> widest_;  // by cell
  std::vector<Corner> corners_;
  TautGraph taut_;
};

}  // namespace

BlockCells number_cells(const BlockLayout& layout) {
  BlockCells cells;
  std::map<BlockIndex, std::uint32_t> numbers;
  for (const BlockIndex& block : layout.blocks()) {
    const BlockIndex cell{block.x >> 1, block.y >> 1, block.z >> 1};
    const auto [place, is_new] = numbers.try_emplace(cell, cells.count);
    cells.count += is_new ? 1 : 0;
    cells.cell_of_block.push_back(place->second);
  }
  return cells;
}

TautGraph build_taut_graph(const Roadmap& roadmap, const TautConfig& config) {
  return Learning(roadmap).run(config.most_pairs);
}

}  // namespace ridgeway
