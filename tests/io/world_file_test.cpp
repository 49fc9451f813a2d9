// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/io/world_file.hpp"

#include <gtest/gtest.h>

#include "ridgeway/common/error.hpp"
#include "ridgeway/sensing/world_generators.hpp"
#include "temporary_folder.hpp"

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

TEST(WorldFile, MistakesAreNamedWithTheirLine) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    write_whole(folder / "bad.yaml", text);
    try {
      load_world(folder / "bad.yaml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
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
           {"boxes: [\n", "is no YAML"},
           {"boxes: {{{{\n", "bad.yaml"},
           {std::string(100000, '['), "bad.yaml"}}) {
    const std::string message = refusal(text);
    EXPECT_NE(message.find(word), std::string::npos) << text.substr(0, 80) << " -> " << message;
    EXPECT_NE(message.find("bad.yaml"), std::string::npos) << message;
  }
  EXPECT_THROW(load_world(folder / "none.yaml"), InputError);
}

}  // namespace
}  // namespace ridgeway
