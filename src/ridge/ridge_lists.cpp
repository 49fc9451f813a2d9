// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>

#include "files/little_endian.hpp"
#include "ridge_sections.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kBlockBytes = 12;
constexpr std::size_t kVertexBytes = 20;
constexpr std::size_t kEdgeBytes = 24;
constexpr std::size_t kTreeBytes = 24;
constexpr std::size_t kNumberBytes = 4;

/// Appends one number of every item, item after item: alike bytes stand together.
template <typename Items, typename NumberOf>
void append_plane(std::vector<std::byte>& bytes, const Items& items, const NumberOf& number_of) {
  for (const auto& item : items) append_number(bytes, number_of(item));
}

template <typename Items, typename Number, typename Item>
void append_plane(std::vector<std::byte>& bytes, const Items& items, Number Item::*member) {
  append_plane(bytes, items, [member](const Item& item) { return item.*member; });
}

/// Hands out the planes of a section in the order in which they were appended.
class Planes {
 public:
  Planes(const RidgeReader& reader, const char* name, std::uint32_t type, std::size_t count,
         std::size_t item_bytes)
      : bytes_(reader.read_all(reader.get_section(name, type), count * item_bytes)),
        count_(count) {}

  /// Calls put(i, number) for every item.
  template <typename Number, typename Put>
  void take(const Put& put) {
    for (std::size_t i = 0; i < count_; ++i) put(i, number_at<Number>(bytes_, offset_, i));
    offset_ += count_ * sizeof(Number);
  }

 private:
  std::vector<std::byte> bytes_;
  std::size_t count_;
  std::size_t offset_ = 0;
};

std::vector<std::byte> block_bytes(const BlockLayout& layout) {
  std::vector<std::byte> bytes;
  for (const auto axis : {&BlockIndex::x, &BlockIndex::y, &BlockIndex::z}) {
    std::uint32_t previous = 0;
    for (std::uint32_t rank = 0; rank < layout.block_count(); ++rank) {
      const auto value = static_cast<std::uint32_t>(layout.block(layout.slot_at(rank)).*axis);
      append_number(bytes, value - previous);
      previous = value;
    }
  }
  return bytes;
}

std::vector<std::byte> vertex_bytes(const SparseGraph& graph) {
  std::vector<std::byte> bytes;
  append_plane(bytes, graph.vertices, [](const Vertex& v) { return v.voxel.x; });
  append_plane(bytes, graph.vertices, [](const Vertex& v) { return v.voxel.y; });
  append_plane(bytes, graph.vertices, [](const Vertex& v) { return v.voxel.z; });
  append_plane(bytes, graph.vertices, &Vertex::clearance);
  return bytes;
}

std::vector<std::byte> edge_bytes(const SparseGraph& graph) {
  std::vector<std::byte> bytes;
  append_plane(bytes, graph.edges,
               [](const Edge& e) { return static_cast<std::uint32_t>(e.from); });
  append_plane(bytes, graph.edges, [](const Edge& e) { return static_cast<std::uint32_t>(e.to); });
  append_plane(bytes, graph.edges, &Edge::length);
  append_plane(bytes, graph.edges, &Edge::clearance);
  return bytes;
}

std::vector<std::byte> tree_bytes(const ClearanceTree& tree) {
  std::vector<std::byte> bytes;
  append_plane(bytes, tree.parent, [](VertexId v) { return static_cast<std::uint32_t>(v); });
  append_plane(bytes, tree.clearance, [](double c) { return c; });
  append_plane(bytes, tree.place, &VoxelIndex::x);
  append_plane(bytes, tree.place, &VoxelIndex::y);
  append_plane(bytes, tree.place, &VoxelIndex::z);
  return bytes;
}

std::vector<std::byte> region_bytes(const TangentGraph& tangents) {
  std::vector<std::byte> bytes;
  for (std::size_t region = 1; region < tangents.first_seen.size(); ++region)
    append_number(bytes, tangents.first_seen[region] - tangents.first_seen[region - 1]);
  return bytes;
}

std::vector<std::byte> seen_bytes(const TangentGraph& tangents) {
  std::vector<std::byte> bytes;
  append_plane(bytes, tangents.seen, [](VertexId v) { return static_cast<std::uint32_t>(v); });
  return bytes;
}

void load_vertices(const RidgeReader& reader, const char* name, const RidgeHeader& header,
                   std::uint32_t count, SparseGraph& graph) {
  Planes vertices(reader, name, kVerticesType, count, kVertexBytes);
  graph.vertices.resize(count);
  for (const auto axis : {&VoxelIndex::x, &VoxelIndex::y, &VoxelIndex::z}) {
    vertices.take<int>([&](std::size_t i, int k) { graph.vertices[i].voxel.*axis = k; });
  }
  vertices.take<double>([&](std::size_t i, double c) { graph.vertices[i].clearance = c; });
  for (Vertex& v : graph.vertices) v.position = centre_of(v.voxel, header.voxel_size);
}

void load_edges(const RidgeReader& reader, const char* name, std::uint32_t count,
                SparseGraph& graph) {
  Planes edges(reader, name, kEdgesType, count, kEdgeBytes);
  graph.edges.resize(count);
  edges.take<std::uint32_t>(
      [&](std::size_t i, std::uint32_t v) { graph.edges[i].from = VertexId{v}; });
  edges.take<std::uint32_t>(
      [&](std::size_t i, std::uint32_t v) { graph.edges[i].to = VertexId{v}; });
  edges.take<double>([&](std::size_t i, double d) { graph.edges[i].length = d; });
  edges.take<double>([&](std::size_t i, double c) { graph.edges[i].clearance = c; });
}

/// None where the file counts no corners.
void load_tangents(const RidgeReader& reader, const RidgeHeader& header, const BlockLayout& layout,
                   TangentGraph& tangents) {
  if (header.corners == 0) return;
  tangents.graph.min_clearance = header.min_clearance;
  load_vertices(reader, "corners", header, header.corners, tangents.graph);
  load_edges(reader, "taut_edges", header.tangent_edges, tangents.graph);
  BlockRegions regions = number_regions(layout);
  tangents.region_of_block = std::move(regions.region_of_block);
  tangents.first_seen.push_back(0);
  std::uint64_t seen = 0;
  Planes counts(reader, "cells", kNumbersType, regions.count, kNumberBytes);
  counts.take<std::uint32_t>([&](std::size_t, std::uint32_t count) {
    if (count > std::min<std::size_t>(TangentGraph::kMostSeen, header.corners))
      reader.damaged("cells", "counts more corners than are listed");
    seen += count;
    tangents.first_seen.push_back(static_cast<std::uint32_t>(seen));
  });
  Planes corners(reader, "seen", kNumbersType, seen, kNumberBytes);
  tangents.seen.resize(seen);
  corners.take<std::uint32_t>(
      [&](std::size_t i, std::uint32_t v) { tangents.seen[i] = VertexId{v}; });
}

}  // namespace

RidgeSectionSource blocks_section(const BlockLayout& layout) {
  return plain_section("blocks", kBlocksType, block_bytes(layout));
}

std::vector<RidgeSectionSource> list_sections(const Roadmap& roadmap) {
  return {blocks_section(roadmap.esdf.layout),
          plain_section("vertices", kVerticesType, vertex_bytes(roadmap.graph)),
          plain_section("edges", kEdgesType, edge_bytes(roadmap.graph)),
          plain_section("tree", kTreeType, tree_bytes(roadmap.tree)),
          plain_section("corners", kVerticesType, vertex_bytes(roadmap.tangents.graph)),
          plain_section("taut_edges", kEdgesType, edge_bytes(roadmap.tangents.graph)),
          plain_section("cells", kNumbersType, region_bytes(roadmap.tangents)),
          plain_section("seen", kNumbersType, seen_bytes(roadmap.tangents))};
}

BlockLayout load_blocks(const RidgeReader& reader, std::uint32_t count) {
  Planes planes(reader, "blocks", kBlocksType, count, kBlockBytes);
  std::vector<BlockIndex> blocks(count);
  for (const auto axis : {&BlockIndex::x, &BlockIndex::y, &BlockIndex::z}) {
    std::uint32_t value = 0;
    planes.take<std::uint32_t>([&](std::size_t i, std::uint32_t difference) {
      value += difference;
      blocks[i].*axis = static_cast<int>(value);
    });
  }
  constexpr int kFarthest = BlockLayout::kFarthestBlock;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (const int part : {blocks[i].x, blocks[i].y, blocks[i].z}) {
      if (part < -kFarthest || part > kFarthest) reader.damaged("blocks", "has one out of range");
    }
    if (i > 0 && !(blocks[i - 1] < blocks[i])) reader.damaged("blocks", "is not in order");
  }
  return BlockLayout(std::move(blocks));
}

void load_graph(const RidgeReader& reader, const RidgeHeader& header, Roadmap& roadmap) {
  load_vertices(reader, "vertices", header, header.vertices, roadmap.graph);
  load_edges(reader, "edges", header.edges, roadmap.graph);
  load_tangents(reader, header, roadmap.esdf.layout, roadmap.tangents);

  ClearanceTree& tree = roadmap.tree;
  Planes nodes(reader, "tree", kTreeType, header.vertices, kTreeBytes);
  tree.parent.resize(header.vertices);
  tree.clearance.resize(header.vertices);
  tree.place.resize(header.vertices);
  nodes.take<std::uint32_t>([&](std::size_t i, std::uint32_t v) { tree.parent[i] = VertexId{v}; });
  nodes.take<double>([&](std::size_t i, double c) { tree.clearance[i] = c; });
  for (const auto axis : {&VoxelIndex::x, &VoxelIndex::y, &VoxelIndex::z}) {
    nodes.take<int>([&](std::size_t i, int k) { tree.place[i].*axis = k; });
  }
}

}  // namespace ridgeway
