// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

TsdfMap random_tsdf(std::uint64_t seed, int blocks = 300) {
  Random random(seed);
  std::vector<BlockIndex> list;
  list.reserve(static_cast<std::size_t>(blocks));
  for (int i = 0; i < blocks; ++i)
    list.push_back({static_cast<int>(random.below(9)) - 4, static_cast<int>(random.below(9)) - 4,
                    static_cast<int>(random.below(9)) - 4});
  TsdfMap map{.voxel_size = 0.1,
              .origin = {465'000, -3, static_cast<int>(seed)},
              .truncation = 0.4,
              .layout = BlockLayout(std::move(list)),
              .distance = {},
              .weight = {}};
  map.distance = VoxelField<float>(map.layout);
  map.weight = VoxelField<float>(map.layout);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (random.below(3) == 0) continue;
    map.distance[id] = static_cast<float>(random.uniform(-0.4, 0.4));
    map.weight[id] = static_cast<float>(random.uniform(0.0, 100.0));
  }
  return map;
}

TEST(TsdfFile, GivesBackEveryBit) {
  const TemporaryFolder folder;
  for (const int blocks : {0, 1, 128, 700}) {
    const TsdfMap map = random_tsdf(1, blocks);
    save_tsdf(map, "a \"source\"", folder / "map.ridge");
    EXPECT_TRUE(is_tsdf_file(folder / "map.ridge"));
    const TsdfMap loaded = load_tsdf(folder / "map.ridge");
    EXPECT_EQ(loaded.voxel_size, map.voxel_size);
    EXPECT_EQ(loaded.origin, map.origin);
    EXPECT_EQ(loaded.truncation, map.truncation);
    EXPECT_TRUE(loaded.layout == map.layout);
    EXPECT_TRUE(loaded.distance.values() == map.distance.values());
    EXPECT_TRUE(loaded.weight.values() == map.weight.values());
  }
}

TEST(TsdfFile, IsAMapToBuildFrom) {
  const TemporaryFolder folder;
  const TsdfMap map = random_tsdf(2);
  save_tsdf(map, "", folder / "map.ridge");
  const OccupancyMap expected = occupancy_of(map), loaded = load_map(folder / "map.ridge", {});
  EXPECT_EQ(loaded.origin, expected.origin);
  EXPECT_TRUE(loaded.layout == expected.layout);
  EXPECT_TRUE(loaded.state.values() == expected.state.values());
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const VoxelState state = map.weight[id] <= 0.0f    ? VoxelState::kUnknown
                             : map.distance[id] > 0.0f ? VoxelState::kFree
                                                       : VoxelState::kOccupied;
    ASSERT_EQ(loaded.at(map.origin + map.layout.index_of(id) - loaded.origin), state);
  }
  EXPECT_THROW(load_roadmap(folder / "map.ridge"), InputError);
}

TEST(TsdfFile, DamageAndNonsenseAreRefused) {
  const TemporaryFolder folder;
  save_tsdf(random_tsdf(3, 40), "", folder / "good.ridge");
  const std::string bytes = read_whole(folder / "good.ridge");
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    std::string bad = bytes;
    if (i % 2 == 0)
      bad.resize(random.below(bad.size()));
    else
      bad[random.below(bad.size())] ^= static_cast<char>(1 << random.below(8));
    write_whole(folder / "bad.ridge", bad);
    EXPECT_THROW(load_tsdf(folder / "bad.ridge"), InputError) << i;
  }
  for (const float value : {0.5f, std::nanf(""), HUGE_VALF}) {
    TsdfMap map = random_tsdf(5, 3);
    map.distance[100] = value;
    save_tsdf(map, "", folder / "bad.ridge");
    EXPECT_THROW(load_tsdf(folder / "bad.ridge"), InputError);
    map = random_tsdf(5, 3);
    map.weight[100] = -std::abs(value);
    save_tsdf(map, "", folder / "bad.ridge");
    EXPECT_THROW(load_tsdf(folder / "bad.ridge"), InputError);
  }
  EXPECT_FALSE(is_tsdf_file(folder / "none.ridge"));
  EXPECT_THROW(load_tsdf(folder / "none.ridge"), InputError);
}

}  // namespace
}  // namespace ridgeway
