// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/load_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "formats/benchmark_map.hpp"
#include "mapping/random_map.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "support/map_file_writers.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

/// Where and what of the InputError that a call throws.
std::string why_refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was not refused";
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A benchmark map with scattered blocked cells: voxel data without the need of an OctoMap writer.
std::string scattered_cells() {
  std::string text = "voxel 40 30 20\n";
  for (int i = 0; i < 300; ++i)
    text += std::to_string(i * 17 % 40) + ' ' + std::to_string(i * 11 % 30) + ' ' +
            std::to_string(i * 7 % 20) + '\n';
  return text;
}

TEST(LoadMap, FilesThatAreNoneAreNamed) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(why_refused([&] { load_map(folder / "missing.bt"); }),
                       "missing.bt: there is no such"));
  EXPECT_TRUE(contains(why_refused([&] { load_map(folder.path()); }),
                       folder.path().string() + ": is a folder"));
  write_whole(folder / "empty.bt", "");
  EXPECT_TRUE(contains(why_refused([&] { load_map(folder / "empty.bt"); }), "empty.bt: is empty"));
  write_whole(folder / "picture.bt", "\x89PNG\r\n\x1a\n and so on");
  EXPECT_TRUE(contains(why_refused([&] { load_map(folder / "picture.bt"); }),
                       "picture.bt: is in no map format"));
}

TEST(LoadMap, TheBytesDecideAndNotTheName) {
  const TemporaryFolder folder;
  write_whole(folder / "misnamed.xyz", testing::write_bt());
  EXPECT_EQ(count_voxels(load_map(folder / "misnamed.xyz")).free, 7u);
  write_whole(folder / "misnamed.bt", testing::write_ot("ColorOcTree"));
  EXPECT_EQ(count_voxels(load_map(folder / "misnamed.bt")).free, 7u);
}

TEST(LoadMap, CloudsNeedVoxelSizeAndBoundsAndSayWhereTheyAre) {
  const TemporaryFolder folder;
  const auto file = folder / "cloud.xyz";
  write_whole(file, "0 0 0\n1 2 3\n");
  EXPECT_TRUE(contains(why_refused([&] { load_map(file); }),
                       "give bounds and voxel_size; its points span 0,0,0"));
  EXPECT_TRUE(contains(why_refused([&] {
                         load_map(file, {.bounds = Box{{0, 0, 0}, {2, 2, 2}}});
                       }),
                       "give voxel_size;"));
  const std::string unbounded = why_refused([&] { load_map(file, {.voxel_size = 0.1}); });
  EXPECT_TRUE(contains(unbounded, "give bounds; its points span 0,0,0 to 1,2,3")) << unbounded;
  const std::string elsewhere = why_refused([&] {
    load_map(file, {.voxel_size = 0.1, .bounds = Box{{5, 5, 5}, {6, 6, 6}}});
  });
  EXPECT_TRUE(contains(elsewhere, "no point within the bounds")) << elsewhere;
  EXPECT_TRUE(
      contains(why_refused([&] {
                 load_map(file, {.voxel_size = 0.1, .bounds = Box{{0, 0, 0}, {1e300, 1, 1}}});
               }),
               "bounds: reach farther"));
  EXPECT_TRUE(
      contains(why_refused([&] {
                 load_map(file, {.voxel_size = 1e-4, .bounds = Box{{0, 0, 0}, {50, 50, 50}}});
               }),
               "of memory"));
}

TEST(LoadMap, NotesTellWhatAPersonMustKnow) {
  const TemporaryFolder folder;
  write_whole(folder / "cloud.ply",
              testing::write_ply({{0, 0, 0}, {1, 1, std::nan("")}, {1, 1, 1}}, "ascii"));
  LoadNotes notes;
  load_map(folder / "cloud.ply",
           {.voxel_size = 0.1, .bounds = Box{{-1, -1, -1}, {2, 2, 2}}, .isolated_below = 2},
           &notes);
  std::string all;
  for (const std::string& note : notes.notes) all += note + '\n';
  EXPECT_TRUE(contains(all, "1 of 3 points were skipped")) << all;
  EXPECT_TRUE(contains(all, "everything within bounds that is not occupied is taken as free"))
      << all;
  EXPECT_TRUE(contains(all, "2 occupied voxels in clusters of fewer than 2")) << all;
}

TEST(LoadMap, AMeshIsNotTakenForTheCloudOfItsVertices) {
  const TemporaryFolder folder;
  write_whole(folder / "room.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0\n1 0 0\n1 1 1\n3 0 1 2\n");
  LoadConfig config;
  config.voxel_size = 0.05;
  LoadNotes notes;
  const OccupancyMap map = load_map(folder / "room.ply", config, &notes);
  EXPECT_TRUE(contains(notes.notes.back(), "reached from the bounds is taken as free, outside"))
      << notes.notes.back();
  EXPECT_EQ(map.at(voxel_at(Point(0.66, 0.33, 0.33), 0.05) - map.origin), VoxelState::kOccupied);
  // In other units, another axis up.
  config.units = 2.0;
  config.up = UpAxis::kY;
  const OccupancyMap large = load_map(folder / "room.ply", config);
  EXPECT_EQ(large.at(voxel_at(Point(1.32, -0.66, 0.66), 0.05) - large.origin),
            VoxelState::kOccupied);
}

TEST(LoadMap, OptionsOfMeshesAreOfMeshesAlone) {
  const TemporaryFolder folder;
  write_whole(folder / "cells.3dmap", "voxel 3 3 3\n");
  LoadConfig config;
  config.units = 0.001;
  EXPECT_TRUE(contains(why_refused([&] { load_map(folder / "cells.3dmap", config); }), "units"));
  config.units = std::nan("");
  EXPECT_TRUE(contains(why_refused([&] { config.validate(); }), "units"));
}

TEST(LoadMap, MeshesThatAreDamagedAreRefusedByName) {
  const TemporaryFolder folder;
  const auto says = [&](const char* name, const std::string& bytes) {
    write_whole(folder / name, bytes);
    return why_refused([&] { load_map(folder / name); });
  };
  EXPECT_TRUE(contains(says("far.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 1e30\nf 1 2 3\n"), "far.obj"));
  EXPECT_TRUE(contains(says("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 1\nf 1 2 3\n"), "nan.obj"));
  EXPECT_TRUE(contains(says("empty.stl", "solid a\nfacet\nendsolid\n"), "empty.stl"));
  EXPECT_TRUE(contains(says("cut.glb", "glTF\2"), "cut.glb"));
  // In millimetres, most likely.
  EXPECT_TRUE(
      contains(says("mm.obj", "v 0 0 0\nv 90000 0 0\nv 0 90000 90000\nf 1 2 3\n"),
               "names no unit, and spans 9e+04 x 9e+04 x 9e+04 m if that is metres: give units"));
  const std::string cycle =
      "<?xml version='1.0'?><COLLADA version='1.4.1'><library_nodes><node id='a'><instance_node "
      "url='#b'/></node><node id='b'><instance_node url='#a'/></node></library_nodes>"
      "<library_visual_scenes><visual_scene id='s'><node id='r'><instance_node url='#a'/></node>"
      "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
      "</COLLADA>";
  EXPECT_TRUE(contains(says("cycle.dae", cycle), "cycle.dae"));
}

TEST(LoadMap, ABuildingThatLiesOnItsSideIsTold) {
  const TemporaryFolder folder;
  // A hall of 8 x 7 x 2 m whose height is along y.
  write_whole(folder / "hall.obj",
              "v 0 0 0\nv 8 0 0\nv 8 0 7\nv 0 0 7\nv 0 2 0\nv 8 2 0\nv 8 2 7\nv 0 2 7\n"
              "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto told = [&](std::optional<UpAxis> up) {
    LoadConfig config{.voxel_size = 0.2};
    config.up = up;
    LoadNotes notes;
    load_map(folder / "hall.obj", config, &notes);
    return std::any_of(notes.notes.begin(), notes.notes.end(), [](const std::string& note) {
      return contains(note, "y is its upward axis (option up)");
    });
  };
  EXPECT_FALSE(told(UpAxis::kZ));
  EXPECT_FALSE(told(UpAxis::kY));
  EXPECT_TRUE(told({}));
}

TEST(LoadMap, AWorldIsAMap) {
  const OccupancyMap map = load_map(std::filesystem::path(RIDGEWAY_WORLDS_DIR) / "house.yaml");
  EXPECT_EQ(map.voxel_size, 0.1);
  EXPECT_GT(count_voxels(map).free, 500'000u);
  EXPECT_EQ(map.at(voxel_at(Point(3.75, 5.0, 2.5), 0.1) - map.origin), VoxelState::kOccupied);
}

TEST(LoadMap, CornersOfBoxesAreNotTakenForPoints) {
  const TemporaryFolder folder;
  write_whole(folder / "boxes.txt", "0 0 0 10 6 3\n4 0 0 4.2 6 3\n");
  const std::string message = why_refused([&] {
    load_map(folder / "boxes.txt", {.voxel_size = 0.1, .bounds = Box{{0, 0, 0}, {10, 6, 3}}});
  });
  EXPECT_TRUE(contains(message, "boxes.txt: line 1 has 6 columns")) << message;
}

TEST(LoadMap, QuarterTurnsAreExactForCloudsAndVoxels) {
  const TemporaryFolder folder;
  write_whole(folder / "a.3dmap", scattered_cells());
  LoadConfig config{.voxel_size = 0.5};
  const OccupancyMap plain = load_map(folder / "a.3dmap", config);
  config.transform.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Point::UnitX()));
  config.transform.pretranslate(Point(1.5, -2.0, 0.5));
  const OccupancyMap turned = load_map(folder / "a.3dmap", config);
  EXPECT_EQ(count_voxels(turned).known(), count_voxels(plain).known());
  testing::for_each_known(plain, [&](const VoxelIndex& v, VoxelState state) {
    EXPECT_EQ(testing::state_at(turned, voxel_at(config.transform * centre_of(v, 0.5), 0.5)),
              state);
  });
}

TEST(LoadMap, ReadingOnlyWhatTheBoundsNeedChangesNothing) {
  const TemporaryFolder folder;
  const std::string bytes = scattered_cells();
  write_whole(folder / "a.3dmap", bytes);
  const OccupancyMap whole = read_benchmark_map(bytes, "a.3dmap", 1.0);
  for (const double angle : {0.0, std::numbers::pi / 2, 0.3}) {
    for (const int specks : {0, 4}) {
      LoadConfig config{.bounds = Box{{-21, 2.5, 3}, {31, 20, 15.2}}, .isolated_below = specks};
      config.exclude = {{{5, 5, 5}, {8, 8, 8}}};
      config.transform.rotate(Eigen::AngleAxisd(angle, Point::UnitZ()));
      OccupancyMap expected = transform_map(whole, config.transform, 1.0);
      expected = remove_isolated(expected, specks);
      expected = add_no_fly(crop(expected, *config.bounds), config.exclude);
      EXPECT_TRUE(testing::same_voxels(load_map(folder / "a.3dmap", config), expected))
          << angle << ' ' << specks;
    }
  }
}

TEST(LoadMap, EditsRunInTheStatedOrder) {
  const TemporaryFolder folder;
  const auto file = folder / "cloud.xyz";
  write_whole(file, "0.05 0.05 0.05\n0.15 0.05 0.05\n0.75 0.75 0.75\n");
  const Box bounds = {{0.1, 0, 0}, {1, 1, 1}};
  // The cluster of two reaches beyond the bounds and stays; the single one goes.
  const OccupancyMap map = load_map(file, {.voxel_size = 0.1,
                                           .bounds = bounds,
                                           .exclude = {Box{{0.45, 0, 0}, {0.55, 2, 2}}},
                                           .isolated_below = 2});
  EXPECT_EQ(testing::state_at(map, {0, 0, 0}), VoxelState::kUnknown);
  EXPECT_EQ(testing::state_at(map, {1, 0, 0}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(map, {7, 7, 7}), VoxelState::kFree);
  EXPECT_EQ(testing::state_at(map, {4, 3, 3}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(map, {5, 3, 12}), VoxelState::kOccupied)
      << "no-fly boxes hold beyond the bounds";
}

TEST(LoadMap, BadOptionsAreNamed) {
  const TemporaryFolder folder;
  write_whole(folder / "a.bt", testing::write_bt());
  const auto load = [&](const LoadConfig& config) {
    return why_refused([&] { load_map(folder / "a.bt", config); });
  };
  EXPECT_TRUE(load({.voxel_size = 0.0}).starts_with("voxel_size: "));
  EXPECT_TRUE(load({.voxel_size = 0.09}).starts_with("voxel_size: "));
  EXPECT_TRUE(load({.bounds = Box{{0, 0, 0}, {1, 1, -1}}}).starts_with("bounds: along z"));
  EXPECT_TRUE(
      load({.exclude = {Box{{std::nan(""), 0, 0}, {1, 1, 1}}}}).starts_with("exclude box 1"));
  EXPECT_TRUE(load({.isolated_below = -1}).starts_with("isolated_below: "));
  LoadConfig squeezed;
  squeezed.transform.linear() *= 0.5;
  EXPECT_TRUE(load(squeezed).starts_with("transform: "));
  const std::string elsewhere = load({.bounds = Box{{0, 0, 0}, {1, 1, 1}}});
  EXPECT_TRUE(contains(elsewhere, "no voxel within the bounds (its voxels span -3276.8,"))
      << elsewhere;
}

TEST(LoadMap, AMapWithoutFreeSpaceIsRefused) {
  const TemporaryFolder folder;
  std::string bytes = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.05\ndata\n";
  testing::append(bytes, std::uint16_t{2});
  write_whole(folder / "solid.bt", bytes);
  EXPECT_TRUE(
      contains(why_refused([&] { load_map(folder / "solid.bt"); }), "solid.bt: has no free space"));
  write_whole(folder / "full.3dmap", "voxel 1 1 2\n0 0 0\n0 0 1\n");
  EXPECT_TRUE(
      contains(why_refused([&] { load_map(folder / "full.3dmap"); }), "has no free voxel left"));
}

}  // namespace
}  // namespace ridgeway
