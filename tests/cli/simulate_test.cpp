// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>

#include "program.hpp"
#include "ridgeway/io/depth_sequence.hpp"
#include "ridgeway/io/ply_cloud.hpp"
#include "ridgeway/io/tsdf_file.hpp"
#include "ridgeway/io/world_file.hpp"

namespace ridgeway {
namespace {

class CliSimulate : public Program {
 protected:
  std::string house() { return std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml"; }
};

TEST_F(CliSimulate, WritesARecordingThatOpens) {
  const Outcome outcome = run({"simulate", house(), "-o", path("house"), "--frames", "5",
                               "--volume", "1,1,1,14,9,4", "--sigma", "0.1", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["frames"], 5);
  const DepthSequence sequence = open_sequence(path("house"));
  ASSERT_EQ(sequence.frames.size(), 5u);
  EXPECT_EQ(sequence.camera.fx, 160.0);
  for (const DepthFrame& frame : sequence.frames)
    EXPECT_GT(read_frame(sequence, frame).at(160, 120), 0.0f);
}

TEST_F(CliSimulate, SameSeedSameBytesForAnyNumberOfThreads) {
  const auto record = [&](const std::string& name, const std::string& threads,
                          const std::string& seed) {
    EXPECT_EQ(run({"simulate", house(), "-o", path(name), "--frames", "3", "--sigma", "0.1",
                   "--threads", threads, "--seed", seed})
                  .code,
              0);
    return read_whole(folder_ / name / "depth/000002.png") +
           read_whole(folder_ / name / "groundtruth.txt");
  };
  EXPECT_EQ(record("one", "1", "5"), record("two", "2", "5"));
  EXPECT_NE(record("three", "1", "5"), record("four", "1", "6"));
}

TEST_F(CliSimulate, WorldsFromSeeds) {
  for (const char* kind : {"maze", "hall"}) {
    const std::string file = std::string(kind) + ".yaml";
    EXPECT_EQ(run({"world", kind, "-o", path(file), "--seed", "3"}).code, 0);
    EXPECT_EQ(
        run({"simulate", path(file), "-o", path(kind), "--frames", "2", "--camera", "stereo"}).code,
        0);
    EXPECT_EQ(open_sequence(path(kind)).frames.size(), 2u);
  }
}

TEST_F(CliSimulate, RecordingToMapToRoadmap) {
  ASSERT_EQ(
      run({"simulate", house(), "-o", path("run"), "--frames", "60", "--volume", "1,1,1,14,9,4"})
          .code,
      0);
  const auto fuse = [&](const std::string& name, const std::string& threads) {
    const Outcome fused = run({"fuse", path("run"), "-o", path(name), "--clear-radius", "0.3",
                               "--threads", threads, "--json"});
    EXPECT_EQ(fused.code, 0) << fused.err;
    EXPECT_EQ(fused.json()["frames"], 60);
    return read_whole(folder_ / name);
  };
  EXPECT_EQ(fuse("one.ridge", "1"), fuse("two.ridge", "2"));
  const Json info = run({"info", path("one.ridge"), "--json"}).json();
  EXPECT_EQ(info["format"], "tsdf");
  EXPECT_GT(info["voxels"]["free"], 500000);  // of 750,000 in the house
  ASSERT_EQ(
      run({"build", path("one.ridge"), "-o", path("roadmap.ridge"), "--unknown", "ignore"}).code,
      0);
  // From the west room through two doorways to the north-east one.
  const Outcome planned =
      run({"plan", path("roadmap.ridge"), "--from", "1,1,1.5", "--to", "11,9,1.5", "--json"});
  EXPECT_EQ(planned.code, 0) << planned.out;
  EXPECT_EQ(run({"check", path("roadmap.ridge"), "--queries", "50"}).code, 0);
}

TEST_F(CliSimulate, SurfaceOfAFusedMap) {
  ASSERT_EQ(run({"simulate", house(), "-o", path("run"), "--frames", "8"}).code, 0);
  ASSERT_EQ(run({"fuse", path("run"), "-o", path("map.ridge"), "--voxel-size", "0.2"}).code, 0);
  const auto surface = [&](const std::string& name, const std::string& threads) {
    const Outcome outcome =
        run({"export", path("map.ridge"), "--mesh", path(name), "--threads", threads, "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["written"][0]["file"], path(name));
    return read_whole(folder_ / name);
  };
  const std::string bytes = surface("one.ply", "1");
  EXPECT_EQ(bytes, surface("two.ply", "2"));
  const PointCloud cloud = read_ply(bytes, "one.ply");
  const World world = load_world(house());
  EXPECT_GT(cloud.points.size(), 2000u);
  EXPECT_GT(cloud.ignored_faces, cloud.points.size());
  std::size_t near = 0;
  for (const Point& p : cloud.points)
    near += std::abs(surface_distance(world, p).distance) < 0.1 ? 1 : 0;
  EXPECT_GT(near, cloud.points.size() * 9 / 10);

  expect_refused({"export", rooms(), "--mesh", path("out.ply")}, {"ridgeway fuse"});
  expect_refused({"export", two_rooms(), "--mesh", path("out.ply")}, {"rooms.xyz"});
  expect_refused({"export", path("map.ridge"), "--mesh", path("out.obj")}, {"use .ply"});
  expect_refused({"export", path("map.ridge"), "--mesh", path("none/out.ply")}, {"none"});
  expect_refused({"export", path("map.ridge"), "--mesh", path("a.ply"), "-o", path("b.ply")},
                 {"--mesh"});
  expect_refused({"export", path("map.ridge"), "-o", path("graph.ply")}, {"not a roadmap"});
  save_tsdf({0.1, 0.4, {}, {}, {}}, "nothing", path("empty.ridge"));
  expect_refused({"export", path("empty.ridge"), "--mesh", path("out.ply")}, {"no surface"});
}

TEST_F(CliSimulate, FuseTakesRecordingsAsTheyAre) {
  ASSERT_EQ(run({"simulate", house(), "-o", path("run"), "--frames", "4"}).code, 0);
  std::filesystem::remove(folder_ / "run/depth/000001.png");
  write_whole(folder_ / "run/depth/000002.png", "no image");
  const Outcome fused = run({"fuse", path("run"), "-o", path("map.ridge"), "--json"});
  EXPECT_EQ(fused.code, 0);
  EXPECT_EQ(fused.json()["frames"], 2);
  EXPECT_EQ(fused.json()["unreadable"], 2);
  EXPECT_NE(fused.err.find("000001.png"), std::string::npos) << fused.err;
  expect_refused({"fuse", path("none"), "-o", path("out.ridge")}, {"none"});
  expect_refused({"fuse", path("run"), "-o", path("out.ridge"), "--voxel-size", "0"},
                 {"voxel_size"});
  expect_refused({"fuse", path("run"), "-o", path("out.ridge"), "--intrinsics", "1,2"}, {"fx,fy"});
  expect_refused({"fuse", path("run"), "-o", path("out.ridge"), "--intrinsics", "160,160,900,120"},
                 {"camera cx"});
  expect_refused({"plan", path("map.ridge"), "--from", "1,1,1", "--to", "2,1,1"},
                 {"map.ridge", "not a roadmap"});
}

TEST_F(CliSimulate, BadInputLeavesNothing) {
  write_whole(folder_ / "balls.yaml", "balls: []\n");
  write_whole(folder_ / "empty.yaml", "name: nothing\n");
  std::filesystem::create_directory(folder_ / "full");
  write_whole(folder_ / "full/file", "x");
  expect_refused({"simulate", path("none.yaml"), "-o", path("out")}, {"none.yaml"});
  expect_refused({"simulate", path("balls.yaml"), "-o", path("out")}, {"balls"});
  expect_refused({"simulate", path("empty.yaml"), "-o", path("out")}, {"world"});
  expect_refused({"simulate", house(), "-o", path("full")}, {"not empty"});
  expect_refused({"simulate", house(), "-o", path("out"), "--sigma", "-1"}, {"range_sigma"});
  expect_refused({"simulate", house(), "-o", path("out"), "--frames", "0"}, {"--frames"});
  expect_refused({"simulate", house(), "-o", path("out"), "--clearance", "9"}, {"clearance"});
  expect_refused({"simulate", house(), "-o", path("out"), "--volume", "1,1"}, {"--volume"});
  expect_refused({"world", "castle", "-o", path("out.yaml")}, {"castle"});
}

}  // namespace
}  // namespace ridgeway
