// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/voxblox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <numbers>

#include "common/random.hpp"
#include "formats/protobuf.hpp"
#include "formats/voxblox_graph.hpp"
#include "mapping/random_map.hpp"
#include "ridgeway/formats/graph_export.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

VoxbloxLayer random_layer(const std::string& type, std::uint64_t seed) {
  Random random(seed, 1);
  VoxbloxLayer layer{.type = type, .voxel_size = 0.2, .side = 4, .blocks = {}};
  for (int b = 0; b < 3; ++b) {
    VoxbloxBlock block;
    block.index = {b - 1, -b, 2 * b};
    block.has_data = b == 1;
    if (b < 2)
      for (int i = 0; i < 64 * words_per_voxel(type); ++i)
        block.words.push_back(static_cast<std::uint32_t>(random.below(1ull << 32)));
    layer.blocks.push_back(block);
  }
  return layer;
}

TEST(Voxblox, LayersComeBackAsTheyWere) {
  std::vector<VoxbloxLayer> layers;
  for (const char* type : {"tsdf", "esdf", "occupancy", "intensity", "skeleton"})
    layers.push_back(random_layer(type, layers.size()));
  const std::string bytes = voxblox_bytes(layers);
  EXPECT_TRUE(is_voxblox(bytes));
  EXPECT_FALSE(is_voxblox_graph(bytes));
  const auto read = read_voxblox(bytes, "a");
  ASSERT_EQ(read.size(), layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(read[i].type, layers[i].type);
    EXPECT_EQ(read[i].voxel_size, 0.2);  // though the file has a widened float
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_EQ(read[i].blocks[b].index, layers[i].blocks[b].index);
      EXPECT_EQ(read[i].blocks[b].words, layers[i].blocks[b].words);
    }
  }
  EXPECT_EQ(voxblox_bytes(read), bytes);
}

TEST(Voxblox, AFileThatIsCutOffOrWrongIsRefusedWithItsPlace) {
  const std::string bytes = voxblox_bytes({random_layer("tsdf", 1), random_layer("esdf", 2)});
  const std::size_t first = voxblox_bytes({random_layer("tsdf", 1)}).size();
  for (std::size_t length = 1; length < bytes.size(); length += 7) {
    if (length == first) continue;
    const std::string text = refusal([&] { read_voxblox(bytes.substr(0, length), "cut.vxblx"); });
    EXPECT_NE(text.find("cut.vxblx"), std::string::npos) << length;
    EXPECT_NE(text.find("byte"), std::string::npos) << text;
  }
  VoxbloxLayer odd = random_layer("tsdf", 3);
  odd.blocks[1].words.pop_back();
  const std::string text = refusal([&] { read_voxblox(voxblox_bytes({odd}), "odd"); });
  EXPECT_NE(text.find("odd, layer 1, block 2"), std::string::npos) << text;
  EXPECT_NE(text.find("191 words where 192"), std::string::npos) << text;
  odd = random_layer("tsdf", 3);
  odd.voxel_size = 0.0;
  EXPECT_NE(refusal([&] { read_voxblox(voxblox_bytes({odd}), "odd"); }), "");
}

TEST(Voxblox, PackedWordsAreTakenToo) {
  ProtobufWriter head, packed, block, file;
  head.real(1, 0.5);
  head.whole(2, 1);
  head.text(3, "esdf");
  packed.varint(std::bit_cast<std::uint32_t>(1.5f));
  packed.varint(1);
  block.whole(1, 1);
  block.text(7, packed.bytes());
  file.varint(2);
  file.message(head.bytes());
  file.message(block.bytes());
  const auto layers = read_voxblox(file.bytes(), "packed");
  const OccupancyMap map = map_of_layer(map_layer(layers, "packed"), "packed");
  EXPECT_EQ(count_voxels(map).free, 1u);
}

/// Of sheets thinner than a voxel, some of them with a voxel's centre behind their surface.
TsdfMap thin_sheets(std::uint64_t seed) {
  Random random(seed, 2);
  TsdfMap tsdf;
  tsdf.voxel_size = 0.1;
  tsdf.origin = {-21, 3, 40};
  tsdf.truncation = 0.4;
  tsdf.layout = BlockLayout({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}});
  tsdf.distance = VoxelField<float>(tsdf.layout);
  tsdf.weight = VoxelField<float>(tsdf.layout);
  for (VoxelId id = 0; id < tsdf.layout.voxel_count(); ++id) {
    const int beside = std::abs(tsdf.layout.index_of(id).x % 8 - 4);
    tsdf.distance[id] =
        static_cast<float>(std::min(0.4, random.uniform(-0.001, 0.1) + 0.1 * beside));
    // Fused once from far away, voxels have hardly any weight.
    const double kind = random.uniform(0.0, 1.0);
    tsdf.weight[id] = kind < 0.9 ? 1.0f : kind < 0.98 ? 1e-7f : 0.0f;
  }
  return tsdf;
}

TEST(Voxblox, WhatIsThinnerThanAVoxelIsOccupiedAsInTheFusedMap) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const TsdfMap tsdf = thin_sheets(seed);
    save_tsdf(tsdf, "sheets", folder / "fused.ridge");
    write_voxblox(tsdf, folder / "fused.vxblx");
    LoadConfig turned;
    turned.transform = Eigen::Translation3d(0.3, -0.2, 0.1) *
                       Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ());
    LoadConfig cropped;
    cropped.bounds = Box{{-1.8, 0.4, 4.1}, {-0.7, 1.1, 5.3}};
    for (const LoadConfig& config : {LoadConfig{}, turned, cropped})
      EXPECT_TRUE(testing::same_voxels(load_map(folder / "fused.vxblx", config),
                                       load_map(folder / "fused.ridge", config)));
    const OccupancyMap map = occupancy_of(tsdf);
    std::size_t behind = 0;
    for (VoxelId id = 0; id < tsdf.layout.voxel_count(); ++id)
      behind += tsdf.weight[id] > 0.0f && tsdf.distance[id] <= 0.0f;
    EXPECT_GT(count_voxels(map).occupied, behind + 20);
  }
}

TEST(Voxblox, APlanarRoadmapHasOneLayerOfVoxels) {
  const TemporaryFolder folder;
  OccupancyBuilder hall(0.1);
  hall.fill({{0, 0, 0}, {40, 30, 12}}, VoxelState::kFree);
  const OccupancyMap flat = flatten(std::move(hall).finish(), 0.2, 0.9);
  const Roadmap roadmap = build_roadmap(flat, {.min_clearance = 0.3}).roadmap;
  write_voxblox(roadmap, folder / "flat.vxblx");
  const auto bounds = known_bounds(flat), back = known_bounds(load_map(folder / "flat.vxblx", {}));
  ASSERT_TRUE(bounds && back);
  EXPECT_TRUE(back->min.isApprox(bounds->min, 1e-12));
  EXPECT_TRUE(back->max.isApprox(bounds->max, 1e-12));
}

TEST(Voxblox, ARoadmapIsWrittenAndItsFieldGivesTheSameMap) {
  const TemporaryFolder folder;
  const OccupancyMap map = testing::clumped_map(5);
  BuildConfig config;
  config.min_clearance = 2.0 * map.voxel_size;
  const Roadmap roadmap = build_roadmap(map, config).roadmap;
  write_voxblox(roadmap, folder / "map.vxblx");
  write_graph(roadmap, folder / "graph.pb");

  LoadNotes notes;
  const OccupancyMap back = load_map(folder / "map.vxblx", {}, &notes);
  EXPECT_EQ(count_voxels(back).free, count_voxels(map).free);
  EXPECT_EQ(count_voxels(back).occupied, count_voxels(map).occupied);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const VoxelIndex voxel = map.origin + map.layout.index_of(id) - back.origin;
    ASSERT_EQ(back.at(voxel), map.state[id]);
  }

  const auto layers = read_voxblox(read_whole(folder / "map.vxblx"), "map");
  ASSERT_EQ(layers.size(), 2u);
  // Parents, each byte cut to its own, lead to the site of the field.
  std::size_t parents = 0, skeleton = 0;
  for (const VoxbloxBlock& block : layers[0].blocks)
    for (std::size_t i = 0; i < block.words.size(); i += 2) {
      const std::uint32_t word = block.words[i + 1];
      if ((word & 1) == 0) continue;
      const int at = static_cast<int>(i / 2);
      const VoxelIndex voxel = {16 * block.index.x + at % 16, 16 * block.index.y + at / 16 % 16,
                                16 * block.index.z + at / 256};
      const VoxelId id = roadmap.esdf.layout.find(voxel - roadmap.esdf.origin);
      ASSERT_NE(id, kNoVoxel);
      const auto byte = [&](int shift) { return static_cast<std::int8_t>(word >> shift & 0xff); };
      const SiteOffset parent = {byte(24), byte(16), byte(8)};
      if (roadmap.esdf.squared[id] != kNoSite) ASSERT_EQ(parent, roadmap.esdf.site[id]);
      ++parents;
      const auto distance = std::bit_cast<float>(block.words[i]);
      if (roadmap.esdf.state[id] == VoxelState::kFree)
        ASSERT_EQ(distance, static_cast<float>(roadmap.esdf.distance(id)));
      else
        ASSERT_LT(distance, 0.0f);
    }
  EXPECT_EQ(parents, count_voxels(map).known());
  for (const VoxbloxBlock& block : layers[1].blocks)
    for (std::size_t i = 1; i < block.words.size(); i += 3) skeleton += block.words[i] != 0;
  EXPECT_GE(skeleton, roadmap.diagram.voxels.count());

  const std::string bytes = read_whole(folder / "graph.pb");
  EXPECT_TRUE(is_voxblox_graph(bytes));
  const VoxbloxGraph graph = read_voxblox_graph(bytes, "graph");
  EXPECT_EQ(graph.vertices.size(), roadmap.graph.vertices.size());
  EXPECT_EQ(graph.edges.size(), roadmap.graph.edges.size());
  EXPECT_EQ(voxblox_graph_bytes(graph), bytes);
  const VoxbloxGraphFaults faults = find_faults(graph);
  EXPECT_EQ(faults.components, connected_components(roadmap.graph).count);
  EXPECT_EQ(faults.self_loops + faults.doubled_edges + faults.dangling_edges +
                faults.misplaced_ends + faults.unlisted_edges + faults.doubled_ids,
            0u);
}

TEST(Voxblox, FaultsOfAGraphAreCounted) {
  VoxbloxGraph graph;
  for (int i = 0; i < 4; ++i) graph.vertices.push_back({i, Point(i, 0, 0), {}, 0});
  graph.vertices[0].edges = {0, 1, 2};
  graph.vertices[1].edges = {0, 1};
  const auto edge = [&](int id, int from, int to) {
    graph.edges.push_back({id, from, to, Point(from, 0, 0), Point(to, 0, 0), 0.0f, 0.0f});
  };
  edge(0, 0, 1);
  edge(1, 1, 0);                     // doubled
  edge(2, 0, 0);                     // loop
  edge(3, 1, 9);                     // dangling
  edge(3, 1, 2);                     // doubled id, unlisted
  graph.edges.back().end.z() = 0.5;  // misplaced
  const VoxbloxGraphFaults faults =
      find_faults(read_voxblox_graph(voxblox_graph_bytes(graph), "graph"));
  EXPECT_EQ(faults.doubled_edges, 1u);
  EXPECT_EQ(faults.self_loops, 1u);
  EXPECT_EQ(faults.dangling_edges, 1u);
  EXPECT_EQ(faults.doubled_ids, 1u);
  EXPECT_EQ(faults.unlisted_edges, 1u);
  EXPECT_EQ(faults.misplaced_ends, 1u);
  EXPECT_EQ(faults.lone_vertices, 1u);
  EXPECT_EQ(faults.components, 2u);
}

/// In single precision blocks of small voxels far from zero would be one.
TEST(Voxblox, BlocksFarFromZeroStayApart) {
  const TemporaryFolder folder;
  OccupancyMap map = testing::clumped_map(3, 0.02);
  map.origin = {22'500'000, 270'000'000, 0};
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.02}).roadmap;
  write_voxblox(roadmap, folder / "far.vxblx");
  const OccupancyMap again = load_map(folder / "far.vxblx");
  const VoxelCounts before = count_voxels(map), after = count_voxels(again);
  EXPECT_EQ(after.free, before.free);
  EXPECT_EQ(after.occupied, before.occupied);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (map.state[id] == VoxelState::kUnknown) continue;
    const VoxelIndex there = map.origin + map.layout.index_of(id) - again.origin;
    ASSERT_EQ(again.at(there), map.state[id]);
  }
}

}  // namespace
}  // namespace ridgeway
