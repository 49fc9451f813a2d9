// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <limits>
#include <numeric>

#include "ridgeway/roadmap/build_graph.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

constexpr std::uint32_t kNoNode = 0xffffffffu;

/// Kruskal from the top down over two kinds of events: a vertex appears in its basin at its own
/// clearance; two basins meet at their pass. Roots are linked by size, so ways to the root stay
/// logarithmic, and linked later means narrower, so the narrowest link between two vertices is the
/// clearance at which they part.
class TreeBuilder {
 public:
  TreeBuilder(const EsdfMap& esdf, const SparseGraph& graph, const Basins& basins)
      : esdf_(esdf),
        basins_(basins),
        regions_(basins.peaks.size()),
        root_(basins.peaks.size(), kNoNode),
        size_(graph.vertices.size(), 1) {
    tree_.parent.resize(graph.vertices.size());
    for (std::uint32_t v = 0; v < graph.vertices.size(); ++v) {
      tree_.parent[v] = VertexId{v};
      voxels_.push_back(esdf.layout.find(graph.vertices[v].voxel));
    }
    tree_.clearance.assign(graph.vertices.size(), 0.0);
    tree_.place.resize(graph.vertices.size());
  }

  ClearanceTree build() {
    std::vector<std::uint32_t> order(voxels_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
      return esdf_.squared[voxels_[a]] > esdf_.squared[voxels_[b]];
    });
    std::size_t pass = 0;
    const auto sink_to = [&](SquaredHalves level) {
      for (; pass < basins_.passes.size() && basins_.passes[pass].clearance > level; ++pass)
        meet(basins_.passes[pass]);
    };
    for (const std::uint32_t v : order) {
      const SquaredHalves level = esdf_.squared[voxels_[v]];
      sink_to(level);
      std::uint32_t& root = root_[regions_.find(basins_.basin[voxels_[v]])];
      root = root == kNoNode ? v : link(root, v, level, voxels_[v]);
    }
    sink_to(SquaredHalves());
    return std::move(tree_);
  }

 private:
  void meet(const Pass& pass) {
    const std::uint32_t a = regions_.find(basins_.basin[pass.from]);
    const std::uint32_t b = regions_.find(basins_.basin[pass.to]);
    if (a == b) return;
    const std::uint32_t ra = root_[a], rb = root_[b];
    const VoxelId narrow = esdf_.squared[pass.from] <= esdf_.squared[pass.to] ? pass.from : pass.to;
    const std::uint32_t root = ra == kNoNode   ? rb
                               : rb == kNoNode ? ra
                                               : link(ra, rb, pass.clearance, narrow);
    root_[regions_.join(a, b)] = root;
  }

  std::uint32_t link(std::uint32_t a, std::uint32_t b, SquaredHalves level, VoxelId place) {
    if (size_[a] < size_[b]) std::swap(a, b);
    tree_.parent[b] = VertexId{a};
    tree_.clearance[b] = level.metres(esdf_.voxel_size);
    tree_.place[b] = esdf_.layout.index_of(place);
    size_[a] += size_[b];
    return a;
  }

  const EsdfMap& esdf_;
  const Basins& basins_;
  DisjointSets regions_;             // of basins
  std::vector<std::uint32_t> root_;  // by region: root of its vertices' tree
  std::vector<std::uint32_t> size_;
  std::vector<VoxelId> voxels_;  // by vertex
  ClearanceTree tree_;
};

}  // namespace

ClearanceTree build_clearance_tree(const EsdfMap& esdf, const SparseGraph& graph,
                                   const Basins& basins) {
  return TreeBuilder(esdf, graph, basins).build();
}

double widest_way(const SparseGraph& graph, const ClearanceTree& tree, VertexId a, VertexId b) {
  if (a == b) return graph.vertices[number(a)].clearance;
  double narrowest = std::numeric_limits<double>::infinity();
  while (a != b) {
    // Links get narrower on the way to the root: climb on the side whose link is wider.
    if (tree.clearance[number(a)] < tree.clearance[number(b)]) std::swap(a, b);
    if (tree.parent[number(a)] == a) return 0.0;
    narrowest = std::min(narrowest, tree.clearance[number(a)]);
    a = tree.parent[number(a)];
  }
  return narrowest;
}

}  // namespace ridgeway
