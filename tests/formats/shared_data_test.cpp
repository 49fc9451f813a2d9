// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Files that others wrote, where they are there: RIDGEWAY_SHARED_DATA names their folder.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "formats/mesh_file.hpp"
#include "formats/voxblox.hpp"
#include "formats/voxblox_graph.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

class SharedData : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("RIDGEWAY_SHARED_DATA");
    folder_ = folder != nullptr ? folder : RIDGEWAY_SHARED_DATA_DIR;
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "no data in " << folder_;
  }
  std::filesystem::path folder_;
};

TEST_F(SharedData, LayersOfTheOriginalAreWrittenAgainByteForByte) {
  for (const char* name :
       {"house_025_tsdf.vxblx", "house_025_esdf.vxblx", "cafe_voxblox_misnamed.bt.vxblx"}) {
    const std::string bytes = read_whole(folder_ / "voxblox" / name);
    EXPECT_EQ(voxblox_bytes(read_voxblox(bytes, name)), bytes) << name;
  }
}

TEST(BundledData, AGraphOfTheOriginalIsWrittenAgainByteForByte) {
  const std::string bytes = read_whole(RIDGEWAY_DATA_DIR "/house_025_sparse_graph.pb");
  const VoxbloxGraph graph = read_voxblox_graph(bytes, "graph");
  EXPECT_EQ(voxblox_graph_bytes(graph), bytes);
  EXPECT_EQ(find_faults(graph).components, 4u);
}

/// Clouds say neither how fine they are nor what is free, meshes not the first.
LoadConfig shared_data_config(const std::filesystem::path& file) {
  LoadConfig config;
  const std::string extension = file.extension();
  if (extension == ".dae" || extension == ".DAE" || extension == ".stl") config.voxel_size = 0.2;
  if (extension == ".xyz") {
    config.voxel_size = 0.5;
    config.bounds = Box{{-20.0, -20.0, -3.0}, {20.0, 20.0, 10.0}};
  }
  return config;
}

TEST_F(SharedData, EveryFileIsAMapOrRefusedWithARemedy) {
  const std::set<std::string> maps{".3dmap", ".bt",  ".dae",   ".DAE",
                                   ".ot",    ".stl", ".vxblx", ".xyz"};
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    const std::filesystem::path& file = entry.path();
    // Three columns of numbers are points to all but whoever took the pictures.
    if (!entry.is_regular_file() || file.filename() == "camera-intrinsics.txt") continue;
    SCOPED_TRACE(file);
    if (maps.count(file.extension()) > 0) {
      EXPECT_GT(count_voxels(load_map(file, shared_data_config(file))).free, 1000u);
      ++read;
      continue;
    }
    const std::string why = refusal([&] { load_map(file, shared_data_config(file)); });
    EXPECT_EQ(why.rfind(file.string() + ": ", 0), 0u) << why;
    EXPECT_NE(why.find(" ("), std::string::npos) << why;
  }
  EXPECT_GE(read, 24u);
}

TEST(BundledData, AMeshOfOthersIsReadAsAMap) {
  const VoxelCounts counts = count_voxels(load_map(RIDGEWAY_DATA_DIR "/levine.stl"));
  EXPECT_GT(counts.free, 800'000u);
  EXPECT_GT(counts.occupied, 100'000u);
}

TEST_F(SharedData, WhatIsNoMapIsRefusedWithAReason) {
  const auto says = [&](const char* name) { return refusal([&] { load_map(folder_ / name); }); };
  EXPECT_NE(says("voxblox/house_025_sparse_graph.pb").find("sparse graph"), std::string::npos);
  EXPECT_NE(says("geb079/spherical_scan.graph").find("no map format"), std::string::npos);
  EXPECT_NE(says("lidar_lab/merged_registered.xyz").find("give"), std::string::npos);
  EXPECT_NE(says("warframe/Simple.3dmap.3dscen").find("no map format"), std::string::npos);
}

}  // namespace
}  // namespace ridgeway
