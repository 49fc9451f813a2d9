// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridge_checks.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>

#include "ridge_header.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {
namespace {

using Defect = std::optional<RoadmapDefect>;

bool is_length(double value) { return std::isfinite(value) && value >= 0.0; }

/// Clearances may be infinite: far from everything there is no site.
bool is_clearance(double value) { return value >= 0.0; }

/// The sections that a graph is stored in.
struct GraphParts {
  const char *vertices, *edges;
};

Defect find_vertex_defect(const Roadmap& roadmap, const SparseGraph& graph, const char* part) {
  const BlockLayout& layout = roadmap.esdf.layout;
  std::optional<std::uint32_t> last;
  for (const Vertex& v : graph.vertices) {
    const VoxelId id = layout.find(v.voxel);
    if (id == kNoVoxel) return RoadmapDefect{part, "has a vertex outside the map"};
    if (last && layout.order_of(id) <= *last) return RoadmapDefect{part, "is not in order"};
    last = layout.order_of(id);
    if (!is_clearance(v.clearance)) {
      return RoadmapDefect{part, "has a clearance that is no distance"};
    }
  }
  return {};
}

Defect find_edge_defect(const SparseGraph& graph, const char* part) {
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const Edge& edge = graph.edges[i];
    if (number(edge.to) >= graph.vertices.size() || edge.from >= edge.to) {
      return RoadmapDefect{part, "has an edge to no vertex"};
    }
    if (!is_length(edge.length) || !is_clearance(edge.clearance)) {
      return RoadmapDefect{part, "has a length or clearance that is no distance"};
    }
    if (i > 0 &&
        std::tie(graph.edges[i - 1].from, graph.edges[i - 1].to) >= std::tie(edge.from, edge.to)) {
      return RoadmapDefect{part, "is not in order"};
    }
  }
  return {};
}

/// Whether every edge has the length and the clearance that it says: queries rely on both.
bool edges_hold(const Roadmap& roadmap, const SparseGraph& graph) {
  constexpr double kRounding = 1e-9;
  constexpr double kRoundingOfPlaces = 16.0 * std::numeric_limits<double>::epsilon();
  const FreeSpace space(roadmap.esdf);
  std::atomic<bool> good = true;
  parallel_for_each_index(
      graph.edges.size(),
      [&](std::size_t i) {
        if (!good.load(std::memory_order_relaxed)) return;
        const Edge& edge = graph.edges[i];
        const std::array ends{graph.vertices[number(edge.from)].position,
                              graph.vertices[number(edge.to)].position};
        const double length = (ends[1] - ends[0]).norm();
        // What is computed of places far from the origin is no better than they are themselves.
        const double slack = kRoundingOfPlaces *
                             std::max(ends[0].cwiseAbs().maxCoeff(), ends[1].cwiseAbs().maxCoeff());
        const bool is_free = std::isinf(edge.clearance)
                                 ? std::isinf(space.clearance(ends))
                                 : space.is_free(ends[0], ends[1], edge.clearance - slack);
        if (!is_free || std::abs(length - edge.length) > kRounding * length ||
            edge.clearance < roadmap.min_clearance * (1.0 - kRounding) - slack)
          good = false;
      },
      64);
  return good;
}

Defect find_defect(const Roadmap& roadmap, const SparseGraph& graph, const GraphParts& parts) {
  if (Defect defect = find_vertex_defect(roadmap, graph, parts.vertices)) return defect;
  if (Defect defect = find_edge_defect(graph, parts.edges)) return defect;
  if (!edges_hold(roadmap, graph))
    return RoadmapDefect{parts.edges, "has an edge that comes nearer to an obstacle than it says"};
  return {};
}

/// Every vertex must reach a root: each is walked from once, up to the first known good one.
bool is_forest(const std::vector<VertexId>& parent) {
  enum : std::uint8_t { kNew, kOnTheWay, kGood };
  std::vector<std::uint8_t> mark(parent.size(), kNew);
  for (std::size_t start = 0; start < parent.size(); ++start) {
    std::size_t v = start;
    while (mark[v] == kNew && number(parent[v]) != v) {
      mark[v] = kOnTheWay;
      v = number(parent[v]);
    }
    if (mark[v] == kOnTheWay) return false;
    mark[v] = kGood;
    for (v = start; mark[v] == kOnTheWay; v = number(parent[v])) mark[v] = kGood;
  }
  return true;
}

Defect find_tree_defect(const Roadmap& roadmap) {
  const ClearanceTree& tree = roadmap.tree;
  for (std::size_t v = 0; v < tree.parent.size(); ++v) {
    if (number(tree.parent[v]) >= tree.parent.size()) {
      return RoadmapDefect{"tree", "has a parent that is no vertex"};
    }
    if (!is_clearance(tree.clearance[v])) {
      return RoadmapDefect{"tree", "has a clearance that is no distance"};
    }
    const bool root = number(tree.parent[v]) == v;
    if (!root && roadmap.esdf.layout.find(tree.place[v]) == kNoVoxel) {
      return RoadmapDefect{"tree", "has a narrowest place outside the map"};
    }
  }
  if (!is_forest(tree.parent)) return RoadmapDefect{"tree", "goes in a circle"};
  return {};
}

/// What one look at the ways of a block tells.
struct WaysOfBlock {
  bool stay_inside = true;          // every one leads to a traversable voxel
  std::vector<VoxelId> descending;  // voxels whose way does not climb
};

/// Clearance and then the order of voxels rank them as basins do, so a way that only climbs has an
/// end.
bool climbs(const EsdfMap& esdf, VoxelId from, VoxelId to) {
  return std::pair(esdf.squared[to], esdf.layout.order_of(from)) >
         std::pair(esdf.squared[from], esdf.layout.order_of(to));
}

WaysOfBlock look_at_ways(const Roadmap& roadmap, std::uint32_t slot) {
  const BlockLayout& layout = roadmap.esdf.layout;
  const VoxelField<Direction>& next = roadmap.attach.next;
  const VoxelId first = slot * kBlockVoxels;
  WaysOfBlock ways;
  for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
    const Direction direction = next[id];
    if (direction == AttachField::kNotTraversable || direction == AttachField::kHere) continue;
    const VoxelId to = layout.neighbour(id, direction);
    if (to == kNoVoxel || next[to] == AttachField::kNotTraversable) {
      ways.stay_inside = false;
      return ways;
    }
    if (!climbs(roadmap.esdf, id, to)) ways.descending.push_back(id);
  }
  return ways;
}

/// Whether every way ends; a circle goes through a voxel where it does not climb. Each voxel is
/// walked from once, up to the first known good one.
bool ways_end(const Roadmap& roadmap, const std::vector<WaysOfBlock>& ways) {
  const BlockLayout& layout = roadmap.esdf.layout;
  const VoxelField<Direction>& next = roadmap.attach.next;
  VoxelMask good(layout);
  std::vector<VoxelId> way;
  for (const WaysOfBlock& of_block : ways)
    for (const VoxelId start : of_block.descending) {
      way.clear();
      for (VoxelId id = start; !good.test(id); id = layout.neighbour(id, next[id])) {
        way.push_back(id);
        if (next[id] == AttachField::kHere) break;
        if (way.size() > next.size()) return false;
      }
      for (const VoxelId id : way) good.set(id);
    }
  return true;
}

}  // namespace

Defect find_size_defect(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::size_t voxels = esdf.layout.voxel_count(), blocks = esdf.layout.block_count();
  if (!(esdf.voxel_size >= 1e-6 && esdf.voxel_size <= 1e6)) {
    return RoadmapDefect{"header", "has no voxel size from 1e-6 to 1e6 metres"};
  }
  if (esdf.state.size() != voxels || esdf.squared.size() != voxels || esdf.site.size() != voxels ||
      esdf.obstacle.block_count() != blocks) {
    return RoadmapDefect{"state", "has fields that do not fit the blocks"};
  }
  if (roadmap.diagram.voxels.block_count() != blocks) {
    return RoadmapDefect{"diagram", "does not fit the blocks"};
  }
  if (roadmap.attach.next.size() != voxels) {
    return RoadmapDefect{"attach", "does not fit the blocks"};
  }
  const std::size_t vertices = roadmap.graph.vertices.size();
  if (roadmap.graph.edges.size() > kMostEdgesPerVertex * vertices)
    return RoadmapDefect{"edges", "has more of them than the vertices can have"};
  const ClearanceTree& tree = roadmap.tree;
  if (tree.parent.size() != vertices || tree.clearance.size() != vertices ||
      tree.place.size() != vertices) {
    return RoadmapDefect{"tree", "does not fit the number of vertices"};
  }
  const TangentGraph& tangents = roadmap.tangents;
  if (tangents.graph.vertices.size() > TangentGraph::kMostCorners) {
    return RoadmapDefect{"corners", "has more of them than are learnt"};
  }
  if (tangents.graph.edges.size() > kMostEdgesPerVertex * tangents.graph.vertices.size())
    return RoadmapDefect{"taut_edges", "has more of them than the corners can have"};
  for (std::size_t region = 1; region < tangents.first_seen.size(); ++region)
    if (tangents.first_seen[region] - tangents.first_seen[region - 1] > TangentGraph::kMostSeen)
      return RoadmapDefect{"cells", "counts more corners than are listed"};
  const bool has_regions = !tangents.empty();
  if (has_regions == tangents.graph.vertices.empty() ||
      (has_regions && (tangents.region_of_block.size() != blocks ||
                       tangents.first_seen.back() != tangents.seen.size() ||
                       tangents.first_seen.size() != number_regions(esdf.layout).count + 1u))) {
    return RoadmapDefect{"cells", "does not fit the blocks, or the corners"};
  }
  return {};
}

Defect find_graph_defect(const Roadmap& roadmap) {
  if (Defect defect = find_defect(roadmap, roadmap.graph, {"vertices", "edges"})) return defect;
  return find_tree_defect(roadmap);
}

Defect find_tangent_defect(const Roadmap& roadmap) {
  const TangentGraph& tangents = roadmap.tangents;
  if (Defect defect = find_defect(roadmap, tangents.graph, {"corners", "taut_edges"}))
    return defect;
  for (const VertexId v : tangents.seen)
    if (number(v) >= tangents.graph.vertices.size())
      return RoadmapDefect{"seen", "has a corner that does not exist"};
  return {};
}

Defect find_planar_defect(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  if (!esdf.planar) return {};
  constexpr VoxelId kInLayer = kBlockSide * kBlockSide;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    const VoxelId lowest = id - id % kBlockVoxels + id % kInLayer;
    const SiteOffset site = esdf.site[id];
    if (esdf.layout.block(id / kBlockVoxels).z != 0 || esdf.state[id] != esdf.state[lowest] ||
        site != esdf.site[lowest] || site.z != 0)
      return RoadmapDefect{"state", "is no map of one layer, which the header says"};
  }
  return {};
}

Defect find_unattached_defect(const Roadmap& roadmap) {
  const VoxelMask traversable = traversable_voxels(roadmap.esdf, roadmap.min_clearance);
  std::atomic<bool> good = true;
  parallel_for_each_index(
      roadmap.esdf.layout.block_count(),
      [&](std::size_t slot) {
        const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
        for (VoxelId id = first; id < first + kBlockVoxels; ++id)
          if ((roadmap.attach.next[id] != AttachField::kNotTraversable) != traversable.test(id))
            good.store(false, std::memory_order_relaxed);
      },
      64);
  if (good) return {};
  return RoadmapDefect{"attach", "is not of the space that robots of the smallest radius fit in"};
}

Defect find_attach_defect(const Roadmap& roadmap) {
  std::vector<WaysOfBlock> ways(roadmap.esdf.layout.block_count());
  parallel_for_each_index(
      ways.size(),
      [&](std::size_t slot) {
        ways[slot] = look_at_ways(roadmap, static_cast<std::uint32_t>(slot));
      },
      64);
  if (!std::all_of(ways.begin(), ways.end(), [](const WaysOfBlock& w) { return w.stay_inside; }))
    return RoadmapDefect{"attach", "leaves traversable space"};
  if (!ways_end(roadmap, ways)) return RoadmapDefect{"attach", "goes in a circle"};
  return {};
}

}  // namespace ridgeway
