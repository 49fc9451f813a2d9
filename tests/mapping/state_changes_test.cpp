// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What fusion says has changed is what has changed: nothing more, nothing less, scan after scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "sensing/poses.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway {
namespace {

using States = std::map<VoxelIndex, VoxelState>;  // of the lattice, the known ones

States states_of(const TsdfFusion& fusion) {
  const OccupancyMap map = occupancy_of(fusion.map());
  States states;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] != VoxelState::kUnknown)
      states[map.origin + map.layout.index_of(id)] = map.state[id];
  return states;
}

DepthSensor small_sensor() {
  DepthSensor sensor;
  sensor.camera = {.width = 80, .height = 60, .fx = 40.0, .fy = 40.0, .cx = 39.5, .cy = 29.5};
  sensor.range_sigma = 0.03;
  return sensor;
}

std::vector<Eigen::Isometry3d> flight() {
  return sample_poses(make_house(), {.low = {1, 1, 1}, .high = {14, 10, 4}, .count = 6, .seed = 3});
}

void expect_told_after_every_scan(const FusionConfig& config) {
  const World world = make_house();
  const DepthSensor sensor = small_sensor();
  TsdfFusion fusion(config);
  States told;
  std::uint64_t seed = 0;
  for (const Eigen::Isometry3d& pose : flight()) {
    fusion.integrate(render_depth(world, sensor, pose, seed++), sensor.camera, pose);
    for (const VoxelChange& change : fusion.find_changes()) {
      const auto [place, is_new] = told.try_emplace(change.voxel, VoxelState::kUnknown);
      EXPECT_NE(place->second, change.state);
      place->second = change.state;
    }
    EXPECT_TRUE(told == states_of(fusion));
    fusion.accept_changes();
    EXPECT_TRUE(fusion.find_changes().empty());
  }
  EXPECT_GT(told.size(), 10000u);
}

TEST(StateChanges, AreWhatHasChangedByEitherIntegrator) {
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting})
    expect_told_after_every_scan({.voxel_size = 0.2, .integrator = integrator});
}

TEST(StateChanges, CountWhereTheRobotHasBeen) {
  expect_told_after_every_scan({.voxel_size = 0.2, .clear_radius = 0.7});
}

TEST(StateChanges, OfMeasurementsThatAreTakenBackAreNone) {
  const World world = make_house();
  const DepthSensor sensor = small_sensor();
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting}) {
    const FusionConfig config{
        .voxel_size = 0.2, .clear_radius = 0.7, .integrator = integrator, .can_undo = true};
    TsdfFusion fusion(config), plain(config);
    for (const Eigen::Isometry3d& pose : flight()) {
      const DepthImage image = render_depth(world, sensor, pose, 1);
      fusion.integrate(image, sensor.camera, pose);
      EXPECT_FALSE(fusion.find_changes().empty());
      fusion.undo();
      fusion.undo();  // does nothing
      EXPECT_TRUE(fusion.find_changes().empty());
      EXPECT_TRUE(states_of(fusion) == states_of(plain));
      fusion.integrate(image, sensor.camera, pose);
      plain.integrate(image, sensor.camera, pose);
      EXPECT_TRUE(fusion.find_changes() == plain.find_changes());
      fusion.accept_changes();
      plain.accept_changes();
      // What shows nothing overwrites nothing.
      fusion.integrate(DepthImage{80, 60, std::vector<float>(80 * 60)}, sensor.camera, pose);
      fusion.undo();
      EXPECT_TRUE(fusion.map().distance.values() == plain.map().distance.values());
      EXPECT_TRUE(fusion.map().weight.values() == plain.map().weight.values());
    }
  }
}

/// A wall 4 m ahead and, while it is there, a box before it.
DepthImage wall_and_box(const DepthSensor& sensor, bool has_box, std::uint64_t seed) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.0});
  if (has_box) world.boxes.push_back({{2.5, 0.0, 0.0}, {0.6, 1.0, 1.0}});
  return render_depth(world, sensor, level_pose({0.0, 0.0, 0.0}, 0.0), seed);
}

/// Scans until a voxel's state is another, after it was seen as often; -1: not in as many.
int scans_until_changed(const FusionConfig& config, bool box_goes, const Point& place) {
  constexpr int kScans = 30;
  const DepthSensor sensor = small_sensor();
  const Eigen::Isometry3d pose = level_pose({0.0, 0.0, 0.0}, 0.0);
  TsdfFusion fusion(config);
  const auto has_changed = [&](bool has_box, int scan) {
    const auto seed = static_cast<std::uint64_t>(scan);
    fusion.integrate(wall_and_box(sensor, has_box, seed), sensor.camera, pose);
    const std::vector<VoxelChange> changes = fusion.find_changes();
    fusion.accept_changes();
    return std::any_of(changes.begin(), changes.end(), [&](const VoxelChange& change) {
      return change.voxel == voxel_at(place, config.voxel_size);
    });
  };
  EXPECT_TRUE(has_changed(box_goes, 0));
  for (int scan = 1; scan < kScans; ++scan) has_changed(box_goes, scan);
  for (int scan = 1; scan <= kScans; ++scan)
    if (has_changed(!box_goes, kScans + scan)) return scan;
  return -1;
}

TEST(StateChanges, ThatContradictAreTakenAfterAsManyScansAsAsked) {
  // Just behind the face of the box, and just before it, where its face had long been free.
  const Point behind(2.3, 0.05, 0.05);
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting}) {
    FusionConfig config{.integrator = integrator};
    EXPECT_EQ(scans_until_changed(config, true, behind), -1);
    config.forget_after = 8;
    for (const bool box_goes : {true, false}) {
      const int scans = scans_until_changed(config, box_goes, behind);
      EXPECT_GE(scans, 1) << box_goes;
      EXPECT_LE(scans, 8) << box_goes;
    }
  }
}

TEST(StateChanges, ComeInTheOrderOfBlocksOnAnyNumberOfThreads) {
  const World world = make_house();
  const DepthSensor sensor = small_sensor();
  const auto changes = [&](int threads) {
    return with_threads(threads, [&] {
      TsdfFusion fusion({.voxel_size = 0.2});
      std::vector<VoxelChange> all;
      for (const Eigen::Isometry3d& pose : flight()) {
        fusion.integrate(render_depth(world, sensor, pose, 1), sensor.camera, pose);
        const std::vector<VoxelChange> some = fusion.find_changes();
        fusion.accept_changes();
        const VoxelIndex origin = voxel_at(flight().front().translation(), 0.2);
        const auto key = [&](const VoxelChange& c) {
          return std::pair(block_of(c.voxel - origin), local_of(c.voxel - origin));
        };
        EXPECT_TRUE(std::is_sorted(some.begin(), some.end(),
                                   [&](const auto& a, const auto& b) { return key(a) < key(b); }));
        all.insert(all.end(), some.begin(), some.end());
      }
      return all;
    });
  };
  EXPECT_TRUE(changes(1) == changes(2));
}

}  // namespace
}  // namespace ridgeway
