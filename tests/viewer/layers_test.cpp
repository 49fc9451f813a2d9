// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "viewer/layers.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "ridgeway/common/error.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

template <typename Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number value;
  EXPECT_LE(offset + sizeof value, bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Point origin_of(const std::string& bytes) {
  return {number_at<double>(bytes, 0), number_at<double>(bytes, 8), number_at<double>(bytes, 16)};
}

/// Two rooms and a door, somewhere else in the world.
OccupancyMap rooms() {
  OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {59, 29, 19}, [](const VoxelIndex& v) {
    const bool is_wall = v.x == 30 && (v.y < 10 || v.y > 18);
    const bool is_hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 59 || v.y == 29 || v.z == 19;
    return is_wall || is_hull ? VoxelState::kOccupied : VoxelState::kFree;
  });
  map.origin = {5'000'000, 40'000'000, 300};
  return map;
}

Roadmap rooms_roadmap() { return build_roadmap(rooms(), {.min_clearance = 0.3}).roadmap; }

TEST(Layers, GraphHasTheVerticesInTheWorldAndTheEdges) {
  const Roadmap roadmap = rooms_roadmap();
  const SparseGraph& graph = roadmap.graph;
  const std::string bytes = graph_layer(roadmap);
  const auto vertices = number_at<std::uint32_t>(bytes, 24),
             edges = number_at<std::uint32_t>(bytes, 28);
  ASSERT_EQ(vertices, graph.vertices.size());
  ASSERT_EQ(edges, graph.edges.size());
  ASSERT_EQ(bytes.size(), 32 + 16 * graph.vertices.size() + 12 * graph.edges.size());
  for (std::size_t v = 0; v < vertices; ++v) {
    Point place = origin_of(bytes);
    for (Eigen::Index k = 0; k < 3; ++k)
      place[k] += number_at<float>(bytes, 32 + 12 * v + 4 * static_cast<std::size_t>(k));
    EXPECT_LT((place - to_world(roadmap.esdf, graph.vertices[v].position)).norm(), 1e-5);
    EXPECT_FLOAT_EQ(number_at<float>(bytes, 32 + 12 * vertices + 4 * v),
                    static_cast<float>(graph.vertices[v].clearance));
  }
  const std::size_t pairs = 32 + 16 * vertices;
  for (std::size_t e = 0; e < edges; ++e) {
    EXPECT_EQ(number_at<std::uint32_t>(bytes, pairs + 8 * e), number(graph.edges[e].from));
    EXPECT_EQ(number_at<std::uint32_t>(bytes, pairs + 8 * e + 4), number(graph.edges[e].to));
  }
}

TEST(Layers, DiagramJoinsNeighboursOnce) {
  const Roadmap roadmap = rooms_roadmap();
  const std::vector<VoxelId> voxels = roadmap.diagram.voxels.members(roadmap.esdf.layout);
  const std::string bytes = diagram_layer(roadmap);
  ASSERT_EQ(number_at<std::uint32_t>(bytes, 24), voxels.size());
  const auto pairs = number_at<std::uint32_t>(bytes, 28);
  std::size_t expected = 0;
  for (std::size_t a = 0; a < voxels.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const VoxelIndex o =
          roadmap.esdf.layout.index_of(voxels[a]) - roadmap.esdf.layout.index_of(voxels[b]);
      expected += std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) == 1;
    }
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(pairs, expected);
  EXPECT_EQ(bytes.size(), 32 + 16 * voxels.size() + 8 * pairs);
}

TEST(Layers, SliceHoldsTheDistancesOfItsHeight) {
  const Roadmap roadmap = rooms_roadmap();
  const EsdfMap& esdf = roadmap.esdf;
  const std::string bytes = slice_layer(esdf, 31.05, 4096);
  const Point origin = origin_of(bytes);
  const auto columns = number_at<std::uint32_t>(bytes, 32),
             rows = number_at<std::uint32_t>(bytes, 36);
  ASSERT_EQ(number_at<double>(bytes, 24), 0.1);
  ASSERT_EQ(bytes.size(), 40 + 2 * std::size_t{columns} * rows);
  std::size_t known = 0;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const Point world = origin + 0.1 * Point(column + 0.5, row + 0.5, 0.0);
      const VoxelId id = esdf.layout.find(voxel_at(to_local(esdf, world), 0.1));
      const auto value =
          number_at<std::uint16_t>(bytes, 40 + 2 * (std::size_t{row} * columns + column));
      if (id == kNoVoxel || esdf.state[id] == VoxelState::kUnknown) {
        EXPECT_EQ(value, 65535);
        continue;
      }
      ++known;
      EXPECT_NEAR(value, 1000.0 * esdf.distance(id), 0.5001);
    }
  EXPECT_EQ(known, 60u * 30u);
}

TEST(Layers, SliceOfALargeMapIsThinned) {
  const std::string bytes = slice_layer(rooms_roadmap().esdf, 31.05, 20);
  EXPECT_LE(number_at<std::uint32_t>(bytes, 32), 20u);
  EXPECT_DOUBLE_EQ(number_at<double>(bytes, 24), 0.4);
}

/// Which cells of a section are cut, by column and row.
bool is_cut(const std::string& section, std::uint32_t column, std::uint32_t row) {
  const std::size_t cell = std::size_t{row} * number_at<std::uint32_t>(section, 32) + column;
  return (number_at<std::uint8_t>(section, 40 + cell / 8) >> (cell % 8) & 1) != 0;
}

TEST(Layers, SectionHoldsWhatACutGoesThroughAndNoFaceCloses) {
  const EsdfMap esdf = rooms_roadmap().esdf;
  // Within a layer, between two of them, and on the floor, which has faces of its own but below
  // walls.
  for (const double height : {31.05, 31.0, 30.1}) {
    const std::string bytes = section_layer(esdf, height, 4096);
    const Point origin = origin_of(bytes);
    EXPECT_DOUBLE_EQ(origin.z(), height);
    std::size_t cut = 0;
    for (std::uint32_t row = 0; row < number_at<std::uint32_t>(bytes, 36); ++row)
      for (std::uint32_t column = 0; column < number_at<std::uint32_t>(bytes, 32); ++column) {
        const Point world = origin + 0.1 * Point(column + 0.5, row + 0.5, 0.0);
        const VoxelIndex v = voxel_at(to_local(esdf, world), 0.1);
        const bool is_inside = v.x >= 0 && v.y >= 0 && v.x < 60 && v.y < 30;
        const bool is_hull = v.x == 0 || v.y == 0 || v.x == 59 || v.y == 29;
        const bool is_wall = v.x == 30 && (v.y < 10 || v.y > 18);
        EXPECT_EQ(is_cut(bytes, column, row), is_inside && (is_hull || is_wall))
            << height << " " << v.x << " " << v.y;
        cut += is_cut(bytes, column, row);
      }
    EXPECT_EQ(cut, 2u * 60 + 2 * 28 + 19);
  }
}

TEST(Layers, SectionOfALargeMapLosesNoWall) {
  const std::string bytes = section_layer(rooms_roadmap().esdf, 31.05, 20);
  EXPECT_DOUBLE_EQ(number_at<double>(bytes, 24), 0.4);
  EXPECT_TRUE(is_cut(bytes, 30 / 4, 0));
  EXPECT_TRUE(is_cut(bytes, 30 / 4, 1));
  EXPECT_FALSE(is_cut(bytes, 30 / 4, 13 / 4));
}

TEST(Layers, SectionBesideTheMapIsEmptyAndBadHeightsAreRefused) {
  const EsdfMap esdf = rooms_roadmap().esdf;
  EXPECT_EQ(section_layer(esdf, 500.0, 100).size(), 40u);
  for (const double height : {std::nan(""), 1e300, -1e300})
    EXPECT_THROW(section_layer(esdf, height, 100), InputError);
}

TEST(Layers, SliceBesideTheMapIsEmptyAndBadHeightsAreRefused) {
  const EsdfMap esdf = rooms_roadmap().esdf;
  EXPECT_EQ(number_at<std::uint32_t>(slice_layer(esdf, 500.0, 100), 32), 0u);
  for (const double height : {std::nan(""), 1e300, -1e300})
    EXPECT_THROW(slice_layer(esdf, height, 100), InputError);
}

TEST(Layers, CloudIsThinnedToWhatIsAskedFor) {
  const Roadmap roadmap = rooms_roadmap();
  const std::string all = gvd_layer(roadmap, {}, 1'000'000);
  const auto total = number_at<std::uint32_t>(all, 24);
  EXPECT_EQ(total, number_at<std::uint32_t>(all, 28));
  EXPECT_GT(total, 100u);
  const std::string some = gvd_layer(roadmap, {}, 100);
  EXPECT_LE(number_at<std::uint32_t>(some, 24), 100u);
  EXPECT_EQ(number_at<std::uint32_t>(some, 28), total);
  EXPECT_EQ(some.size(), 32 + 16 * std::size_t{number_at<std::uint32_t>(some, 24)});
}

/// Two rooms with 10 km of nothing between them: what is looked at are blocks, not the box around.
TEST(Layers, SectionsOfWideMapsLookAtTheirBlocksAlone) {
  constexpr int kFar = 100'000;
  std::vector<BlockIndex> blocks;
  for (const int block : {0, kFar / kBlockSide})
    for (int k = 0; k < 8; ++k) blocks.push_back({block + (k & 1), block + (k >> 1 & 1), k >> 2});
  OccupancyMap map;
  map.voxel_size = 0.1;
  map.layout = BlockLayout(blocks);
  map.state = VoxelField<VoxelState>(map.layout);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const VoxelIndex v = map.layout.index_of(id);
    const auto is_wall = [](int k) { return k % kFar == 0 || k % kFar == 15; };
    map.state[id] = is_wall(v.x) || is_wall(v.y) || v.z == 0 || v.z == 15 ? VoxelState::kOccupied
                                                                          : VoxelState::kFree;
  }
  const EsdfMap esdf = compute_esdf(map);
  const std::string section = section_layer(esdf, 0.85, 4096);
  const auto columns = number_at<std::uint32_t>(section, 32);
  EXPECT_GT(columns, 3000u);
  EXPECT_TRUE(is_cut(section, 0, 0));
  EXPECT_TRUE(is_cut(section, columns - 1, number_at<std::uint32_t>(section, 36) - 1));
  EXPECT_FALSE(is_cut(section, columns / 2, 0));
}

}  // namespace
}  // namespace ridgeway
