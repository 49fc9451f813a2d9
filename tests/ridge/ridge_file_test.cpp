// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/ridge/ridge_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"
#include "support/synthetic_roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

void expect_same(const SparseGraph& a, const SparseGraph& b) {
  EXPECT_EQ(a.min_clearance, b.min_clearance);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_EQ(a.vertices[i].voxel, b.vertices[i].voxel);
    EXPECT_EQ(a.vertices[i].position, b.vertices[i].position);
    EXPECT_EQ(a.vertices[i].clearance, b.vertices[i].clearance);
  }
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    EXPECT_EQ(a.edges[i].from, b.edges[i].from);
    EXPECT_EQ(a.edges[i].to, b.edges[i].to);
    EXPECT_EQ(a.edges[i].length, b.edges[i].length);
    EXPECT_EQ(a.edges[i].clearance, b.edges[i].clearance);
  }
  EXPECT_EQ(a.first_link, b.first_link);
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    EXPECT_EQ(a.links[i].vertex, b.links[i].vertex);
    EXPECT_EQ(a.links[i].edge, b.links[i].edge);
  }
}

void expect_same(const Roadmap& a, const Roadmap& b) {
  EXPECT_EQ(a.esdf.voxel_size, b.esdf.voxel_size);
  EXPECT_EQ(a.esdf.origin, b.esdf.origin);
  EXPECT_EQ(a.esdf.unknown, b.esdf.unknown);
  EXPECT_EQ(a.esdf.max_distance, b.esdf.max_distance);
  EXPECT_TRUE(a.esdf.limits == b.esdf.limits);
  EXPECT_TRUE(a.esdf.layout == b.esdf.layout);
  EXPECT_TRUE(a.esdf.state.values() == b.esdf.state.values());
  EXPECT_TRUE(a.esdf.squared.values() == b.esdf.squared.values());
  EXPECT_TRUE(a.esdf.site.values() == b.esdf.site.values());
  EXPECT_TRUE(a.esdf.obstacle == b.esdf.obstacle);
  EXPECT_EQ(a.min_clearance, b.min_clearance);
  EXPECT_TRUE(a.diagram.voxels == b.diagram.voxels);
  EXPECT_TRUE(a.attach.next.values() == b.attach.next.values());
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.config, b.config);

  expect_same(a.graph, b.graph);
  expect_same(a.tangents.graph, b.tangents.graph);
  EXPECT_EQ(a.tangents.region_of_block, b.tangents.region_of_block);
  EXPECT_EQ(a.tangents.first_seen, b.tangents.first_seen);
  EXPECT_EQ(a.tangents.seen, b.tangents.seen);
  EXPECT_EQ(a.tree.parent, b.tree.parent);
  EXPECT_EQ(a.tree.clearance, b.tree.clearance);
  EXPECT_EQ(a.tree.place, b.tree.place);
}

TEST(RidgeFile, RoomsFarApartAreSaved) {
  OccupancyBuilder voxels(0.2);
  for (const int x : {0, 499'999'000}) {  // distances are rounded to 1e-8 m there
    voxels.fill({{x, 0, 0}, {x + 60, 20, 14}}, VoxelState::kFree);
    voxels.fill({{x + 40, 0, 0}, {x + 60, 70, 14}}, VoxelState::kFree);
    voxels.fill({{x + 20, 9, 0}, {x + 23, 11, 14}}, VoxelState::kOccupied);
  }
  const Roadmap roadmap = build_roadmap(std::move(voxels).finish(), {}).roadmap;
  ASSERT_GT(roadmap.graph.edges.size(), 4u);
  const TemporaryFolder folder;
  save_roadmap(roadmap, folder / "far.ridge");
  expect_same(roadmap, load_roadmap(folder / "far.ridge"));
}

TEST(RidgeFile, EveryFieldComesBack) {
  const TemporaryFolder folder;
  for (const auto unknown : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore}) {
    for (const double max_distance : {0.5, std::numeric_limits<double>::infinity()}) {
      SyntheticConfig config;
      config.unknown = unknown;
      config.max_distance = max_distance;
      const Roadmap roadmap = synthetic_roadmap(config);
      save_roadmap(roadmap, folder / "map.ridge");
      expect_same(load_roadmap(folder / "map.ridge"), roadmap);
    }
  }
}

TEST(RidgeFile, ABuiltRoadmapComesBack) {
  const TemporaryFolder folder;
  for (const auto unknown : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore}) {
    BuildConfig config;
    config.min_clearance = 0.3;
    config.unknown = unknown;
    const Roadmap roadmap = build_roadmap(synthetic_map({}), config).roadmap;
    ASSERT_FALSE(roadmap.graph.edges.empty());
    save_roadmap(roadmap, folder / "map.ridge");
    const Roadmap loaded = load_roadmap(folder / "map.ridge");
    expect_same(loaded, roadmap);
    EXPECT_TRUE(loaded.esdf.site.has_near_only());
  }
}

TEST(RidgeFile, LongOffsetsComeBack) {
  // A passage through the unknown, which is no obstacle, with a wall at one end: offsets that need
  // more than a byte.
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {299, 7, 7}, [](const VoxelIndex& v) {
    return v.x == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  Roadmap roadmap =
      build_roadmap(map, {.min_clearance = 0.3, .unknown = UnknownPolicy::kIgnore}).roadmap;
  const std::vector<SiteOffset> sites = roadmap.esdf.site.values();
  ASSERT_TRUE(std::any_of(sites.begin(), sites.end(),
                          [](const SiteOffset& o) { return std::abs(o.x) > 255; }));
  const TemporaryFolder folder;
  save_roadmap(roadmap, folder / "passage.ridge");
  const Roadmap loaded = load_roadmap(folder / "passage.ridge");
  expect_same(loaded, roadmap);
  EXPECT_FALSE(loaded.esdf.site.has_near_only());
}

TEST(RidgeFile, AnEmptyRoadmapComesBack) {
  const TemporaryFolder folder;
  Roadmap empty;
  empty.esdf.voxel_size = 0.2;
  index_links(empty.graph);
  save_roadmap(empty, folder / "empty.ridge");
  expect_same(load_roadmap(folder / "empty.ridge"), empty);
}

TEST(RidgeFile, BytesDoNotDependOnThreads) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  with_threads(1, [&] { save_roadmap(roadmap, folder / "one.ridge"); });
  with_threads(2, [&] { save_roadmap(roadmap, folder / "two.ridge"); });
  const std::string one = read_whole(folder / "one.ridge");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == read_whole(folder / "two.ridge"));
}

TEST(RidgeFile, InfoTellsTheSections) {
  const TemporaryFolder folder;
  save_roadmap(synthetic_roadmap(), folder / "map.ridge");
  const RidgeInfo info = read_ridge_info(folder / "map.ridge");
  EXPECT_EQ(info.version, 2u);
  EXPECT_NE(info.header.find("\"voxel_size\": 0.1"), std::string::npos);
  EXPECT_EQ(info.sections.size(), 12u);
}

TEST(RidgeFile, LimitsAreKeptAndProgramsThatKnowOfNoneRefuseTheFile) {
  const TemporaryFolder folder;
  Roadmap roadmap = synthetic_roadmap();
  const double third = 1.0 / 3.0;  // no short decimal: to the bit nevertheless
  roadmap.esdf.limits.keep_in.min.z() = -third;
  roadmap.esdf.limits.keep_out = {{Point(90, 90, 90), Point(91 + third, 92, 93)}};
  save_roadmap(roadmap, folder / "limited.ridge");
  EXPECT_EQ(read_ridge_info(folder / "limited.ridge").version, 3u);
  expect_same(roadmap, load_roadmap(folder / "limited.ridge"));
}

TEST(RidgeFile, PartsThatDoNotFitAreNotSaved) {
  const TemporaryFolder folder;
  const Roadmap good = synthetic_roadmap();
  const auto refused = [&](const auto& spoil) {
    Roadmap bad = good;
    spoil(bad);
    EXPECT_THROW(save_roadmap(bad, folder / "bad.ridge"), InputError);
    EXPECT_TRUE(folder.is_empty());
  };
  refused([](Roadmap& r) { r.esdf.squared[r.esdf.layout.find({0, 30, 5})] += 1; });
  refused([](Roadmap& r) { r.attach.next = {}; });
  refused([](Roadmap& r) { r.diagram.voxels = {}; });
  refused([](Roadmap& r) { r.tree.parent.pop_back(); });
  refused([](Roadmap& r) { r.graph.edges[0].to = VertexId{1000}; });
  refused([](Roadmap& r) { r.graph.edges[0].clearance *= 2.0; });
  refused([](Roadmap& r) { r.graph.edges[0].length *= 0.9; });
  refused([](Roadmap& r) { r.esdf.voxel_size = 0.0; });
  refused([](Roadmap& r) { r.esdf.limits.keep_in.max.z() = -1e6; });  // the graph is beyond it
  refused([](Roadmap& r) { std::swap(r.graph.vertices[0], r.graph.vertices[1]); });
  refused([](Roadmap& r) {  // a vertex's way to its neighbour, whose way leads to the vertex
    const VoxelId vertex = r.esdf.layout.find(r.graph.vertices[0].voxel);
    for (int d = 0; d < 27; ++d) {
      const VoxelId n = r.esdf.layout.neighbour(vertex, d);
      if (r.attach.next[n] == opposite(d)) r.attach.next[vertex] = static_cast<Direction>(d);
    }
  });
}

/// What a header says has to be so of the voxels, or queries are answered as for another map.
TEST(RidgeFile, RoadmapsThatAreNotWhatTheySayAreRefused) {
  const TemporaryFolder folder;
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {39, 29, 19}, [](const VoxelIndex& v) {
    const bool is_shell = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 39 || v.y == 29 || v.z == 19;
    return is_shell ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const Roadmap good = build_roadmap(map, {.min_clearance = 0.3}).roadmap;
  EXPECT_NO_THROW(save_roadmap(good, folder / "good.ridge"));
  Roadmap for_smaller = good;
  for_smaller.min_clearance = 0.11;
  for_smaller.graph.min_clearance = 0.11;
  save_roadmap(for_smaller, folder / "smaller.ridge");
  EXPECT_THROW(load_roadmap(folder / "smaller.ridge"), InputError);
  Roadmap flat = good;
  flat.esdf.planar = true;
  EXPECT_THROW(save_roadmap(flat, folder / "bad.ridge"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.ridge"));
}

}  // namespace
}  // namespace ridgeway
