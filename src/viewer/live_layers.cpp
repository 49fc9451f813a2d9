// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_layers.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>

#include "layer_bytes.hpp"
#include "merge_faces.hpp"
#include "ridgeway/live/graph_delta.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kLayers = kBlockSide;
/// A bit for each voxel of a block, by layers: x + 8 y.
using BlockBits = std::array<std::uint64_t, kLayers>;
constexpr std::uint64_t kLowX = 0x0101010101010101ull, kLowY = 0xffull;
constexpr std::array<VoxelIndex, 6> kSides = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

BlockBits bits_of(const EsdfMap& esdf, std::uint32_t slot, VoxelState state) {
  BlockBits bits{};
  if (slot == BlockLayout::kNoBlock) return bits;
  const VoxelState* states = esdf.state.block(slot);
  for (std::size_t z = 0; z < kLayers; ++z)
    for (std::size_t i = 0; i < 64; ++i) bits[z] |= std::uint64_t{states[64 * z + i] == state} << i;
  return bits;
}

/// For each voxel whether the one beside it is open; `beyond`: of the block on that side.
BlockBits beside(const BlockBits& open, const BlockBits& beyond, int side) {
  BlockBits bits{};
  for (std::size_t z = 0; z < kLayers; ++z) {
    const std::uint64_t in = open[z], out = beyond[z];
    switch (side) {
      case 0:
        bits[z] = (in << 1 & ~kLowX) | (out >> 7 & kLowX);
        break;
      case 1:
        bits[z] = (in >> 1 & ~(kLowX << 7)) | (out << 7 & kLowX << 7);
        break;
      case 2:
        bits[z] = in << 8 | out >> 56;
        break;
      case 3:
        bits[z] = in >> 8 | out << 56;
        break;
      case 4:
        bits[z] = z > 0 ? open[z - 1] : beyond[kLayers - 1];
        break;
      default:
        bits[z] = z + 1 < kLayers ? open[z + 1] : beyond[0];
    }
  }
  return bits;
}

/// Faces across an axis, of the voxels with one coordinate along it: rows along the later of the
/// other axes, bits along the earlier.
detail::FacePlane<kLayers> plane_of(const BlockBits& faces, int axis, std::size_t at) {
  detail::FacePlane<kLayers> plane{};
  for (std::size_t row = 0; row < kLayers; ++row)
    if (axis == 2)
      plane[row] = static_cast<std::uint32_t>(faces[at] >> 8 * row & kLowY);
    else if (axis == 1)
      plane[row] = static_cast<std::uint32_t>(faces[row] >> 8 * at & kLowY);
    else
      for (std::size_t y = 0; y < kLayers; ++y)
        plane[row] |= static_cast<std::uint32_t>(faces[row] >> (8 * y + at) & 1) << y;
  return plane;
}

std::uint32_t packed(const std::array<int, 3>& voxel, int side, int width, int height) {
  int bits = voxel[0] | voxel[1] << 3 | voxel[2] << 6 | side << 9;
  bits |= (width - 1) << 12 | (height - 1) << 15;
  return static_cast<std::uint32_t>(bits);
}

bool is_same(const EsdfMap& before, std::uint32_t old_slot, const EsdfMap& now,
             std::uint32_t slot) {
  const VoxelState *a = before.state.block(old_slot), *b = now.state.block(slot);
  return a == b || std::memcmp(a, b, kBlockVoxels * sizeof(VoxelState)) == 0;
}

/// The blocks with another state, and those that share a face with one: whose surface may be
/// another.
std::vector<BlockIndex> doubtful_blocks(const EsdfMap& before, const EsdfMap& now) {
  std::vector<BlockIndex> blocks;
  const auto add = [&](const BlockIndex& block) {
    blocks.push_back(block);
    for (const VoxelIndex& o : kSides)
      blocks.push_back({block.x + o.x, block.y + o.y, block.z + o.z});
  };
  for (std::uint32_t slot = 0; slot < now.layout.block_count(); ++slot) {
    const BlockIndex& block = now.layout.block(slot);
    const std::uint32_t old_slot = before.layout.find_block(block);
    if (old_slot == BlockLayout::kNoBlock || !is_same(before, old_slot, now, slot)) add(block);
  }
  for (const BlockIndex& block : before.layout.blocks())
    if (now.layout.find_block(block) == BlockLayout::kNoBlock) add(block);
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

void append_index(std::string& bytes, const VoxelIndex& index) {
  for (const int part : {index.x, index.y, index.z})
    detail::append(bytes, static_cast<std::int32_t>(part));
}

/// Both lists, each with the clearance that it has now.
template <typename Name, typename AppendName>
void append_names(std::string& bytes, const std::vector<Name>& gone, std::vector<Name> came,
                  const std::vector<Name>& changed, const std::map<Name, double>& clearance,
                  const AppendName& append_name) {
  came.insert(came.end(), changed.begin(), changed.end());
  detail::append(bytes, detail::count_of(gone.size()));
  detail::append(bytes, detail::count_of(came.size()));
  for (const Name& name : gone) append_name(name);
  for (const Name& name : came) append_name(name);
  for (const Name& name : came) detail::append(bytes, static_cast<float>(clearance.at(name)));
}

}  // namespace

Roadmap nothing_like(const Roadmap& roadmap) {
  Roadmap nothing;
  nothing.esdf.voxel_size = roadmap.esdf.voxel_size;
  nothing.esdf.origin = roadmap.esdf.origin;
  nothing.esdf.unknown = roadmap.esdf.unknown;
  return nothing;
}

std::vector<std::uint32_t> block_surface(const EsdfMap& esdf, std::uint32_t slot) {
  std::vector<std::uint32_t> quads;
  const BlockBits solid = bits_of(esdf, slot, VoxelState::kOccupied);
  if (solid == BlockBits{}) return quads;
  const BlockBits open = bits_of(esdf, slot, VoxelState::kFree);
  const BlockIndex& block = esdf.layout.block(slot);
  for (int side = 0; side < 6; ++side) {
    const VoxelIndex& o = kSides[static_cast<std::size_t>(side)];
    const std::uint32_t next =
        esdf.layout.find_block({block.x + o.x, block.y + o.y, block.z + o.z});
    BlockBits faces = beside(open, bits_of(esdf, next, VoxelState::kFree), side);
    for (std::size_t z = 0; z < kLayers; ++z) faces[z] &= solid[z];
    const int axis = side / 2;
    for (std::size_t at = 0; at < kLayers; ++at) {
      detail::FacePlane<kLayers> plane = plane_of(faces, axis, at);
      detail::merge_faces(plane, [&](int bit, int row, int width, int height) {
        std::array<int, 3> voxel{};
        voxel[static_cast<std::size_t>(axis)] = static_cast<int>(at);
        voxel[axis == 0 ? 1 : 0] = bit;
        voxel[axis == 2 ? 1 : 2] = row;
        quads.push_back(packed(voxel, side, width, height));
      });
    }
  }
  return quads;
}

std::string surface_delta_layer(const EsdfMap& before, const EsdfMap& now) {
  std::string bytes, blocks;
  std::size_t count = 0;
  const auto surface_in = [](const EsdfMap& esdf, const BlockIndex& block) {
    const std::uint32_t slot = esdf.layout.find_block(block);
    return slot == BlockLayout::kNoBlock ? std::vector<std::uint32_t>{} : block_surface(esdf, slot);
  };
  for (const BlockIndex& block : doubtful_blocks(before, now)) {
    const std::vector<std::uint32_t> quads = surface_in(now, block);
    if (quads == surface_in(before, block)) continue;
    ++count;
    append_index(blocks, {block.x, block.y, block.z});
    detail::append(blocks, detail::count_of(quads.size()));
    for (const std::uint32_t quad : quads) detail::append(blocks, quad);
  }
  detail::append_origin(bytes, detail::map_origin(now));
  detail::append(bytes, now.voxel_size);
  detail::append(bytes, detail::count_of(count));
  return bytes + blocks;
}

std::string graph_delta_layer(const Roadmap& before, const Roadmap& now) {
  const GraphDelta delta = delta_between(before, now);
  const SparseGraph& graph = now.graph;
  const auto name = [&](VertexId id) { return now.esdf.origin + graph.vertices[number(id)].voxel; };
  std::map<VoxelIndex, double> vertices;
  for (const Vertex& v : graph.vertices) vertices[now.esdf.origin + v.voxel] = v.clearance;
  std::map<EdgeName, double> edges;
  for (const Edge& e : graph.edges) {
    const VoxelIndex a = name(e.from), b = name(e.to);
    edges[{std::min(a, b), std::max(a, b)}] = e.clearance;
  }
  std::string bytes;
  detail::append(bytes, now.esdf.voxel_size);
  append_names(bytes, delta.gone_vertices, delta.came_vertices, delta.changed_vertices, vertices,
               [&](const VoxelIndex& vertex) { append_index(bytes, vertex); });
  append_names(bytes, delta.gone_edges, delta.came_edges, delta.changed_edges, edges,
               [&](const EdgeName& edge) {
                 append_index(bytes, edge.from);
                 append_index(bytes, edge.to);
               });
  return bytes;
}

}  // namespace ridgeway
