// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "support/map_file_writers.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

struct Sample {
  std::string name;
  std::string bytes;
  bool notices_every_cut;  ///< else a text, in which a cut may fall between two numbers
};

std::vector<Sample> all_samples() {
  const std::vector<testing::CloudPoint> points = {
      {0.5, 0.5, 0.5}, {0.25, -0.5, 0.125}, {1.5, 1.0, -0.5}, {0.1f, 0.1, 0.1}, {-1, -1, -1}};
  return {{"a.bt", testing::write_bt(), true},
          {"a.ot", testing::write_ot(), true},
          {"colour.ot", testing::write_ot("ColorOcTree"), true},
          {"ascii.pcd", testing::write_pcd(points, "ascii"), false},
          {"binary.pcd", testing::write_pcd(points, "binary"), true},
          {"packed.pcd", testing::write_pcd(points, "binary_compressed"), true},
          {"ascii.ply", testing::write_ply(points, "ascii"), false},
          {"little.ply", testing::write_ply(points, "binary_little_endian"), true},
          {"big.ply", testing::write_ply(points, "binary_big_endian"), true},
          {"a.xyz", testing::write_xyz(points), false},
          {"a.3dmap", "voxel 6 5 4\n1 2 3\n0 0 0\n5 4 3\n", false}};
}

LoadConfig config_for(const Sample& sample) {
  LoadConfig config;
  const bool octree = sample.name.ends_with(".bt") || sample.name.ends_with(".ot");
  if (!octree) {
    config.voxel_size = 0.25;
    config.bounds = {{-2, -2, -2}, {2, 2, 2}};
  }
  return config;
}

/// Loads it, or is refused by an InputError that names the file or an option; anything else fails.
bool loads(const TemporaryFolder& folder, const Sample& sample) {
  const auto file = folder / sample.name;
  std::filesystem::remove(file);  // some file systems flush what is written over
  write_whole(file, sample.bytes);
  try {
    load_map(file, config_for(sample));
    return true;
  } catch (const InputError& error) {
    EXPECT_TRUE(error.where() == file.string() || error.where() == "voxel_size") << error.what();
    EXPECT_FALSE(error.remedy().empty());
    return false;
  }
}

TEST(DamagedMapFiles, TheSamplesThemselvesLoad) {
  const TemporaryFolder folder;
  for (const Sample& sample : all_samples()) EXPECT_TRUE(loads(folder, sample)) << sample.name;
}

TEST(DamagedMapFiles, FilesCutShortAnywhereAreRefused) {
  const TemporaryFolder folder;
  for (const Sample& sample : all_samples())
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      const bool loaded = loads(folder, {sample.name, sample.bytes.substr(0, size), true});
      EXPECT_FALSE(loaded && sample.notices_every_cut) << sample.name << " cut to " << size;
    }
}

TEST(DamagedMapFiles, TrailingBytesAreRefused) {
  const TemporaryFolder folder;
  for (const Sample& sample : all_samples())
    EXPECT_FALSE(loads(folder, {sample.name, sample.bytes + "garbage", true})) << sample.name;
}

TEST(DamagedMapFiles, FlippedBytesNeverCrash) {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  for (const Sample& sample : all_samples()) {
    int refused = 0;
    for (int round = 0; round < 400; ++round) {
      Sample damaged = sample;
      for (int flips = 1 + static_cast<int>(random() % 3); flips > 0; --flips)
        damaged.bytes[random() % damaged.bytes.size()] ^= static_cast<char>(1 + random() % 255);
      refused += !loads(folder, damaged);
    }
    EXPECT_GT(refused, 0) << sample.name;
  }
}

TEST(DamagedMapFiles, TreesThatLieAreRefused) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> lies = {
      {"size 24", "size 23"}, {"size 24", "size 25"},
      {"size 24", "size 0"},  {"size 24", "size"},
      {"res 0.1", "res 0"},   {"res 0.1", "res -0.1"},
      {"res 0.1", "res nan"}, {"res 0.1", "res 1e300"},
      {"res 0.1", "res x"},   {"id OcTree", "id CountingOcTree"},
      {"id OcTree\n", "\n"},  {"data", "date"}};
  for (const Sample& sample :
       {Sample{"a.bt", testing::write_bt(), true}, Sample{"a.ot", testing::write_ot(), true}})
    for (const auto& [truth, lie] : lies) {
      Sample bad = sample;
      bad.bytes.replace(bad.bytes.find(truth), truth.size(), lie);
      EXPECT_FALSE(loads(folder, bad)) << lie;
    }
}

TEST(DamagedMapFiles, TreesDeeperThanSixteenLevelsAreRefused) {
  const TemporaryFolder folder;
  std::string bytes = testing::write_bt();
  bytes.resize(bytes.find("data\n") + 5);
  for (int depth = 0; depth < 100'000; ++depth) testing::append(bytes, std::uint16_t{3});
  EXPECT_FALSE(loads(folder, {"deep.bt", bytes, true}));
  bytes = testing::write_ot();
  bytes.resize(bytes.find("data\n") + 5);
  for (int depth = 0; depth < 100'000; ++depth) {
    testing::append(bytes, 1.0f);
    testing::append(bytes, std::uint8_t{1});
  }
  EXPECT_FALSE(loads(folder, {"deep.ot", bytes, true}));
}

TEST(DamagedMapFiles, ATreeThatWouldFillTheWorldIsRefusedAtOnce) {
  const TemporaryFolder folder;
  std::string bytes = "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.05\ndata\n";
  testing::append(bytes, std::uint16_t{0x5555});  // eight free leaves, each a 32768th of a side
  EXPECT_FALSE(loads(folder, {"world.bt", bytes, true}));

  write_whole(folder / "world.bt", bytes);
  const LoadConfig small{.voxel_size = 0.1, .bounds = Box{{-1, -1, -1}, {1, 1, 1}}};
  EXPECT_EQ(count_voxels(load_map(folder / "world.bt", small)).free, 8000u);
}

}  // namespace
}  // namespace ridgeway
