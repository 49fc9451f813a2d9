// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What is thinner than a voxel does not vanish between the voxels' centres.
#include "mapping/thin_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/random.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "sensing/poses.hpp"
#include "sensing/random_worlds.hpp"
#include "sensing/world_generators.hpp"
#include "support/lattice.hpp"

namespace ridgeway {
namespace {

constexpr double kRoomVoxel = 0.2;
constexpr double kHalf = 3.0, kHeight = 3.0;  // of the room

World empty_room() {
  World world;
  for (const double side : {-1.0, 1.0}) {
    world.planes.push_back({side * Eigen::Vector3d::UnitX(), -kHalf});
    world.planes.push_back({side * Eigen::Vector3d::UnitY(), -kHalf});
  }
  world.planes.push_back({Eigen::Vector3d::UnitZ(), 0.0});
  world.planes.push_back({-Eigen::Vector3d::UnitZ(), -kHeight});
  return world;
}

/// From wall to wall along an axis, thinner than a voxel.
SolidBox random_pipe(Random& random, Eigen::Index axis) {
  SolidBox pipe;
  const double side = random.uniform(0.3, 0.95) * kRoomVoxel;
  pipe.centre = {random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(1.0, 2.0)};
  pipe.size = Eigen::Vector3d::Constant(side);
  pipe.size[axis] = 20.0;
  return pipe;
}

struct Seen {
  OccupancyMap map;
  std::vector<Point> surface;  ///< measured, of the pipe
};

Seen look_at(const World& world, const SolidBox* pipe, std::uint64_t seed, double sigma,
             Integrator integrator) {
  DepthSensor sensor;
  sensor.range_sigma = sigma;
  TsdfFusion fusion({.voxel_size = kRoomVoxel, .integrator = integrator});
  Seen seen;
  const PoseSampling within{
      .low = {-2.5, -2.5, 0.8}, .high = {2.5, 2.5, 2.2}, .count = 8, .seed = seed};
  for (const Eigen::Isometry3d& pose : sample_poses(world, within)) {
    const DepthImage image = render_depth(world, sensor, pose, seed++);
    fusion.integrate(image, sensor.camera, pose);
    if (pipe == nullptr) continue;
    for (int v = 0; v < image.height; v += 2)
      for (int u = 0; u < image.width; u += 2) {
        const Point p = pose * Point(image.at(u, v) * sensor.camera.ray(u, v));
        const Point out = (p - pipe->centre).cwiseAbs() - 0.5 * pipe->size;
        if (image.at(u, v) > 0.0f && out.maxCoeff() < 0.02) seen.surface.push_back(p);
      }
  }
  seen.map = occupancy_of(fusion.map());
  return seen;
}

/// Metres from a place to the nearest centre of a voxel that is not free.
double to_obstacle(const OccupancyMap& map, const Point& place) {
  const VoxelIndex middle = voxel_at(place, kRoomVoxel);
  double nearest = std::numeric_limits<double>::infinity();
  for (int z = -3; z <= 3; ++z)
    for (int y = -3; y <= 3; ++y)
      for (int x = -3; x <= 3; ++x) {
        const VoxelIndex v = middle + VoxelIndex{x, y, z};
        if (testing::state_at(map, v) != VoxelState::kFree)
          nearest = std::min(nearest, (centre_of(v, kRoomVoxel) - place).norm());
      }
  return nearest;
}

TEST(ThinSurfaces, APipeThinnerThanAVoxelIsNotFree) {
  // By signs alone a tenth of these places have nothing near them. What is left are pipes of a
  // third of a voxel that were hardly seen, near a wall that was.
  Random random(1);
  std::size_t looked_at = 0, missed = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const SolidBox pipe = random_pipe(random, static_cast<Eigen::Index>(seed % 3));
    World world = empty_room();
    world.boxes.push_back(pipe);
    const Integrator integrator = seed % 2 == 0 ? Integrator::kProjective : Integrator::kRayCasting;
    const Seen seen = look_at(world, &pipe, seed, 0.01, integrator);
    for (std::size_t i = 0; i < seen.surface.size(); i += 5) {
      missed += to_obstacle(seen.map, seen.surface[i]) > 2.0 * kRoomVoxel;
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 3000u);
  EXPECT_LE(300 * missed, looked_at) << missed << " of " << looked_at;
}

TEST(ThinSurfaces, WhatIsThickIsAsItsSignsHaveIt) {
  const World world = empty_room();
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Seen seen = look_at(world, nullptr, seed, 0.01, integrator);
      std::size_t known = 0, wrong = 0;
      for (VoxelId id = 0; id < seen.map.layout.voxel_count(); ++id) {
        if (seen.map.state[id] == VoxelState::kUnknown) continue;
        ++known;
        const Point centre = testing::centre_in_world(seen.map, id);
        const double room = surface_distance(world, centre).distance;
        wrong += seen.map.state[id] == VoxelState::kOccupied && room > 0.25 * kRoomVoxel;
      }
      EXPECT_GT(known, 5000u);
      EXPECT_LE(1000 * wrong, known) << seed;
    }
}

/// Sheets between the centres of voxels, and pipes: what knows the world loses them no more than
/// what has seen them. Walls gain nothing, thick things a voxel at corners.
TEST(ThinSurfaces, OfAWorldAreInItsMap) {
  Random random(3);
  const Box room{{-kHalf, -kHalf, 0.0}, {kHalf, kHalf, kHeight}};
  const OccupancyMap empty = occupancy_of(empty_room(), kRoomVoxel, room);
  for (VoxelId id = 0; id < empty.layout.voxel_count(); ++id)
    if (empty.state[id] == VoxelState::kOccupied)
      ASSERT_LE(surface_distance(empty_room(), testing::centre_in_world(empty, id)).distance, 0.0);
  World thick = empty_room();
  thick.boxes.push_back({{0.09, -0.27, 1.51}, {1.13, 0.97, 1.21}});
  const OccupancyMap solid = occupancy_of(thick, kRoomVoxel, room);
  std::size_t gained = 0;
  for (VoxelId id = 0; id < solid.layout.voxel_count(); ++id)
    gained += solid.state[id] == VoxelState::kOccupied &&
              surface_distance(thick, testing::centre_in_world(solid, id)).distance > 0.0;
  EXPECT_LE(gained, 8u);
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    World world = empty_room();
    SolidBox thin = random_pipe(random, static_cast<Eigen::Index>(seed % 3));
    if (seed % 2 == 1) thin.size[static_cast<Eigen::Index>((seed / 2 + 1) % 3)] = 20.0;
    world.boxes.push_back(thin);
    const OccupancyMap map = occupancy_of(world, kRoomVoxel, room);
    for (int i = 0; i < 200; ++i) {
      const Point inside = testing::random_vector(random, -0.5, 0.5).cwiseProduct(thin.size);
      const Point place = thin.centre + inside;
      if (((place - Point(0.0, 0.0, 0.5 * kHeight)).cwiseAbs().array() > 2.5).any()) continue;
      if (place.z() < 0.5 || place.z() > 2.5) continue;
      EXPECT_LE(to_obstacle(map, place), 1.25 * kRoomVoxel) << seed;
    }
  }
}

TEST(ThinSurfaces, AreThoseNearVoxelsThatHaveFreeOnesAcrossFacesAndEdges) {
  Random random(2);
  std::vector<BlockIndex> blocks;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x)
        if (x + y + z != 4) blocks.push_back({x, y, z});
  const BlockLayout layout(std::move(blocks));
  VoxelMask free(layout), near(layout);
  for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
    if (random.uniform(0.0, 1.0) > 0.01) free.set(id);
    if (random.uniform(0.0, 1.0) < 0.5 && free.test(id)) near.set(id);
  }
  std::size_t found = 0;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    const VoxelMask& all = free;
    const VoxelMask::Block thin =
        detail::thin_surfaces(near.block(slot), free.block(slot), [&](int direction) {
          const std::uint32_t n = layout.neighbour_block(slot, direction);
          return n == BlockLayout::kNoBlock ? nullptr : &all.block(n);
        });
    for (VoxelId local = 0; local < kBlockVoxels; ++local) {
      const VoxelId id = slot * kBlockVoxels + local;
      bool expected = near.test(id);
      for (int d = 0; d < 27; ++d) {
        if ((kCells18 >> d & 1) == 0) continue;
        const VoxelId n = layout.neighbour(id, d);
        expected &= n != kNoVoxel && free.test(n);
      }
      EXPECT_EQ((thin[local / 64] >> local % 64 & 1) != 0, expected) << id;
      found += expected;
    }
  }
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace ridgeway
