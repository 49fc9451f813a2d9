// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Recordings of real sensors, below the folder that the environment variable RIDGEWAY_MAPS names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <unordered_map>

#include "files/read_file.hpp"
#include "formats/xyz.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "support/lattice.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

/// The folder of a recording; empty where it is not here.
fs::path recording(const std::string& name) {
  const char* maps = std::getenv("RIDGEWAY_MAPS");
  if (maps == nullptr || !fs::is_directory(fs::path(maps) / name)) return {};
  return fs::path(maps) / name;
}

#define SKIP_WITHOUT(folder, name) \
  if ((folder).empty()) GTEST_SKIP() << "RIDGEWAY_MAPS names no folder with " name

double share_free(const OccupancyMap& map, const Point& centre, double radius) {
  const VoxelIndex low = voxel_at(centre - Point::Constant(radius), map.voxel_size);
  const VoxelIndex high = voxel_at(centre + Point::Constant(radius), map.voxel_size);
  double free = 0.0, all = 0.0;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        all += 1.0;
        free += testing::state_at(map, {x, y, z}) == VoxelState::kFree;
      }
  return free / all;
}

/// From the 1st to the 99th percentile of the free voxels along an axis: few rays leave a room.
double free_extent(const OccupancyMap& map, int axis) {
  std::vector<double> places;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] == VoxelState::kFree)
      places.push_back(centre_of(map.layout.index_of(id), map.voxel_size)[axis]);
  std::sort(places.begin(), places.end());
  return places[places.size() * 99 / 100] - places[places.size() / 100];
}

TEST(RealRecordings, ARoomByADepthCamera) {
  const fs::path folder = recording("rgbd_room");
  SKIP_WITHOUT(folder, "rgbd_room");
  const DepthSequence sequence = open_sequence(folder);
  EXPECT_EQ(sequence.without_pose, 0u);
  std::size_t seen = 0;
  const DepthImage image = read_frame(sequence, sequence.frames[sequence.frames.size() / 2]);
  for (const float depth : image.depth) seen += depth > 0.1f && depth < 10.0f;
  EXPECT_GT(seen, image.depth.size() / 2);
  TsdfFusion fusion({.voxel_size = 0.1});
  for (std::size_t i = 0; i < sequence.frames.size(); i += 4)
    fusion.integrate(read_frame(sequence, sequence.frames[i]), sequence.camera,
                     sequence.frames[i].T_world_camera);
  // About 4.7 x 2.4 x 2.4 m, in axes of its own.
  const OccupancyMap map = occupancy_of(fusion.map());
  EXPECT_NEAR(free_extent(map, 0), 4.5, 0.3);
  EXPECT_NEAR(free_extent(map, 1), 2.2, 0.3);
  EXPECT_NEAR(free_extent(map, 2), 2.7, 0.3);
  const VoxelCounts voxels = count_voxels(map);
  EXPECT_GT(voxels.free, 9000u);  // 9 to 27 m^3
  EXPECT_LT(voxels.free, 27000u);
  EXPECT_GT(voxels.occupied, 2000u);
  double free = 0.0;  // right before the camera there is nothing, most of the time
  for (const DepthFrame& frame : sequence.frames)
    free += share_free(map, frame.T_world_camera * Point(0.0, 0.0, 0.5), 0.1);
  EXPECT_GT(free / static_cast<double>(sequence.frames.size()), 0.9);
}

TEST(RealRecordings, ALaboratoryByALidar) {
  const fs::path folder = recording("lidar_lab");
  SKIP_WITHOUT(folder, "lidar_lab");
  const ScanSequence sequence = open_scans(folder);
  ASSERT_EQ(sequence.scans.size(), 3u);

  // The poses are those by which the merged cloud was made: a voxel of 0.05 m took one point.
  constexpr double kCell = 0.1;
  std::unordered_multimap<BlockIndex, Point, BlockHash> merged;
  const auto cell_of = [&](const Point& p) {
    const VoxelIndex v = voxel_at(p, kCell);
    return BlockIndex{v.x, v.y, v.z};
  };
  for (const Point& p :
       read_xyz(read_file(folder / "merged_registered.xyz"), "merged_registered.xyz").points)
    merged.emplace(cell_of(p), p);
  const auto is_near = [&](const Point& p) {
    const BlockIndex at = cell_of(p);
    for (int i = 0; i < 27; ++i) {
      const auto [first, last] =
          merged.equal_range({at.x + i % 3 - 1, at.y + i / 3 % 3 - 1, at.z + i / 9 - 1});
      if (std::any_of(first, last, [&](const auto& q) { return (q.second - p).norm() < kCell; }))
        return true;
    }
    return false;
  };
  TsdfFusion fusion({.max_range = 15.0, .integrator = Integrator::kRayCasting});
  for (const Scan& scan : sequence.scans) {
    const PointCloud cloud = read_scan(scan);
    EXPECT_GT(cloud.points.size(), 50000u);
    std::size_t far = 0;
    for (std::size_t i = 0; i < cloud.points.size(); i += 10)
      far += !is_near(scan.T_world_sensor * cloud.points[i]);
    EXPECT_EQ(far, 0u) << scan.cloud;
    fusion.integrate(cloud.points, scan.T_world_sensor);
  }

  // A hall of 20 x 7 m, of which the lidar sees what lies above it, to the ceiling at 3.4 m.
  const OccupancyMap map = occupancy_of(fusion.map());
  const Box box = known_bounds(map).value();
  const Eigen::Vector3d size = box.max - box.min;
  EXPECT_LT((size - Eigen::Vector3d(21.4, 16.8, 3.7)).cwiseAbs().maxCoeff(), 0.3);
  for (const Scan& scan : sequence.scans)
    EXPECT_EQ(share_free(map, scan.T_world_sensor * Point(0.0, 0.0, 1.5), 0.3), 1.0);
}

}  // namespace
}  // namespace ridgeway
