// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What is sent of a change, on top of what was sent before, is the map.
#include "viewer/live_layers.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "ridgeway/live/live_roadmap.hpp"
#include "support/random_changes.hpp"

namespace ridgeway {
namespace {

class Bytes {
 public:
  explicit Bytes(const std::string& bytes) : bytes_(bytes) {}
  template <typename Number>
  Number take() {
    Number value{};
    EXPECT_LE(at_ + sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  VoxelIndex index() {
    const int x = take<std::int32_t>(), y = take<std::int32_t>(), z = take<std::int32_t>();
    return {x, y, z};
  }
  bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// A voxel of the map's own, and the side of it.
using SolidFace = std::tuple<int, int, int, int>;

/// As a page has it.
struct SentMap {
  std::map<VoxelIndex, std::vector<std::uint32_t>> blocks;
  std::map<VoxelIndex, float> vertices;
  std::map<std::pair<VoxelIndex, VoxelIndex>, float> edges;

  std::size_t apply_surface(const std::string& bytes) {
    Bytes in(bytes);
    for (int i = 0; i < 4; ++i) in.take<double>();  // origin, size of a voxel
    const auto count = in.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
      const VoxelIndex block = in.index();
      std::vector<std::uint32_t> quads(in.take<std::uint32_t>());
      for (std::uint32_t& quad : quads) quad = in.take<std::uint32_t>();
      EXPECT_TRUE(!quads.empty() || blocks.contains(block)) << "nothing became nothing";
      if (quads.empty())
        blocks.erase(block);
      else
        blocks[block] = std::move(quads);
    }
    EXPECT_TRUE(in.is_at_end());
    return count;
  }

  void apply_graph(const std::string& bytes) {
    Bytes in(bytes);
    in.take<double>();
    apply_part(in, vertices, [&] { return in.index(); });
    apply_part(in, edges, [&] {
      const VoxelIndex from = in.index();
      return std::pair{from, in.index()};
    });
    EXPECT_TRUE(in.is_at_end());
  }

  std::set<SolidFace> faces() const {
    std::set<SolidFace> faces;
    for (const auto& [block, quads] : blocks)
      for (const std::uint32_t quad : quads) {
        const auto part = [quad](int shift) { return static_cast<int>(quad >> shift & 7); };
        const int side = part(9), axis = side / 2;
        for (int across = 0; across <= part(15); ++across)
          for (int along = 0; along <= part(12); ++along) {
            const int x = part(0) + (axis == 0 ? 0 : along);
            const int y = part(3) + (axis == 0 ? along : axis == 1 ? 0 : across);
            const int z = part(6) + (axis == 2 ? 0 : across);
            EXPECT_LT(std::max({x, y, z}), kBlockSide) << "a rectangle leaves its block";
            EXPECT_TRUE(
                faces.insert({8 * block.x + x, 8 * block.y + y, 8 * block.z + z, side}).second)
                << "a face is in two rectangles";
          }
      }
    return faces;
  }

 private:
  template <typename Name, typename TakeName>
  static void apply_part(Bytes& in, std::map<Name, float>& part, const TakeName& take_name) {
    const auto gone = in.take<std::uint32_t>(), came = in.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < gone; ++i)
      EXPECT_EQ(part.erase(take_name()), 1u) << "what went was not there";
    std::vector<Name> names;
    for (std::uint32_t i = 0; i < came; ++i) names.push_back(take_name());
    for (const Name& name : names) part[name] = in.take<float>();
  }
};

std::set<SolidFace> faces_between(const EsdfMap& esdf) {
  std::set<SolidFace> faces;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (esdf.state[id] != VoxelState::kOccupied) continue;
    const VoxelIndex v = esdf.layout.index_of(id);
    const VoxelIndex beside[] = {{v.x - 1, v.y, v.z}, {v.x + 1, v.y, v.z}, {v.x, v.y - 1, v.z},
                                 {v.x, v.y + 1, v.z}, {v.x, v.y, v.z - 1}, {v.x, v.y, v.z + 1}};
    for (int side = 0; side < 6; ++side) {
      const VoxelId other = esdf.layout.find(beside[side]);
      if (other != kNoVoxel && esdf.state[other] == VoxelState::kFree)
        faces.insert({v.x, v.y, v.z, side});
    }
  }
  return faces;
}

void expect_graph(const SentMap& sent, const Roadmap& now) {
  const SparseGraph& graph = now.graph;
  const auto name = [&](VertexId id) { return now.esdf.origin + graph.vertices[number(id)].voxel; };
  ASSERT_EQ(sent.vertices.size(), graph.vertices.size());
  for (const Vertex& v : graph.vertices)
    EXPECT_EQ(sent.vertices.at(now.esdf.origin + v.voxel), static_cast<float>(v.clearance));
  ASSERT_EQ(sent.edges.size(), graph.edges.size());
  for (const Edge& e : graph.edges)
    EXPECT_EQ(sent.edges.at(std::minmax(name(e.from), name(e.to))),
              static_cast<float>(e.clearance));
}

TEST(LiveLayers, WhatIsSentOfEachChangeAddsUpToTheMap) {
  std::size_t faces = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    LiveRoadmap live({.build = {.min_clearance = 0.1, .tangent_pairs = 0}});
    std::shared_ptr<const Roadmap> before;
    SentMap sent;
    for (int step = 0; step < 10; ++step) {
      live.set_voxels(testing::random_changes(random, {-12, -9, -11}, {30, 22, 19}));
      // Some pages are slow: they get what two changes made together.
      const std::shared_ptr<const Roadmap> now = live.snapshot();
      if (!now || random() % 3 == 0) continue;
      const Roadmap nothing = nothing_like(*now);
      const Roadmap& had = before ? *before : nothing;
      sent.apply_surface(surface_delta_layer(had.esdf, now->esdf));
      sent.apply_graph(graph_delta_layer(had, *now));
      EXPECT_EQ(sent.faces(), faces_between(now->esdf));
      expect_graph(sent, *now);
      faces += sent.faces().size();
      before = now;
    }
  }
  EXPECT_GT(faces, 0u);
}

/// A floor of 80 x 80 x 24 voxels with free space above it.
LiveRoadmap hall() {
  LiveRoadmap live({.build = {.min_clearance = 0.2, .tangent_pairs = 0}});
  std::vector<VoxelChange> changes;
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 80; ++x)
        changes.push_back({{x, y, z}, z == 0 ? VoxelState::kOccupied : VoxelState::kFree});
  live.set_voxels(changes);
  return live;
}

TEST(LiveLayers, OneVoxelSendsTheBlocksBesideItAlone) {
  LiveRoadmap live = hall();
  const auto before = live.snapshot();
  SentMap sent;
  EXPECT_EQ(sent.apply_surface(surface_delta_layer(nothing_like(*before).esdf, before->esdf)),
            100u);
  const std::size_t all = surface_delta_layer(nothing_like(*before).esdf, before->esdf).size();
  const std::string same = surface_delta_layer(before->esdf, before->esdf);
  EXPECT_EQ(sent.apply_surface(same), 0u);
  live.set_voxels(std::vector<VoxelChange>{{{20, 20, 12}, VoxelState::kOccupied}});
  const std::string inside = surface_delta_layer(before->esdf, live.snapshot()->esdf);
  EXPECT_EQ(sent.apply_surface(inside), 1u);
  EXPECT_LT(10 * inside.size(), all);
  // On the border of a block, just above the floor of the one below: none of its faces is hidden.
  const auto then = live.snapshot();
  live.set_voxels(std::vector<VoxelChange>{{{40, 40, 1}, VoxelState::kOccupied}});
  EXPECT_EQ(sent.apply_surface(surface_delta_layer(then->esdf, live.snapshot()->esdf)), 1u);
  EXPECT_EQ(sent.faces(), faces_between(live.snapshot()->esdf));
}

TEST(LiveLayers, BlocksThatVanishAreTakenAway) {
  LiveRoadmap live = hall();
  const auto before = live.snapshot();
  std::vector<VoxelChange> changes;
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) changes.push_back({{x, y, z}, VoxelState::kUnknown});
  live.set_voxels(changes);
  const auto now = live.snapshot();
  ASSERT_LT(now->esdf.layout.block_count(), before->esdf.layout.block_count());
  SentMap sent;
  sent.apply_surface(surface_delta_layer(nothing_like(*before).esdf, before->esdf));
  sent.apply_surface(surface_delta_layer(before->esdf, now->esdf));
  EXPECT_EQ(sent.faces(), faces_between(now->esdf));
}

}  // namespace
}  // namespace ridgeway
