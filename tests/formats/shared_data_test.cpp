// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Files that others wrote, where they are there: RIDGEWAY_SHARED_DATA names their folder.
#include <gtest/gtest.h>

#include <cstdlib>

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

TEST_F(SharedData, MapsAreRead) {
  for (const char* name :
       {"freiburg/fr_078_tidyup.bt", "freiburg/fr_079.bt", "freiburg/fr_campus.bt",
        "willow_octomap/sample_map2.bt", "geb079/geb079.bt", "octomap_ot/map.ot",
        "simulated_octomaps/box.bt", "simulated_octomaps/tree.bt", "simulated_octomaps/tunnel.bt",
        "voxblox/house_025_tsdf.vxblx", "voxblox/house_025_esdf.vxblx",
        "voxblox/cafe_voxblox_misnamed.bt.vxblx", "warframe/Simple.3dmap",
        "warframe/Complex.3dmap"})
    EXPECT_GT(count_voxels(load_map(folder_ / name)).free, 1000u) << name;
}

TEST_F(SharedData, MeshesAreReadAsMaps) {
  LoadConfig config;
  config.voxel_size = 0.2;
  for (const char* name : {"meshes/willowgarage_collision.dae", "mesh_stl/levine.stl",
                           "mesh_stl/office.stl", "mine_mesh/Edgar_Section_03.DAE"})
    EXPECT_GT(count_voxels(load_map(folder_ / name, config)).free, 10'000u) << name;
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
