// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "program.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway {
namespace {

const std::string kRecording = std::string(RIDGEWAY_DATA_DIR) + "/house_depth";

class CliLive : public Program {};

TEST_F(CliLive, ReplaysARecordingThatABatchBuildVerifies) {
  const Outcome outcome = run({"live", kRecording, "-o", path("live.ridge"), "--voxel-size", "0.2",
                               "--min-clearance", "0.3", "--max-distance", "3", "--verify", "10",
                               "--queries", "200", "--csv", path("live.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = outcome.json();
  const auto frames = json["scans"].get<std::size_t>();
  EXPECT_GT(frames, 10u);
  EXPECT_GE(json["verified"].get<std::size_t>(), frames / 10 - 1);
  EXPECT_GT(json["vertices"].get<std::size_t>(), 10u);
  EXPECT_EQ(json["identical"], json["verified"]);
  EXPECT_EQ(json["queries"], 200);
  EXPECT_EQ(json["query_violations"], 0);
  for (const char* stage : {"fusion", "esdf", "skeleton", "graph"})
    EXPECT_GT(json["stage_milliseconds"][stage]["median"], 0.0) << stage;
  for (const char* share : {"median", "p95", "p99"})
    EXPECT_GT(json["milliseconds"][share], 0.0) << share;
  const std::string csv = read_whole(folder_ / "live.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), frames + 1);
  EXPECT_EQ(run({"check", path("live.ridge"), "--queries", "20"}).code, 0);
}

/// A recording without frames yet.
void begin_recording(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "depth");
  std::filesystem::copy_file(std::filesystem::path(kRecording) / "camera-intrinsics.txt",
                             folder / "camera-intrinsics.txt");
}

/// Appends what a recording's text file has of frames, and copies their images.
void add_frames(const std::filesystem::path& to, std::size_t first, std::size_t last) {
  namespace fs = std::filesystem;
  for (const char* list : {"depth.txt", "groundtruth.txt"}) {
    std::ifstream all(fs::path(kRecording) / list);
    std::ofstream some(to / list, std::ios::app);
    std::size_t frame = 0;
    for (std::string line; std::getline(all, line);) {
      const bool is_comment = line.starts_with('#');
      if (is_comment ? first == 0 : frame >= first && frame < last) some << line << "\n";
      if (is_comment || list[0] != 'd') {
        frame += !is_comment;
        continue;
      }
      const std::string image = line.substr(line.find(' ') + 1);
      if (frame >= first && frame < last) fs::copy_file(fs::path(kRecording) / image, to / image);
      ++frame;
    }
  }
}

TEST_F(CliLive, FollowsAFolderThatIsStillWrittenTo) {
  namespace fs = std::filesystem;
  const fs::path growing = folder_ / "growing";
  begin_recording(growing);
  std::thread writer([&] {
    for (std::size_t first = 0; first < 12; first += 4) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      add_frames(growing, first, first + 4);
    }
  });
  const std::vector<std::string> how = {"--voxel-size",   "0.2", "--min-clearance", "0.3",
                                        "--max-distance", "2",   "--window",        "4",
                                        "--json"};
  std::vector<std::string> follow = {
      "live", growing.string(), "-o",        path("followed.ridge"), "--follow",
      "60",   "--until",        "000011.png"};
  follow.insert(follow.end(), how.begin(), how.end());
  const Outcome followed = run(follow);
  writer.join();
  ASSERT_EQ(followed.code, 0) << followed.err;
  EXPECT_EQ(followed.json()["scans"].get<int>(), 12);
  std::vector<std::string> again = {"live", growing.string(), "-o", path("whole.ridge")};
  again.insert(again.end(), how.begin(), how.end());
  const Outcome whole = run(again);
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_TRUE(read_whole(folder_ / "followed.ridge") == read_whole(folder_ / "whole.ridge"));
  // What never comes is not waited for any longer than was said.
  EXPECT_EQ(run({"live", path("nowhere"), "-o", path("live.ridge"), "--follow", "0.3"}).code, 1);
}

TEST_F(CliLive, TakesNoPoseFromALineThatIsHalfWritten) {
  namespace fs = std::filesystem;
  const fs::path growing = folder_ / "growing";
  begin_recording(growing);
  add_frames(growing, 0, 2);
  const std::string poses = read_whole(growing / "groundtruth.txt");
  // Nearly a unit quaternion still, and turned by ten degrees.
  const std::size_t cut = poses.rfind(" 0.08") + 4;
  write_whole(growing / "groundtruth.txt", poses.substr(0, cut));
  const std::vector<std::string> how = {
      "live", growing.string(), "--voxel-size", "0.2", "--max-distance", "2", "-o"};
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    std::ofstream(growing / "groundtruth.txt", std::ios::app) << poses.substr(cut);
  });
  std::vector<std::string> follow = how;
  follow.insert(follow.end(), {path("followed.ridge"), "--follow", "60", "--until", "000001.png"});
  const Outcome followed = run(follow);
  writer.join();
  ASSERT_EQ(followed.code, 0) << followed.err;
  std::vector<std::string> again = how;
  again.push_back(path("whole.ridge"));
  ASSERT_EQ(run(again).code, 0);
  EXPECT_TRUE(read_whole(folder_ / "followed.ridge") == read_whole(folder_ / "whole.ridge"));
}

TEST_F(CliLive, KeepsWhatCameBeforeALineThatIsNeverWhole) {
  const std::filesystem::path growing = folder_ / "growing";
  begin_recording(growing);
  add_frames(growing, 0, 3);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    add_frames(growing, 3, 6);
    // The last pose is cut off, as where a recorder writes blocks of bytes and dies.
    const std::string poses = read_whole(growing / "groundtruth.txt");
    write_whole(growing / "groundtruth.txt", poses.substr(0, poses.rfind(' ') - 3));
  });
  const Outcome followed = run({"live", growing.string(), "--voxel-size", "0.2", "--max-distance",
                                "2", "-o", path("followed.ridge"), "--follow", "3", "--json"});
  writer.join();
  ASSERT_EQ(followed.code, 0) << followed.err;
  EXPECT_EQ(followed.json()["scans"].get<int>(), 5);
  EXPECT_NE(followed.err.find("was not taken"), std::string::npos) << followed.err;
}

TEST_F(CliLive, FollowsImagesWhosePosesComeAlone) {
  namespace fs = std::filesystem;
  const fs::path growing = folder_ / "growing";
  fs::create_directories(growing / "depth");
  fs::copy_file(fs::path(kRecording) / "camera-intrinsics.txt", growing / "camera-intrinsics.txt");
  const DepthSequence recording = open_sequence(kRecording);
  std::thread writer([&] {
    for (std::size_t i = 0; i < 6; ++i) {
      std::ostringstream pose;
      pose << i << " " << i << " 0\n" << recording.frames[i].T_world_camera.matrix() << "\n";
      fs::copy_file(recording.frames[i].image, growing / "depth" / (std::to_string(i) + ".png"));
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      const std::string text = pose.str(), cut = text.substr(0, text.size() / 2 + 1);
      std::ofstream(growing / "trajectory.log", std::ios::app) << cut << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      std::ofstream(growing / "trajectory.log", std::ios::app) << text.substr(cut.size());
    }
  });
  const Outcome followed =
      run({"live", growing.string(), "--voxel-size", "0.2", "--max-distance", "2", "-o",
           path("followed.ridge"), "--follow", "60", "--until", "5.png", "--json"});
  writer.join();
  ASSERT_EQ(followed.code, 0) << followed.err;
  EXPECT_EQ(followed.json()["scans"].get<int>(), 6);
  // A recording that is not followed has to be whole.
  fs::remove(growing / "depth/5.png");
  expect_refused({"live", growing.string(), "-o", path("none.ridge")}, {"6 poses for 5 images"});
}

TEST_F(CliLive, ImagesAfterTheLastPoseAreTakenWhenItIsOver) {
  const std::filesystem::path growing = folder_ / "growing";
  begin_recording(growing);
  add_frames(growing, 0, 3);
  // Each pose a little before its image.
  std::istringstream poses(read_whole(growing / "groundtruth.txt"));
  std::string earlier;
  for (std::string line; std::getline(poses, line);) {
    const std::size_t end = line.find(' ');
    earlier += line.starts_with('#')
                   ? line
                   : std::to_string(std::stod(line.substr(0, end)) - 0.005) + line.substr(end);
    earlier += "\n";
  }
  write_whole(growing / "groundtruth.txt", earlier);
  const auto began = std::chrono::steady_clock::now();
  const Outcome followed =
      run({"live", growing.string(), "--voxel-size", "0.2", "--max-distance", "2", "-o",
           path("followed.ridge"), "--follow", "600", "--until", "000002.png", "--json"});
  ASSERT_EQ(followed.code, 0) << followed.err;
  EXPECT_EQ(followed.json()["scans"].get<int>(), 3);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(300));
}

TEST_F(CliLive, WaitsForAnImageThatComesAfterItsLine) {
  const std::filesystem::path growing = folder_ / "growing";
  begin_recording(growing);
  add_frames(growing, 0, 3);
  const std::filesystem::path late = growing / "depth" / "000002.png", aside = folder_ / "aside";
  std::filesystem::rename(late, aside);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    std::filesystem::rename(aside, late);
  });
  const Outcome followed =
      run({"live", growing.string(), "--voxel-size", "0.2", "--max-distance", "2", "-o",
           path("followed.ridge"), "--follow", "60", "--until", "000002.png", "--json"});
  writer.join();
  ASSERT_EQ(followed.code, 0) << followed.err;
  EXPECT_EQ(followed.json()["scans"].get<int>(), 3);
  EXPECT_EQ(followed.json()["unreadable"].get<int>(), 0);
}

TEST_F(CliLive, KeepsToTheRecordingsClock) {
  const std::filesystem::path some = folder_ / "some";
  begin_recording(some);
  add_frames(some, 0, 6);
  const auto began = std::chrono::steady_clock::now();
  const Outcome outcome = run({"live", some.string(), "-o", path("live.ridge"), "--voxel-size",
                               "0.5", "--height", "0.5,2", "--realtime", "--json"});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const DepthSequence sequence = open_sequence(some, {});
  EXPECT_GE(took.count(), *sequence.frames.back().time - *sequence.frames.front().time);
  EXPECT_GE(outcome.json()["behind_seconds"], 0.0);
  EXPECT_NE(run({"info", path("live.ridge")}).out.find("keep_in"), std::string::npos);
}

TEST_F(CliLive, WritesNoTableOverWhatItReadsOrWrites) {
  const std::filesystem::path some = folder_ / "some";
  begin_recording(some);
  add_frames(some, 0, 2);
  const std::string poses = read_whole(some / "groundtruth.txt");
  const auto live = [&](const std::string& csv) {
    return run({"live", some.string(), "-o", path("live.ridge"), "--csv", csv});
  };
  for (const std::string& csv : {(some / "groundtruth.txt").string(), path("live.ridge"),
                                 path("no/such/live.csv"), path("live.txt")}) {
    const Outcome outcome = live(csv);
    EXPECT_EQ(outcome.code, 1) << csv;
    EXPECT_NE(outcome.err.find(csv), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "live.ridge")) << csv;
  }
  EXPECT_EQ(read_whole(some / "groundtruth.txt"), poses);
}

TEST_F(CliLive, NamesTheFirstImageThatItPassesOver) {
  const std::filesystem::path some = folder_ / "some";
  begin_recording(some);
  add_frames(some, 0, 4);
  write_whole(some / "depth/000001.png", "no image");
  std::filesystem::remove(some / "depth/000002.png");
  const Outcome outcome = run({"live", some.string(), "-o", path("live.ridge"), "--voxel-size",
                               "0.2", "--max-distance", "2", "--until", "end.png"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"2 images", "000001.png", "no image end.png"})
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
}

TEST_F(CliLive, RefusesWhatIsNoRecordingAndNamesTheFrame) {
  EXPECT_EQ(run({"live", path("nowhere"), "-o", path("live.ridge")}).code, 1);
  // A robot that fits nowhere.
  const Outcome outcome = run({"live", kRecording, "-o", path("live.ridge"), "--voxel-size", "0.5",
                               "--min-clearance", "5"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("--min-clearance"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ridgeway
