// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/world_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "sensing/world_generators.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

TEST(WorldFile, GivesBackWhatWasSaved) {
  const TemporaryFolder folder;
  World world = make_hall();
  world.name = "a \"hall\": 1\n";
  world.spheres.push_back({{0.1, -2.0, 1e-3}, 0.25});
  world.planes.push_back({Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0, 0.7});
  save_world(world, folder / "hall.yaml");
  const World loaded = load_world(folder / "hall.yaml");
  EXPECT_EQ(loaded.name, world.name);
  ASSERT_EQ(loaded.planes.size(), world.planes.size());
  for (std::size_t i = 0; i < world.planes.size(); ++i) {
    EXPECT_LT((loaded.planes[i].normal - world.planes[i].normal).norm(), 1e-15);
    EXPECT_NEAR(loaded.planes[i].offset, world.planes[i].offset, 1e-14);
  }
  ASSERT_EQ(loaded.boxes.size(), world.boxes.size());
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    EXPECT_EQ(loaded.boxes[i].centre, world.boxes[i].centre);
    EXPECT_EQ(loaded.boxes[i].size, world.boxes[i].size);
  }
  ASSERT_EQ(loaded.cylinders.size(), world.cylinders.size());
  EXPECT_EQ(loaded.cylinders.back().height, world.cylinders.back().height);
  EXPECT_EQ(loaded.spheres.at(0).radius, 0.25);
}

TEST(WorldFile, KeepsSolidsThatComeAndGo) {
  const TemporaryFolder folder;
  write_whole(folder / "door.yaml",
              "timed:\n"
              "  - from: 6\n"
              "    until: 14.5\n"
              "    boxes:\n"
              "      - {centre: [1, 2, 3], size: [0.5, 1, 2]}\n"
              "  - until: 2\n"
              "    spheres: [{centre: [0, 0, 1], radius: 0.25}]\n"
              "    cylinders: [{centre: [4, 0, 1], radius: 0.5, height: 2}]\n");
  save_world(load_world(folder / "door.yaml"), folder / "again.yaml");
  for (const char* file : {"door.yaml", "again.yaml"}) {
    const World world = load_world(folder / file);
    ASSERT_EQ(world.timed.size(), 2u) << file;
    EXPECT_EQ(world.timed[0].from, 6.0);
    EXPECT_EQ(world.timed[0].until, 14.5);
    EXPECT_EQ(world.timed[0].boxes.at(0).size, Eigen::Vector3d(0.5, 1.0, 2.0));
    EXPECT_TRUE(std::isinf(world.timed[1].from));
    EXPECT_EQ(world.timed[1].spheres.at(0).radius, 0.25);
    EXPECT_EQ(world.timed[1].cylinders.at(0).height, 2.0);
  }
  for (const char* bad : {"timed:\n  - {from: 3, until: 3}\n",
                          "timed:\n  - {boxes: [{centre: [0, 0, 0], size: [1, 0, 1]}]}\n",
                          "timed:\n  - {meshes: []}\n", "timed: 4\n"}) {
    write_whole(folder / "bad.yaml", bad);
    EXPECT_THROW(load_world(folder / "bad.yaml"), InputError) << bad;
  }
}

TEST(WorldFile, SolidsThatComeAndGoAreObstaclesOfItsMap) {
  const TemporaryFolder folder;
  write_whole(folder / "door.yaml",
              "boxes:\n"
              "  - {centre: [0, 0, 0], size: [0.2, 0.2, 0.2]}\n"
              "timed:\n"
              "  - {from: 6, until: 14, boxes: [{centre: [2, 1, 1], size: [0.2, 0.6, 0.6]}]}\n");
  LoadConfig config;
  config.bounds = Box{Point::Zero(), Point(4, 2, 2)};
  LoadNotes notes;
  const OccupancyMap map = load_map(folder / "door.yaml", config, &notes);
  EXPECT_EQ(map.at(voxel_at(Point(2, 1, 1), map.voxel_size) - map.origin), VoxelState::kOccupied);
  EXPECT_EQ(map.at(voxel_at(Point(3, 1, 1), map.voxel_size) - map.origin), VoxelState::kFree);
  EXPECT_TRUE(std::any_of(notes.notes.begin(), notes.notes.end(), [](const std::string& note) {
    return note.find("(timed)") != std::string::npos;
  }));
  const World world = load_world(folder / "door.yaml");
  const OccupancyMap known = occupancy_of(world, 0.1, *config.bounds);
  EXPECT_EQ(known.at(voxel_at(Point(2, 1, 1), 0.1) - known.origin), VoxelState::kOccupied);
}

TEST(WorldFile, TheHouseIsThatOfThePaper) {
  const World house = load_world(std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml");
  EXPECT_EQ(house.planes.size(), 6u);
  EXPECT_EQ(house.boxes.size(), 11u);
  EXPECT_EQ(house.spheres.size(), 2u);
  EXPECT_EQ(house.cylinders.size(), 1u);
  EXPECT_NEAR(surface_distance(house, {1.0, 1.0, 1.0}).distance, 1.0, 1e-12);
  EXPECT_NEAR(surface_distance(house, {12.5, 1.5, 1.25}).distance, 0.0, 1e-12);  // between spheres
  EXPECT_NEAR(surface_distance(house, {8.25, 5.0, 2.5}).distance, 0.75, 1e-12);  // the doorway
}

TEST(WorldFile, MeshesAreFoundFromItsFolderAndPlaced) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "things");
  write_whole(folder / "things/wedge.obj",
              "v 0 0 0\nv 1000 0 0\nv 0 2000 0\nv 0 0 3000\n"
              "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  write_whole(folder / "room.yaml",
              "meshes:\n"
              "  - {file: things/wedge.obj, scale: 0.001, rotation: [0, 0, 90], "
              "translation: [5, 0, 1]}\n"
              "  - file: things/wedge.obj\n");
  const World world = load_world(folder / "room.yaml");
  ASSERT_EQ(world.meshes.size(), 2u);
  EXPECT_EQ(world.meshes[0].mesh, world.meshes[1].mesh);  // read once
  World one = world;
  one.meshes.pop_back();
  // Turned, the wedge runs from x = 5 to 3 and from y = 0 to 1.
  EXPECT_NEAR(surface_distance(one, {4.9, 0.1, 1.1}).distance, -0.1, 1e-9);
  EXPECT_NEAR(surface_distance(one, {5.5, 0.1, 1.1}).distance, 0.5, 1e-9);
  EXPECT_NEAR(cast_ray(one, {0.0, 0.1, 1.1}, Eigen::Vector3d::UnitX()), 5.0 - 26.0 / 15.0, 1e-6);
  EXPECT_NEAR(surface_distance(world, {100.0, 100.0, 100.0}).distance, -100.0, 1e-9);

  one.meshes[0].T_world_mesh.rotate(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()));
  std::filesystem::create_directory(folder / "elsewhere");
  save_world(one, folder / "elsewhere/copy.yaml");
  const World copy = load_world(folder / "elsewhere/copy.yaml");
  ASSERT_EQ(copy.meshes.size(), 1u);
  EXPECT_EQ(copy.meshes[0].scale, 0.001);
  EXPECT_TRUE(copy.meshes[0].T_world_mesh.isApprox(one.meshes[0].T_world_mesh, 1e-12));
  one.meshes[0].file.clear();
  EXPECT_THROW(save_world(one, folder / "nowhere.yaml"), InputError);
}

TEST(WorldFile, MistakesAreNamedWithTheirLine) {
  const TemporaryFolder folder;
  const auto refused_for = [&](const std::string& text) {
    write_whole(folder / "bad.yaml", text);
    try {
      load_world(folder / "bad.yaml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string none = (folder / "none.stl").string();
  const std::string box = "boxes:\n  - {centre: [0, 0, 0], ";
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"", "is empty"},
           {"- 1\n", "line 1"},
           {"name: a\nballs: []\n", "line 2: has an unknown key 'balls'"},
           {box + "colour: red, size: [1, 1, 1]}\n", "line 2: has an unknown key 'colour'"},
           {box + "size: [1, 1]}\n", "line 2: has a size"},
           {box + "size: [1, 1, .nan]}\n", "line 2: has a size that is no number"},
           {box + "size: [1, 1, 1e999]}\n", "line 2"},
           {box + "size: [1, 1, 0]}\n", "box 1"},
           {box + "}\n", "has no size"},
           {"boxes: 5\n", "line 1: has boxes that are no list"},
           {"boxes: [1, 2]\n", "line 1"},
           {"planes:\n- {point: [0, 0, 0], normal: [0, 0, 0]}\n", "line 2: has a normal"},
           {"spheres:\n- {centre: [0, 0, 0], radius: -1}\n", "sphere 1"},
           {"meshes:\n- {scale: 1}\n", "line 2: has no file"},
           {"meshes:\n- {file: [a]}\n", "line 2: has a file that is no path"},
           {"name: a\nmeshes:\n- {file: none.stl}\n", "line 3: " + none + " there is no such file"},
           {"meshes:\n- {file: none.stl, colour: red}\n", "line 2: has an unknown key 'colour'"},
           {"meshes:\n- {file: none.stl, scale: 0}\n", "line 2: has a scale"},
           {"meshes:\n- {file: none.stl, scale: -1}\n", "line 2: has a scale"},
           {"meshes:\n- {file: none.stl, scale: big}\n", "line 2: has a scale that is no number"},
           {"meshes:\n- {file: none.stl, translation: 5}\n", "line 2: has a translation"},
           {"meshes:\n- {file: none.stl, rotation: [1, 2]}\n", "[roll, pitch, yaw]"},
           {"meshes:\n- {file: bad.yaml}\n", "bad.yaml names no format"},
           {"boxes: []\nname: a\nboxes: []\n", "line 3: has the key 'boxes' again"},
           {box + "size: [1, 1, 1],\n     size: [2, 2, 2]}\n", "line 3: has the key 'size' again"},
           {"boxes: [\n", "is no YAML"},
           {"boxes: {{{{\n", "bad.yaml"},
           {std::string(100000, '['), "bad.yaml"}}) {
    const std::string message = refused_for(text);
    EXPECT_NE(message.find(word), std::string::npos) << text.substr(0, 80) << " -> " << message;
    EXPECT_NE(message.find("bad.yaml"), std::string::npos) << message;
  }
  EXPECT_EQ(
      refused_for(box + "size: [1, 1, 0]}\n"),
      (folder / "bad.yaml").string() + " box 1: has no size (give finite lengths above 0 metres)");
  EXPECT_THROW(load_world(folder / "none.yaml"), InputError);
}

TEST(WorldFile, TheHouseIsThatOfTheGenerator) {
  const World file = load_world(std::string(RIDGEWAY_SOURCE_DIR) + "/worlds/house.yaml");
  const World made = make_house();
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Point p(random.uniform(-1, 16), random.uniform(-1, 11), random.uniform(-1, 6));
    EXPECT_DOUBLE_EQ(surface_distance(file, p).distance, surface_distance(made, p).distance);
  }
  EXPECT_EQ(file.name, made.name);
}

}  // namespace
}  // namespace ridgeway
