// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/roadmap/hub_labels.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"
#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {

struct Roadmap;

/// Where tight paths for the smallest robot turn, and between which of those places they run: the
/// sparse graph goes along the middle of space, this one close around the corners, so that a route
/// over it is nearly as short as can be before anything is pulled tight. A tangent graph (Liu and
/// Arimoto, "Path planning using a tangent graph for mobile robots among polygonal and curved
/// obstacles", 1992) of the corners that sampled routes were seen to use (experience graphs:
/// Phillips et al. 2012). It need not reach everywhere: what it does not know, the sparse graph
/// does.
struct TautGraph {
  /// More are not learnt: hub labels grow with their square, in the worst case.
  static constexpr std::size_t kMostCorners = 8192;
  /// More are not listed for a cell.
  static constexpr std::size_t kMostSeen = 24;

  SparseGraph graph;  ///< its vertices are the corners; free at its min_clearance
  HubLabels hubs;     ///< of the graph; not in the file, found when it is loaded

  /// Which corners are worth a look from a place, by cell: cells are cubes of 2 x 2 x 2 blocks.
  std::vector<std::uint32_t> cell_of_block;  ///< by slot; not in the file
  std::vector<std::uint32_t> first_seen;     ///< cells + 1 entries into `seen`; empty: no graph
  std::vector<VertexId> seen;

  bool empty() const { return first_seen.empty(); }

  std::span<const VertexId> seen_from(VoxelId voxel) const {
    if (empty()) return {};
    const std::uint32_t cell = cell_of_block[voxel / kBlockVoxels];
    return std::span(seen).subspan(first_seen[cell], first_seen[cell + 1] - first_seen[cell]);
  }
};

struct TautConfig {
  std::size_t most_pairs = 2000;  ///< of places, to learn from ways between them; 0: no graph

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Learns the corners from routes over the sparse graph between random places, in rounds until it
/// knows the way of most new ones; empty where that takes too many. The roadmap must be complete
/// but for this. Deterministic. Every edge is verified. Throws InputError naming the bad field.
TautGraph build_taut_graph(const Roadmap& roadmap, const TautConfig& config = {});

/// Numbers the cells of a layout, in the order of their first blocks.
struct BlockCells {
  std::vector<std::uint32_t> cell_of_block;  ///< by slot
  std::uint32_t count = 0;
};
BlockCells number_cells(const BlockLayout& layout);

}  // namespace ridgeway
