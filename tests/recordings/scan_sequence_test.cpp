// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/recordings/scan_sequence.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/number_text.hpp"
#include "common/random.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "support/lattice.hpp"
#include "support/map_errors.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

using Json = nlohmann::json;

std::string text_of(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  std::string text;
  for (const double value : {pose.translation().x(), pose.translation().y(), pose.translation().z(),
                             q.x(), q.y(), q.z(), q.w()})
    text.append(" ").append(number_text(value));
  return text + "\n";
}

Eigen::Isometry3d random_pose(const Point& place, Random& random) {
  Eigen::Isometry3d pose(
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized());
  pose.translation() = place;
  return pose;
}

/// A folder of clouds of one point each.
class ScanFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    write_whole(folder_ / "a.xyz", "1 2 3\n");
    write_whole(folder_ / "b.pcd",
                "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
                "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n4 5 6\nnan nan nan\n");
    write_whole(folder_ / "c.ply",
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                "property float z\nend_header\n7 8 9\n");
  }
  /// What opening says where poses.txt holds a text.
  std::string with_poses(const std::string& text) {
    write_whole(folder_ / "poses.txt", text);
    return refused();
  }
  std::string refused() {
    return refusal([&] { open_scans(folder_.path()); });
  }
  static void expect_in(const std::string& message, const std::vector<std::string>& words) {
    for (const std::string& word : words)
      EXPECT_NE(message.find(word), std::string::npos) << word << " is not in: " << message;
  }
  TemporaryFolder folder_;
};

TEST_F(ScanFolder, WhatIsWrittenIsReadAgain) {
  Random random(3);
  std::vector<std::pair<std::vector<Point>, Eigen::Isometry3d>> scans;
  {
    ScanWriter writer(folder_ / "run");
    for (int i = 0; i < 3; ++i) {
      std::vector<Point> points(static_cast<std::size_t>(10 * i + 1));
      for (Point& point : points)
        point =
            Eigen::Vector3f(Point(random.normal(), random.normal(), random.normal()).cast<float>())
                .cast<double>();
      const Eigen::Isometry3d pose = random_pose({1.0 * i, 2.0, 3.0}, random);
      writer.add(points, pose);
      scans.emplace_back(points, pose);
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
    writer.finish();
  }
  const ScanSequence read = open_scans(folder_ / "run");
  ASSERT_EQ(read.scans.size(), scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(read_scan(read.scans[i]).points, scans[i].first);
    EXPECT_TRUE(read.scans[i].T_world_sensor.isApprox(scans[i].second, 1e-12));
  }
  EXPECT_THROW(ScanWriter(folder_ / "run"), InputError);  // is not empty
}

TEST_F(ScanFolder, CloudsOfAllFormatsComeWithTheirPoses) {
  EXPECT_FALSE(holds_scans(folder_.path()));
  expect_in(refused(), {"holds no recording of scans", "poses.txt"});
  write_whole(folder_ / "poses.txt",
              "\xef\xbb\xbf# cloud tx ty tz qx qy qz qw\r\n"
              "c.ply 1 2 3 0 0 0.6 0.8 # turned\r\n\r\n"
              "a.xyz nan 0 0 0 0 0 1\r\n"
              "b.pcd,-1,+0,1e-1,0,0,0,1.001\r\n");
  EXPECT_TRUE(holds_scans(folder_.path()));
  const ScanSequence sequence = open_scans(folder_.path());
  EXPECT_EQ(sequence.layout, "scans");
  EXPECT_EQ(sequence.without_pose, 1u);
  ASSERT_EQ(sequence.scans.size(), 2u);
  const Eigen::Isometry3d& turned = sequence.scans[0].T_world_sensor;
  // A quarter turn and a bit: cos = 0.28, sin = 0.96.
  EXPECT_LT((turned * Point(1, 0, 0) - Point(1.28, 2.96, 3)).norm(), 1e-12);
  EXPECT_EQ(read_scan(sequence.scans[0]).points, std::vector<Point>{Point(7, 8, 9)});
  const PointCloud cloud = read_scan(sequence.scans[1]);
  EXPECT_EQ(cloud.points, std::vector<Point>{Point(4, 5, 6)});
  EXPECT_EQ(cloud.skipped, 1u);
  EXPECT_LT((sequence.scans[1].T_world_sensor * Point(0, 0, 0) - Point(-1, 0, 0.1)).norm(), 1e-12);
  EXPECT_TRUE(sequence.scans[1].T_world_sensor.linear().isIdentity(1e-12));
}

TEST_F(ScanFolder, MistakesAreNamedWithFileAndLine) {
  expect_in(with_poses("# none\n"), {folder_.path().string(), "names no scan"});
  expect_in(with_poses(""), {"poses.txt", "is empty"});
  expect_in(with_poses("a.xyz 0 0 0 0 0 0 nan\n"), {"no scan with a pose"});
  expect_in(with_poses("\na.xyz 0 0 0 0 0 1\n"), {"poses.txt line 2", "7 entries"});
  expect_in(with_poses("a.xyz 0 0 0 0 0 0 1 5\n"), {"poses.txt line 1", "9 entries"});
  expect_in(with_poses("a.xyz 0 0 zero 0 0 0 1\n"), {"poses.txt line 1", "'zero'"});
  expect_in(with_poses("d.xyz 0 0 0 0 0 0 1\na.xyz 0 0 0 0 0 0 1\ne.xyz 0 0 0 0 0 0 1\n"),
            {"poses.txt", "missing: d.xyz, e.xyz ("});
  std::string many;
  for (int i = 0; i < 9; ++i) many += std::to_string(i) + ".xyz 0 0 0 0 0 0 1\n";
  expect_in(with_poses(many), {"0.xyz, 1.xyz, 2.xyz, 3.xyz, 4.xyz and 4 more"});
  expect_in(with_poses("a.xyz 0 0 0 0 0 0 1\na.xyz 1 0 0 0 0 0 1\n"),
            {"poses.txt line 2", "a.xyz again"});
  expect_in(with_poses("a.xyz 0 0 0 0 0 1 1\n"), {"poses.txt line 1", "quaternion of length 1.4"});
  expect_in(with_poses("a.xyz 0 0 0 0 0 0 1e300\n"), {"poses.txt line 1", "quaternion"});
  write_whole(folder_ / "a.xyz", "1 2\n");
  write_whole(folder_ / "poses.txt", "a.xyz 0 0 0 0 0 0 1\n");
  const ScanSequence sequence = open_scans(folder_.path());
  expect_in(refusal([&] { read_scan(sequence.scans[0]); }), {"a.xyz", "line 1"});
  write_whole(folder_ / "a.xyz",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n1 2 3\n3 0 0 0\n");
  expect_in(refusal([&] { read_scan(sequence.scans[0]); }), {"a.xyz", "is a mesh of 1 faces"});
}

TEST_F(ScanFolder, RegistrationsMoveEachScanToTheReference) {
  std::filesystem::copy_file(folder_ / "a.xyz", folder_ / "scan_1_raw.xyz");
  std::filesystem::copy_file(folder_ / "a.xyz", folder_ / "scan_2_raw.xyz");
  const Json rows = {{0, -1, 0, 4}, {1, 0, 0, 5}, {0, 0, 1, 6}, {0, 0, 0, 1}};
  const Json good = {
      {"reference", "scan_1"},
      {"accepted", true},
      {"scans",
       {{"scan_1", {{"points", 1}}},
        {"scan_2", {{"registration_to_scan_1", {{"transform_source_to_scan1", rows}}}}}}}};
  write_whole(folder_ / "registration_metrics.json", good.dump());
  const ScanSequence sequence = open_scans(folder_.path());
  EXPECT_EQ(sequence.layout, "registration");
  ASSERT_EQ(sequence.scans.size(), 2u);
  EXPECT_TRUE(sequence.scans[0].T_world_sensor.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_LT((sequence.scans[1].T_world_sensor * Point(1, 2, 3) - Point(2, 6, 9)).norm(), 1e-9);

  const auto with = [&](const std::string& path, const Json& value) {
    Json bad = good;
    if (value.is_null())
      bad[Json::json_pointer(path).parent_pointer()].erase(Json::json_pointer(path).back());
    else
      bad[Json::json_pointer(path)] = value;
    write_whole(folder_ / "registration_metrics.json", bad.dump());
    return refused();
  };
  const std::string key = "scans.scan_2.registration_to_scan_1";
  const std::string at = "/scans/scan_2/registration_to_scan_1",
                    matrix = at + "/transform_source_to_scan1";
  expect_in(with("/reference", nullptr), {"registration_metrics.json reference", "missing"});
  expect_in(with("/reference", 1), {"reference", "no text"});
  expect_in(with("/reference", "scan_7"), {"reference", "names no scan"});
  expect_in(with("/accepted", false), {"accepted"});
  expect_in(with("/scans", Json::array({1})), {"scans"});
  expect_in(with("/scans", Json::object()), {"reference", "names no scan"});
  expect_in(with("/scans/scan_3", good["scans"]["scan_2"]), {"missing: scan_3_raw.xyz"});
  expect_in(with("/scans/scan_2", 5), {"scans.scan_2", "no JSON object"});
  expect_in(with(at, nullptr), {key, "missing"});
  expect_in(with(at, "none"), {key, "no JSON object"});
  expect_in(with(matrix, nullptr), {key + ".transform_source_to_scan1", "missing"});
  expect_in(with(matrix, Json::array({1, 2})), {key, "4 x 4"});
  expect_in(with(matrix + "/2", Json::array({0, 0, 1})), {key, "4 x 4"});
  expect_in(with(matrix + "/2/2", "one"), {key, "no number"});
  expect_in(with(matrix + "/2/2", 2), {key, "no rotation"});
  expect_in(with(matrix + "/2/2", -1), {key, "no rotation"});
  expect_in(with(matrix + "/3/0", 1), {key, "no rotation"});
  for (const char* text : {"{", "[]", "5", "{\"reference\":\"\xff\"}"}) {
    write_whole(folder_ / "registration_metrics.json", text);
    expect_in(refused(), {"registration_metrics.json"});
  }
  write_whole(folder_ / "registration_metrics.json", std::string(100000, '['));
  expect_in(refused(), {"no JSON object"});
}

TEST_F(ScanFolder, FusedScansOfAHouseAreThatOfTheExactDistance) {
  const World world = load_world(std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml");
  Random random(5);
  std::string poses;
  const std::vector<Point> places = {
      {1.5, 1.5, 1.2}, {5, 3, 2}, {11, 3.5, 1}, {4, 9, 1.5}, {13, 4, 3}};
  for (std::size_t scan = 0; scan < places.size(); ++scan) {
    const Eigen::Isometry3d pose = random_pose(places[scan], random);
    std::string cloud;
    for (int i = 0; i < 30000; ++i) {
      const Eigen::Vector3d ray =
          Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const Point end = cast_ray(world, places[scan], pose.linear() * ray) * ray;
      cloud += number_text(static_cast<float>(end.x())) + " " +
               number_text(static_cast<float>(end.y())) + " " +
               number_text(static_cast<float>(end.z())) + "\n";
    }
    const std::string name = std::to_string(scan) + ".xyz";
    write_whole(folder_ / name, cloud);
    poses += name + text_of(pose);
  }
  write_whole(folder_ / "poses.txt", poses);
  TsdfFusion fusion({.max_range = 20.0, .integrator = Integrator::kRayCasting});
  for (const Scan& scan : open_scans(folder_.path()).scans)
    fusion.integrate(read_scan(scan).points, scan.T_world_sensor);
  const MapErrors errors = errors_of(fusion.map(), world);
  EXPECT_GT(errors.voxels, 100000u);
  EXPECT_LT(errors.mean, 0.7);  // rays alone, without normals: too far where seen at a slant
  const OccupancyMap map = occupancy_of(fusion.map());
  std::size_t free = 0, wrong = 0;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (map.state[id] != VoxelState::kFree) continue;
    ++free;
    const Point centre = testing::centre_in_world(map, id);
    wrong += surface_distance(world, centre).distance < -0.5 * map.voxel_size;
  }
  EXPECT_GT(free, 150000u);
  EXPECT_LT(wrong, free / 1000);
}

}  // namespace
}  // namespace ridgeway
