// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <utility>

#include "files/atomic_file.hpp"
#include "ridgeway/formats/graph_export.hpp"
#include "voxblox.hpp"
#include "voxblox_graph.hpp"

namespace ridgeway {
namespace {

constexpr int kVoxbloxSide = 16;             // of a block, voxels, as the original has it
constexpr std::uint32_t kGrey = 0x7f7f7fff;  // red, green, blue, alpha
constexpr double kSeenWeight = 2.0 * kLeastWeight;
constexpr std::uint32_t kObservedFlag = 1;  // flag of a voxel of an ESDF
constexpr std::uint32_t kEdgeFlag = 1u << 16,
                        kVertexFlag = 1u << 24;  // flags of a voxel of a skeleton
constexpr std::uint32_t kNoVertexId = 0xffffffffu;

std::uint32_t word_of_float(double value) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

int block_along(int voxel) { return voxel >> 4; }

/// A layer of a type whose blocks appear as their voxels are written, with `initial` in the others.
template <std::size_t kWords>
class LayerWriter {
 public:
  using Words = std::array<std::uint32_t, kWords>;

  LayerWriter(std::string type, double voxel_size, const Words& initial)
      : type_(std::move(type)), voxel_size_(voxel_size), initial_(initial) {}

  /// A voxel of the lattice.
  void set(const VoxelIndex& voxel, const Words& words) {
    const VoxelIndex index = {block_along(voxel.x), block_along(voxel.y), block_along(voxel.z)};
    VoxbloxBlock& block = blocks_[index];
    if (block.words.empty()) {
      block.index = index;
      for (int i = 0; i < kVoxbloxSide * kVoxbloxSide * kVoxbloxSide; ++i)
        block.words.insert(block.words.end(), initial_.begin(), initial_.end());
    }
    const int at = (voxel.x & 15) + kVoxbloxSide * ((voxel.y & 15) + kVoxbloxSide * (voxel.z & 15));
    std::copy(words.begin(), words.end(),
              block.words.begin() + static_cast<std::ptrdiff_t>(at) * static_cast<int>(kWords));
  }

  VoxbloxLayer finish() && {
    VoxbloxLayer layer{
        .type = type_, .voxel_size = voxel_size_, .side = kVoxbloxSide, .blocks = {}};
    for (auto& [index, block] : blocks_) layer.blocks.push_back(std::move(block));
    return layer;
  }

 private:
  std::string type_;
  double voxel_size_;
  Words initial_;
  std::map<VoxelIndex, VoxbloxBlock> blocks_;
};

VoxbloxLayer tsdf_layer(const TsdfMap& map) {
  LayerWriter<3> layer("tsdf", map.voxel_size, {0, 0, kGrey});
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.weight[id] > 0.0f)
      layer.set(map.origin + map.layout.index_of(id),
                {word_of_float(static_cast<double>(map.distance[id])),
                 word_of_float(std::max(static_cast<double>(map.weight[id]), kSeenWeight)), kGrey});
  return std::move(layer).finish();
}

/// An offset as three signed bytes, each cut to its own; none where it does not fit.
std::uint32_t parent_word(const SiteOffset& site) {
  const auto fits = [](int k) { return k >= -128 && k <= 127; };
  if (!fits(site.x) || !fits(site.y) || !fits(site.z)) return 0;
  const auto byte = [](int k) { return static_cast<std::uint32_t>(k) & 0xffu; };
  return byte(site.x) << 24 | byte(site.y) << 16 | byte(site.z) << 8;
}

/// A voxel that is an obstacle lies half a voxel or more behind its surface.
double signed_distance(const EsdfMap& esdf, VoxelId id) {
  if (esdf.state[id] == VoxelState::kOccupied) return -0.5 * esdf.voxel_size;
  const double farthest = std::min(esdf.max_distance, kFarthestSite * esdf.voxel_size);
  return std::min(esdf.distance(id), farthest);
}

VoxbloxLayer esdf_layer(const EsdfMap& esdf) {
  LayerWriter<2> layer("esdf", esdf.voxel_size, {0, 0});
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (esdf.state[id] == VoxelState::kUnknown ||
        !is_of_map(esdf, static_cast<int>(id % kBlockVoxels)))
      continue;
    const std::uint32_t parent = esdf.squared[id] == kNoSite ? 0 : parent_word(esdf.site[id]);
    layer.set(esdf.origin + esdf.layout.index_of(id),
              {word_of_float(signed_distance(esdf, id)), parent | kObservedFlag});
  }
  return std::move(layer).finish();
}

VoxbloxLayer skeleton_layer(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  LayerWriter<3> layer("skeleton", esdf.voxel_size, {0, 0, kNoVertexId});
  for (const VoxelId id : roadmap.diagram.voxels.members(esdf.layout))
    layer.set(esdf.origin + esdf.layout.index_of(id),
              {word_of_float(esdf.distance(id)), kEdgeFlag, kNoVertexId});
  for (std::uint32_t i = 0; i < roadmap.graph.vertices.size(); ++i) {
    const Vertex& vertex = roadmap.graph.vertices[i];
    layer.set(esdf.origin + vertex.voxel,
              {word_of_float(vertex.clearance), kEdgeFlag | kVertexFlag, i});
  }
  return std::move(layer).finish();
}

}  // namespace

void write_voxblox(const TsdfMap& map, const std::filesystem::path& path) {
  write_text_file(path, voxblox_bytes({tsdf_layer(map)}));
}

void write_voxblox(const Roadmap& roadmap, const std::filesystem::path& path) {
  write_text_file(path, voxblox_bytes({esdf_layer(roadmap.esdf), skeleton_layer(roadmap)}));
}

void write_graph_voxblox(const Roadmap& roadmap, const std::filesystem::path& path) {
  const SparseGraph& graph = roadmap.graph;
  const GraphComponents parts = connected_components(graph);
  VoxbloxGraph all;
  for (std::uint32_t i = 0; i < graph.vertices.size(); ++i) {
    VoxbloxGraph::Vertex vertex;
    vertex.id = i;
    vertex.place = to_world(roadmap.esdf, graph.vertices[i].position);
    for (const Link& link : graph.links_of(VertexId{i}))
      vertex.edges.push_back(static_cast<std::int64_t>(number(link.edge)));
    vertex.subgraph = parts.label[i];
    all.vertices.push_back(std::move(vertex));
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const Edge& edge = graph.edges[i];
    const std::size_t from = number(edge.from), to = number(edge.to);
    all.edges.push_back({static_cast<std::int64_t>(i), static_cast<std::int64_t>(from),
                         static_cast<std::int64_t>(to), all.vertices[from].place,
                         all.vertices[to].place, static_cast<float>(graph.vertices[from].clearance),
                         static_cast<float>(graph.vertices[to].clearance)});
  }
  write_text_file(path, voxblox_graph_bytes(all));
}

}  // namespace ridgeway
