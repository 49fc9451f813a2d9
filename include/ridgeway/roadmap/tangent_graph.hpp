// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/roadmap/sparse_graph.hpp"
#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {

struct EsdfMap;
/// The shortest way from a vertex to a hub. Small: a query reads hundreds.
struct HubLabel {
  std::uint32_t hub = 0;  ///< by importance: 0 is the hub that most ways pass
  float length = 0.0f;    ///< of the way, metres
  friend bool operator==(const HubLabel&, const HubLabel&) = default;  ///< Equal in every field.
};

/// Shortest lengths and ways between any two vertices of a graph, without a search: each vertex
/// knows the way to a few hubs, and any two vertices that are connected share a hub on a shortest
/// way between them (2-hop cover: Cohen, Halperin, Kaplan and Zwick, "Reachability and distance
/// queries via 2-hop labels", 2003). All edges count, whatever their clearance.
struct HubLabels {
  std::vector<std::uint32_t> first;  ///< vertices + 1 entries into `labels`
  std::vector<HubLabel> labels;      ///< of each vertex by ascending hub
  std::vector<VertexId> next;  ///< by label: next vertex on the way; the hub itself at its end

  /// Those of a vertex.
  std::span<const HubLabel> of(VertexId v) const {
    return std::span(labels).subspan(first[number(v)], first[number(v) + 1] - first[number(v)]);
  }
};

/// Pruned landmark labelling (Akiba, Iwata and Yoshida, "Fast exact shortest-path distance queries
/// on large networks by pruned landmark labeling", 2013): from each hub, the most important first,
/// a Dijkstra that stops where earlier hubs already know a way as short. Deterministic.
HubLabels label_hubs(const SparseGraph& graph);

/// The vertices on the way from one that has a label of the hub, itself first, to the hub.
std::vector<VertexId> way_to_hub(const HubLabels& hubs, VertexId from, std::uint32_t hub);

struct Roadmap;

/// Where tight paths for the smallest robot turn, and between which of those places they run: the
/// sparse graph goes along the middle of space, this one close around the corners, so that a route
/// over it is nearly as short as can be before anything is pulled tight. A tangent graph (Liu and
/// Arimoto, "Path planning using a tangent graph for mobile robots among polygonal and curved
/// obstacles", 1992) of the corners that sampled routes were seen to use (experience graphs:
/// Phillips et al. 2012). It need not reach everywhere: what it does not know, the sparse graph
/// does.
struct TangentGraph {
  /// More are not learnt: hub labels grow with their square, in the worst case.
  static constexpr std::size_t kMostCorners = 8192;
  /// More are not listed for a region.
  static constexpr std::size_t kMostSeen = 24;

  SparseGraph graph;  ///< its vertices are the corners; free at its min_clearance
  HubLabels hubs;     ///< of the graph; not in the file, found when it is loaded

  /// Which corners are worth a look from a place, by region: a cube of 2 x 2 x 2 blocks.
  std::vector<std::uint32_t> region_of_block;  ///< by slot; not in the file
  std::vector<std::uint32_t> first_seen;       ///< regions + 1 entries into `seen`; empty: no graph
  std::vector<VertexId> seen;  ///< corners of `graph`, of each region in one piece: see seen_from

  /// Whether nothing was learnt.
  bool empty() const { return first_seen.empty(); }

  /// Corners that are worth a look from a voxel of the map; none where nothing was learnt.
  std::span<const VertexId> seen_from(VoxelId voxel) const {
    if (empty()) return {};
    const std::uint32_t region = region_of_block[voxel / kBlockVoxels];
    return std::span(seen).subspan(first_seen[region], first_seen[region + 1] - first_seen[region]);
  }
};

/// How much is learnt of where tight paths turn.
struct TangentConfig {
  std::size_t tangent_pairs = 2000;  ///< of places, to learn from ways between them; 0: no graph

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Learns the corners from routes over the sparse graph between random places, in rounds until it
/// knows the way of most new ones; empty where that takes too many. The roadmap must be complete
/// but for this. Deterministic. Every edge is verified. Throws InputError naming the bad field.
TangentGraph build_tangent_graph(const Roadmap& roadmap, const TangentConfig& config = {});

/// Numbers the regions of a layout, in the order of their first blocks.
struct BlockRegions {
  std::vector<std::uint32_t> region_of_block;  ///< by slot
  std::uint32_t count = 0;                     ///< of regions
};
BlockRegions number_regions(const BlockLayout& layout);  ///< Takes time linear in the blocks.

}  // namespace ridgeway
