// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/distance_field.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "sensing/poses.hpp"
#include "support/lattice.hpp"

namespace ridgeway {
namespace {

/// Exact distances of a world in a box of voxels, truncated.
TsdfMap tsdf_of(const World& world, double voxel_size, const VoxelIndex& low,
                const VoxelIndex& high) {
  std::vector<BlockIndex> blocks;
  const BlockIndex first = block_of(low), last = block_of(high);
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) blocks.push_back({x, y, z});
  TsdfMap map;
  map.voxel_size = voxel_size;
  map.truncation = 4.0 * voxel_size;
  map.layout = BlockLayout(std::move(blocks));
  map.distance = VoxelField<float>(map.layout);
  map.weight = VoxelField<float>(map.layout, 1.0f);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const Point centre = centre_of(map.layout.index_of(id), voxel_size);
    map.distance[id] = static_cast<float>(
        std::clamp(surface_distance(world, centre).distance, -map.truncation, map.truncation));
  }
  return map;
}

struct Errors {
  double mean = 0.0, worst = 0.0;  // voxels
};

template <typename Distance>
Errors errors_of(const EsdfMap& esdf, const World& world, const Distance& distance) {
  Errors errors;
  std::size_t count = 0;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (esdf.state[id] != VoxelState::kFree) continue;
    const Point centre = testing::centre_in_world(esdf, id);
    const double off =
        std::abs(distance(id) - surface_distance(world, centre).distance) / esdf.voxel_size;
    errors.mean += off;
    errors.worst = std::max(errors.worst, off);
    ++count;
  }
  errors.mean /= static_cast<double>(count);
  return errors;
}

TEST(SubvoxelDistance, ASlantedWallAndABallAreFinerThanTheirVoxels) {
  World wall;
  wall.planes.push_back({Eigen::Vector3d(0.48, 0.6, 0.64), 0.037});
  World ball;
  ball.spheres.push_back({Point(0.21, -0.13, 0.07), 1.03});
  for (const World& world : {wall, ball}) {
    const TsdfMap tsdf = tsdf_of(world, 0.1, {-24, -24, -24}, {23, 23, 23});
    const EsdfMap esdf = compute_esdf(occupancy_of(tsdf), {.unknown = UnknownPolicy::kIgnore});
    const SubvoxelDistances fine = subvoxel_distances(esdf, tsdf);
    // A wall goes on beyond the map, where it has no sites: only what is near it is compared.
    const auto near = [&](VoxelId id) { return esdf.distance(id) < 0.5; };
    const auto exact = [&](VoxelId id) {
      return surface_distance(world, testing::centre_in_world(esdf, id)).distance;
    };
    const Errors coarse = errors_of(
        esdf, world, [&](VoxelId id) { return near(id) ? esdf.distance(id) : exact(id); });
    const Errors refined = errors_of(esdf, world, [&](VoxelId id) {
      return near(id) ? static_cast<double>(fine.distance[id]) : exact(id);
    });
    EXPECT_LT(refined.mean, 0.3 * coarse.mean);
    EXPECT_LT(refined.mean, 0.05);
  }
}

TEST(SubvoxelDistance, TheBoundHoldsAndObstaclesAreNotPositive) {
  World ball;
  ball.spheres.push_back({Point(0.02, 0.03, 0.01), 0.7});
  const TsdfMap tsdf = tsdf_of(ball, 0.1, {-16, -16, -16}, {15, 15, 15});
  const EsdfMap esdf = compute_esdf(occupancy_of(tsdf), {.unknown = UnknownPolicy::kIgnore});
  const SubvoxelDistances fine = subvoxel_distances(esdf, tsdf);
  EXPECT_GT(fine.error_bound, 0.0);
  EXPECT_LE(fine.error_bound, 0.2);
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    const double distance = static_cast<double>(fine.distance[id]);
    if (esdf.state[id] == VoxelState::kOccupied) {
      EXPECT_LE(distance, 0.0);
    } else {
      EXPECT_LE(std::abs(distance - esdf.distance(id)), fine.error_bound + 1e-6);
    }
  }
}

TEST(SubvoxelDistance, TheBoundIsFiniteWhereDistancesEnd) {
  World ball;
  ball.spheres.push_back({Point(0.02, 0.03, 0.01), 0.7});
  const TsdfMap tsdf = tsdf_of(ball, 0.1, {-16, -16, -16}, {15, 15, 15});
  const EsdfMap esdf =
      compute_esdf(occupancy_of(tsdf), {.unknown = UnknownPolicy::kIgnore, .max_distance = 0.5});
  const SubvoxelDistances fine = subvoxel_distances(esdf, tsdf);
  EXPECT_LE(fine.error_bound, 0.2);
  std::size_t without_site = 0;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (esdf.squared[id] == kNoSite) {
      EXPECT_TRUE(std::isinf(fine.distance[id]));
      ++without_site;
    }
  EXPECT_GT(without_site, 1000u);
}

TEST(SubvoxelDistance, FusedHouseIsThatOfTheExactDistance) {
  const World world = load_world(std::string(RIDGEWAY_SOURCE_DIR) + "/worlds/house.yaml");
  TsdfFusion fusion({.truncation = 0.4});
  const DepthSensor sensor;
  for (const Eigen::Isometry3d& pose :
       sample_poses(world, {.low = {1, 1, 1}, .high = {14, 10, 5}, .count = 200, .seed = 1}))
    fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
  const TsdfMap tsdf = fusion.map();
  const EsdfMap esdf = compute_esdf(occupancy_of(tsdf), {.unknown = UnknownPolicy::kIgnore});
  const SubvoxelDistances fine = subvoxel_distances(esdf, tsdf);
  EXPECT_LE(errors_of(esdf, world, [&](VoxelId id) { return esdf.distance(id); }).mean, 0.3);
  EXPECT_LE(
      errors_of(esdf, world, [&](VoxelId id) { return static_cast<double>(fine.distance[id]); })
          .mean,
      0.15);
}

TEST(SubvoxelDistance, BitsDoNotDependOnThreadsAndMapsMustFit) {
  World ball;
  ball.spheres.push_back({Point(0.02, 0.03, 0.01), 0.7});
  TsdfMap tsdf = tsdf_of(ball, 0.1, {-16, -16, -16}, {15, 15, 15});
  const EsdfMap esdf = compute_esdf(occupancy_of(tsdf), {});
  const auto refine = [&](int threads) {
    return with_threads(threads, [&] { return subvoxel_distances(esdf, tsdf); });
  };
  EXPECT_TRUE(refine(1).distance.values() == refine(2).distance.values());
  tsdf.voxel_size = 0.2;
  EXPECT_THROW(subvoxel_distances(esdf, tsdf), InputError);
}

}  // namespace
}  // namespace ridgeway
