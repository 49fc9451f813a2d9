// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>

#include "formats/ply_cloud.hpp"
#include "program.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

namespace ridgeway {
namespace {

class CliSimulate : public Program {
 protected:
  std::string house() { return RIDGEWAY_WORLDS_DIR "/house.yaml"; }
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

TEST_F(CliSimulate, ThereIsOneHouse) {
  const std::vector<std::string> house = {"world", "house", "-o", path("house.yaml")};
  EXPECT_EQ(run(house).code, 0);
  std::vector<std::string> another = house;
  another.insert(another.end(), {"--seed", "9"});
  expect_refused(another, {"--seed", "one house"});
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
  EXPECT_GT(cloud.faces, cloud.points.size());
  std::size_t near = 0;
  for (const Point& p : cloud.points)
    near += std::abs(surface_distance(world, p).distance) < 0.1 ? 1 : 0;
  EXPECT_GT(near, cloud.points.size() * 9 / 10);

  expect_refused({"export", rooms(), "--mesh", path("out.ply")}, {"ridgeway fuse"});
  expect_refused({"export", two_rooms(), "--mesh", path("out.ply")}, {"rooms.xyz"});
  expect_refused({"export", path("map.ridge"), "--mesh", path("out.obj")}, {"use .ply"});
  expect_refused({"export", path("map.ridge"), "--mesh", path("none/out.ply")}, {"none"});
  for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
           {"--floors"}, {"--path", "none.json"}, {"--colour", "height"}, {"--what", "diagram"}})
    for (const std::vector<std::string>& output : std::vector<std::vector<std::string>>{
             {"--mesh", path("out.ply")}, {"-o", path("out.vxblx")}}) {
      std::vector<std::string> words = {"export", path("map.ridge")};
      words.insert(words.end(), output.begin(), output.end());
      words.insert(words.end(), option.begin(), option.end());
      expect_refused(words, {option.front(), "leave it out"});
    }
  expect_refused({"export", path("map.ridge"), "--mesh", path("a.ply"), "-o", path("b.ply")},
                 {"--mesh"});
  expect_refused({"export", path("map.ridge"), "-o", path("graph.ply")},
                 {"no format that a fused map can be written in", "--mesh"});
  save_tsdf({0.1, {}, 0.4, {}, {}, {}}, "nothing", path("empty.ridge"));
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
                 {"--voxel-size"});
  expect_refused({"fuse", path("run"), "-o", path("out.ridge"), "--intrinsics", "1,2"}, {"fx,fy"});
  expect_refused({"fuse", path("run"), "-o", path("out.ridge"), "--intrinsics", "160,160,900,120"},
                 {"camera cx"});
  expect_refused({"plan", path("map.ridge"), "--from", "1,1,1", "--to", "2,1,1"},
                 {"map.ridge", "not a roadmap"});
}

TEST_F(CliSimulate, FuseAndLiveTellWhereTheWorldOfThePosesLiesOnItsSide) {
  ASSERT_EQ(run({"simulate", house(), "-o", path("run"), "--frames", "2", "--width", "40"}).code,
            0);
  const Outcome upright = run({"fuse", path("run"), "-o", path("map.ridge")});
  EXPECT_EQ(upright.err.find("upright"), std::string::npos) << upright.err;
  std::istringstream poses(read_whole(folder_ / "run/groundtruth.txt"));
  std::string line, turned;
  while (
      std::getline(poses, line)) {  // time, place, quaternion: that of the first image's own axes
    std::istringstream row(line);
    std::string time, x, y, z;
    if (line.starts_with("#") || !(row >> time >> x >> y >> z)) continue;
    for (const std::string& word : {time, x, y, z}) turned.append(word).append(" ");
    turned += "0 0 0 1\n";
  }
  write_whole(folder_ / "run/groundtruth.txt", turned);
  for (const char* command : {"fuse", "live"}) {
    const Outcome lying = run({command, path("run"), "-o", path("map.ridge")});
    EXPECT_NE(lying.err.find("upright along 0,-1,0"), std::string::npos) << lying.err;
    EXPECT_NE(lying.err.find("--transform"), std::string::npos) << lying.err;
  }
}

TEST_F(CliSimulate, WidthOfTheImages) {
  ASSERT_EQ(run({"simulate", house(), "-o", path("run"), "--frames", "1", "--width", "81"}).code,
            0);
  const PinholeCamera camera = open_sequence(path("run")).camera;
  EXPECT_EQ(camera.width, 81);
  EXPECT_EQ(camera.height, 60);
  EXPECT_EQ(camera.fx, 40.5);
  EXPECT_EQ(camera.cx, 40.0);
  EXPECT_EQ(camera.cy, 29.5);
}

TEST_F(CliSimulate, FolderIsWhereItWasAskedFor) {
  std::filesystem::create_directories(folder_ / "empty/real");
  std::filesystem::create_directory_symlink(folder_ / "empty/real", folder_ / "link");
  for (const char* name :
       {"new", "new/../other", "slash/", "deep/in/new", "empty/real/.", "link"}) {
    ASSERT_EQ(run({"simulate", house(), "-o", path(name), "--frames", "1", "--width", "8"}).code, 0)
        << name;
    EXPECT_TRUE(std::filesystem::exists(folder_ / name / "depth/000000.png")) << name;
    std::filesystem::remove_all(folder_ / "empty/real/depth");
    for (const char* file : {"depth.txt", "groundtruth.txt", "camera-intrinsics.txt"})
      std::filesystem::remove(folder_ / "empty/real" / file);
  }
}

TEST_F(CliSimulate, FuseTakesScansByWhatTheFolderHolds) {
  std::filesystem::create_directory(folder_ / "scans");
  std::string cloud;  // walls of a cube of 4 m around the sensor
  for (int a = -20; a <= 20; ++a)
    for (int b = -20; b <= 20; ++b)
      for (const int side : {-20, 20}) {
        const std::string u = std::to_string(a) + "e-1 ", v = std::to_string(b) + "e-1 ",
                          w = std::to_string(side) + "e-1 ";
        cloud.append(u).append(v).append(w).append("\n");
        cloud.append(u).append(w).append(v).append("\n");
        cloud.append(w).append(u).append(v).append("\n");
      }
  write_whole(folder_ / "scans/cube.xyz", cloud + "nan 0 0\n0 0 99\n");
  write_whole(folder_ / "scans/poses.txt",
              "cube.xyz 10 0 0 0 0 0 1\ncube.xyz.old nan 0 0 0 0 0 1\n");
  const Outcome fused = run({"fuse", path("scans"), "-o", path("map.ridge"), "--json"});
  ASSERT_EQ(fused.code, 0) << fused.err;
  const Json json = fused.json();
  EXPECT_EQ(json["layout"], "scans");
  EXPECT_EQ(json["frames"], 1);
  EXPECT_EQ(json["without_pose"], 1);
  EXPECT_EQ(json["points"]["fused"], 6 * 41 * 41);
  EXPECT_EQ(json["points"]["out_of_range"], 1);
  EXPECT_EQ(json["points"]["beyond"], 1);
  EXPECT_EQ(json["points"]["not_finite"], 1);
  EXPECT_NEAR(json["voxels"]["free"].get<double>(), 64000.0, 4000.0);
  const Json info = run({"info", path("map.ridge"), "--json"}).json();
  EXPECT_NEAR(info["bounds"]["min"][0].get<double>(), 7.8, 0.31);
  EXPECT_NEAR(info["bounds"]["max"][0].get<double>(), 12.2, 0.31);

  expect_refused({"fuse", path("scans"), "-o", path("no.ridge"), "--integrator", "projective"},
                 {"--integrator projective"});
  expect_refused({"fuse", path("scans"), "-o", path("no.ridge"), "--intrinsics", "1,1,1,1"},
                 {"--intrinsics"});
  expect_refused({"fuse", path("scans"), "-o", path("scans/cube.xyz")}, {"part of the recording"});
  std::filesystem::create_directory(folder_ / "nothing");
  expect_refused({"fuse", path("nothing"), "-o", path("no.ridge")},
                 {"holds no recording", "depth.txt", "frame-*.depth.png", "poses.txt"});
  write_whole(folder_ / "nothing/pose.txt", "0 0 0 0 0 0 1\n");
  expect_refused({"fuse", path("nothing"), "-o", path("no.ridge")},
                 {"pose.txt", "name no images", "trajectory.log"});
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
  expect_refused({"simulate", house(), "-o", path("out"), "--sigma", "-1"}, {"--sigma"});
  expect_refused({"simulate", house(), "-o", path("out"), "--frames", "0"}, {"--frames"});
  expect_refused({"simulate", house(), "-o", path("out"), "--clearance", "9"}, {"clearance"});
  expect_refused({"simulate", house(), "-o", path("out"), "--volume", "1,1"}, {"--volume"});
  expect_refused({"simulate", house(), "-o", path("out"), "--volume", "-1e308,0,0,1e308,1,1"},
                 {"volume"});
  expect_refused({"simulate", house(), "-o", path("out"), "--volume", "50,50,50,51,51,51",
                  "--frames", "1000000"},
                 {"hardly any place"});
  expect_refused({"simulate", house(), "-o", path("out"), "--width", "0"}, {"--width"});
  expect_refused({"simulate", house(), "-o", path("out"), "--max-range", "25"},
                 {"--max-range", "13.1"});
  expect_refused({"simulate", house(), "-o", ""}, {"--output"});
  expect_refused({"simulate", house(), "-o", "/"}, {"new folder"});
  expect_refused({"world", "castle", "-o", path("out.yaml")}, {"castle"});
}

}  // namespace
}  // namespace ridgeway
