// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// Our reader against OctoMap's own, voxel by voxel.
#include "formats/octomap.hpp"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <octomap/OcTreeStamped.h>

#include <filesystem>
#include <memory>
#include <random>
#include <sstream>

#include "mapping/random_map.hpp"
#include "ridgeway/common/error.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

/// Rays into a room, as a sensor would, and a solid and an empty block that can be pruned.
template <typename Tree>
void fill(Tree& tree, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> part(-1.0f, 1.0f);
  const auto size = static_cast<float>(tree.getResolution());
  octomap::Pointcloud cloud;
  for (int i = 0; i < 400; ++i) {
    octomap::point3d direction(part(random), part(random), part(random));
    cloud.push_back(direction.normalized() * (size * 30.0f));
  }
  tree.insertPointCloud(cloud, octomap::point3d(size * 0.3f, size * 0.4f, -size * 0.2f));
  const auto middle = [size](int index) { return (static_cast<float>(index) + 0.5f) * size; };
  for (int z = 32; z < 48; ++z)
    for (int y = -16; y < 0; ++y)
      for (int x = -64; x < -40; ++x)
        tree.updateNode(octomap::point3d(middle(x), middle(y), middle(z)), x < -48);
}

template <typename Tree>
void expect_same(const Tree& tree, const OccupancyMap& map) {
  constexpr int zero = 32768;
  std::size_t known = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const int side = 1 << (16 - leaf.getDepth());
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const VoxelIndex low = {key[0] - zero, key[1] - zero, key[2] - zero};
    const VoxelState state = tree.isNodeOccupied(*leaf) ? VoxelState::kOccupied : VoxelState::kFree;
    bool same = true;
    testing::for_each_in({low, low + VoxelIndex{side - 1, side - 1, side - 1}},
                         [&](const VoxelIndex& v) { same &= testing::state_at(map, v) == state; });
    ASSERT_TRUE(same) << "leaf at " << low.x << ' ' << low.y << ' ' << low.z << " of " << side;
    known += static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
             static_cast<std::size_t>(side);
    // Lengths too: the centre of the leaf's first voxel.
    if (side == 1) {
      ASSERT_LT(
          (centre_of(low, map.voxel_size) - Point(leaf.getX(), leaf.getY(), leaf.getZ())).norm(),
          0.01 * map.voxel_size);
    }
  }
  EXPECT_EQ(count_voxels(map).known(), known);
}

TEST(Octomap, BinaryFilesEqualTheOracleAtAnyResolution) {
  for (const double resolution : {0.01, 0.05, 0.2, 1.0, 3.7}) {
    octomap::OcTree tree(resolution);
    fill(tree, 5);
    tree.toMaxLikelihood();
    for (const bool pruned : {false, true}) {
      pruned ? tree.prune() : tree.expand();
      std::ostringstream file;
      tree.writeBinaryConst(file);
      const OccupancyMap map = read_octomap(file.str(), "oracle.bt");
      EXPECT_EQ(map.voxel_size, resolution);
      expect_same(tree, map);
    }
  }
}

template <typename Tree>
void check_full_files() {
  for (const double resolution : {0.05, 0.4}) {
    Tree tree(resolution);
    fill(tree, 6);
    for (const bool pruned : {false, true}) {
      pruned ? tree.prune() : tree.expand();
      std::ostringstream file;
      tree.write(file);
      expect_same(tree, read_octomap(file.str(), "oracle.ot"));
    }
  }
}

TEST(Octomap, FullFilesEqualTheOracle) { check_full_files<octomap::OcTree>(); }
TEST(Octomap, ColourFilesEqualTheOracle) { check_full_files<octomap::ColorOcTree>(); }
TEST(Octomap, StampedFilesEqualTheOracle) { check_full_files<octomap::OcTreeStamped>(); }

TEST(Octomap, TheFirstReleasesHeaderIsRead) {
  octomap::OcTree tree(0.1);
  fill(tree, 7);
  tree.toMaxLikelihood();
  std::ostringstream file, data;
  tree.writeBinaryData(data);
  const int type = 3;
  const double resolution = 0.1;
  const auto size = static_cast<unsigned>(tree.size());
  file.write(reinterpret_cast<const char*>(&type), sizeof type);
  file.write(reinterpret_cast<const char*>(&resolution), sizeof resolution);
  file.write(reinterpret_cast<const char*>(&size), sizeof size);
  file << data.str();
  octomap::OcTree oracle(1.0);
  std::istringstream again(file.str());
  ASSERT_TRUE(oracle.readBinary(again));
  expect_same(oracle, read_octomap(file.str(), "legacy.bt"));
}

TEST(Octomap, SingleVoxelsOutOfReachAreRefusedForThat) {
  octomap::OcTree tree(0.1);
  for (const float x : {0.05f, 0.15f, 0.25f})
    tree.updateNode(octomap::point3d(x, 0.05f, 0.05f), x < 0.1f);
  tree.toMaxLikelihood();
  std::ostringstream file;
  tree.writeBinary(file);
  VoxelPlacement placement;
  placement.motion.shift = {kMaxVoxelIndex + 1, 0, 0};
  try {
    read_octomap(file.str(), "far.bt", placement);
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("1e9 voxels"), std::string::npos) << error.what();
  }
}

TEST(Octomap, RealMapsEqualTheOracle) {
  std::size_t files = 0;
  const std::filesystem::path folder = RIDGEWAY_DATA_DIR;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".bt" && extension != ".ot") continue;
    const std::string bytes = read_whole(entry.path());
    if (!is_octomap(bytes)) continue;
    SCOPED_TRACE(entry.path().string());
    ++files;
    const OccupancyMap map = read_octomap(bytes, entry.path().string());
    if (extension == ".bt") {
      octomap::OcTree tree(1.0);
      ASSERT_TRUE(tree.readBinary(entry.path().string()));
      expect_same(tree, map);
      continue;
    }
    const std::unique_ptr<octomap::AbstractOcTree> tree(
        octomap::AbstractOcTree::read(entry.path().string()));
    const auto* plain = dynamic_cast<octomap::OcTree*>(tree.get());
    const auto* colour = dynamic_cast<octomap::ColorOcTree*>(tree.get());
    ASSERT_TRUE(plain != nullptr || colour != nullptr);
    if (plain != nullptr) expect_same(*plain, map);
    if (colour != nullptr) expect_same(*colour, map);
  }
  EXPECT_GT(files, 0u);
}

}  // namespace
}  // namespace ridgeway
