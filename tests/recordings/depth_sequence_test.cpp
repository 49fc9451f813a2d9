// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/recordings/depth_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "common/number_text.hpp"
#include "common/random.hpp"
#include "recordings/depth_png.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "sensing/poses.hpp"
#include "support/map_errors.hpp"
#include "support/random_image.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

TEST(DepthSequence, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const PinholeCamera camera{40, 30, 20.0, 21.0, 19.5, 14.5};
  SequenceWriter writer(folder / "run", camera, 4.0);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back(level_pose({0.1 * i, 2.0, -1.0}, 0.3 * i));
    writer.add(random_image(40, 30, static_cast<std::uint64_t>(i)), poses.back());
  }
  EXPECT_THROW(open_sequence(folder / "run"), InputError);  // not finished
  EXPECT_THROW(writer.add(random_image(41, 30, 1), poses[0]), InputError);
  DepthImage longer = random_image(40, 30, 1);
  longer.depth.push_back(1.0f);
  EXPECT_THROW(writer.add(longer, poses[0]), InputError);
  writer.finish();
  const DepthSequence sequence = open_sequence(folder / "run");
  EXPECT_EQ(sequence.layout, "tum");
  EXPECT_EQ(sequence.camera.fy, 21.0);
  EXPECT_EQ(sequence.camera.width, 40);
  ASSERT_EQ(sequence.frames.size(), 12u);
  EXPECT_EQ(sequence.without_pose, 0u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(sequence.frames[i].time, 0.25 * static_cast<double>(i));
    EXPECT_LT((sequence.frames[i].T_world_camera.matrix() - poses[i].matrix()).norm(), 1e-12);
    EXPECT_NEAR(read_frame(sequence, sequence.frames[i]).depth[7], random_image(40, 30, i).depth[7],
                1e-3);
  }
  EXPECT_THROW(SequenceWriter(folder / "run", camera), InputError);
  EXPECT_THROW(SequenceWriter(folder / "empty", camera).finish(), InputError);
  for (const double rate : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(SequenceWriter(folder / "other", camera, rate), InputError);
}

/// A folder with one image in the layout of TUM RGB-D.
class TumFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    write_depth_png(random_image(640, 480, 1), folder_ / "a.png", 5000.0);
    write_whole(folder_ / "depth.txt", "# depth\n1.00 a.png\n1.10 a.png\n5.0 a.png\n");
    write_whole(folder_ / "groundtruth.txt",
                "# poses\n0.99 1 0 0 0 0 0 1\n1.015 2 0 0 0 0 0 1\n1.11 3 0 0 0 0 0 1\n");
  }
  std::string refused() {
    return refusal([&] { open_sequence(folder_.path()); });
  }
  TemporaryFolder folder_;
};

TEST_F(TumFolder, AnImageBetweenTwoPosesHasThePoseBetweenThem) {
  // Ten poses a second, on a line, a radian a second about the camera's axis.
  std::string poses;
  for (int k = 0; k <= 10; ++k) {
    const double time = 1.0 + 0.1 * k;
    poses += number_text(time) + " " + number_text(2.0 * time) + " 0 0 0 0 " +
             number_text(std::sin(0.5 * time)) + " " + number_text(std::cos(0.5 * time)) + "\n";
  }
  write_whole(folder_ / "groundtruth.txt", poses);
  std::string images;
  for (int i = 0; i < 30; ++i) images += number_text(1.0 + i / 30.0) + " a.png\n";
  write_whole(folder_ / "depth.txt", images);
  const DepthSequence sequence = open_sequence(folder_.path());
  EXPECT_EQ(sequence.without_pose, 0u);
  EXPECT_EQ(sequence.poses_until, 2.0);
  ASSERT_EQ(sequence.frames.size(), 30u);
  for (const DepthFrame& frame : sequence.frames) {
    Eigen::Isometry3d exact = Eigen::Isometry3d::Identity();
    exact.translation().x() = 2.0 * *frame.time;
    exact.linear() = Eigen::AngleAxisd(*frame.time, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_TRUE(frame.T_world_camera.isApprox(exact, 1e-9)) << *frame.time;
  }
}

TEST_F(TumFolder, NothingIsMadeUpWherePosesAreFarApart) {
  write_whole(folder_ / "depth.txt",
              "0.9 a.png\n0.97 a.png\n1 a.png\n1.1 a.png\n1.295 a.png\n2 a.png\n");
  write_whole(folder_ / "groundtruth.txt", "1.3 3 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  const DepthSequence sequence = open_sequence(folder_.path());
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.frames[0].T_world_camera.translation().x(), 1.0);
  EXPECT_EQ(*sequence.frames[0].time, 1.0);
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation().x(), 3.0);
  EXPECT_EQ(sequence.without_pose, 4u);
}

TEST_F(TumFolder, NothingIsMadeUpWhereTrackingWasLost) {
  write_whole(folder_ / "depth.txt", "1.05 a.png\n1.15 a.png\n1.25 a.png\n");
  write_whole(folder_ / "groundtruth.txt",
              "1 1 0 0 0 0 0 1\n1.1 nan 0 0 0 0 0 1\n1.2 2 0 0 0 0 0 1\n1.3 3 0 0 0 0 0 1\n");
  const DepthSequence sequence = open_sequence(folder_.path());
  EXPECT_EQ(sequence.without_pose, 2u);
  ASSERT_EQ(sequence.frames.size(), 1u);
  EXPECT_NEAR(sequence.frames[0].T_world_camera.translation().x(), 2.5, 1e-6);
}

TEST_F(TumFolder, ALimitHoldsForTimesSince1970) {
  std::string poses;
  for (int k = 0; k <= 20; ++k)
    poses += "13050311" + std::to_string(10 + k / 5) + "." + std::to_string(k % 5 * 2) +
             " 1 0 0 0 0 0 1\n";
  write_whole(folder_ / "groundtruth.txt", poses);
  std::string images;
  for (int i = 0; i < 40; ++i)
    images += "13050311" + std::to_string(10 + i / 10) + "." + std::to_string(i % 10) + "5 a.png\n";
  write_whole(folder_ / "depth.txt", images);
  EXPECT_EQ(open_sequence(folder_.path()).without_pose, 0u);
}

TEST_F(TumFolder, TimesAreMatchedNearestFirst) {
  SequenceConfig config;
  config.longest_step = 0.0;
  const DepthSequence sequence = open_sequence(folder_.path(), config);
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.frames[0].T_world_camera.translation().x(), 1.0);
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation().x(), 3.0);
  EXPECT_EQ(sequence.without_pose, 1u);
  EXPECT_EQ(sequence.camera.fx, 525.0);
}

TEST_F(TumFolder, ClocksThatDoNotMeetAreToldApart) {
  write_whole(folder_ / "groundtruth.txt", "3600 1 0 0 0 0 0 1\n3700.5 3 0 0 0 0 0 1\n");
  EXPECT_NE(refused().find("has no pose within 0.02 s of an image: images are from 1 to 5, poses "
                           "from 3600 to 3700.5"),
            std::string::npos)
      << refused();
}

TEST_F(TumFolder, ClocksThatMeetAtZeroAloneAreToldApart) {
  write_whole(folder_ / "depth.txt", "0 a.png\n250 a.png\n500 a.png\n");
  write_whole(folder_ / "groundtruth.txt",
              "0 1 0 0 0 0 0 1\n0.25 2 0 0 0 0 0 1\n0.5 3 0 0 0 0 0 1\n");
  EXPECT_NE(refused().find("has one pose alone within 0.02 s"), std::string::npos) << refused();
}

TEST_F(TumFolder, TimesThatAreNoSecondsAreRefused) {
  write_whole(folder_ / "depth.txt", "1.00 a.png\n1305031102175304000 a.png\n");
  EXPECT_NE(refused().find("depth.txt line 2"), std::string::npos) << refused();
  EXPECT_NE(refused().find("divide by"), std::string::npos) << refused();
}

TEST_F(TumFolder, TwoPosesAtOneTimeAreRefused) {
  write_whole(folder_ / "groundtruth.txt", "1 1 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  EXPECT_EQ(refused(), "");  // the same one said twice
  write_whole(folder_ / "groundtruth.txt", "1 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
  EXPECT_NE(refused().find("two poses at the time 1"), std::string::npos) << refused();
}

TEST_F(TumFolder, TimesAreMatchedAsByBruteForce) {
  SequenceConfig config;
  config.longest_step = 0.0;
  config.longest_gap = 0.03;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    std::map<double, double> images;  // time -> pose
    std::vector<double> poses;
    poses.reserve(60);
    std::string image_lines, pose_lines;
    for (int i = 0; i < 40; ++i) images[random.uniform(0.0, 1.0)] = -1.0;
    for (int k = 0; k < 60; ++k) poses.push_back(random.uniform(0.0, 1.0));
    for (const auto& [time, pose] : images) image_lines += number_text(time) + " a.png\n";
    for (std::size_t k = 0; k < poses.size(); ++k)
      pose_lines += number_text(poses[k]) + " " + std::to_string(k) + " 0 0 0 0 0 1\n";
    write_whole(folder_ / "depth.txt", image_lines);
    write_whole(folder_ / "groundtruth.txt", pose_lines);

    std::vector<std::tuple<double, double, std::size_t>> pairs;  // gap, image, pose
    for (const auto& [time, pose] : images)
      for (std::size_t k = 0; k < poses.size(); ++k)
        pairs.emplace_back(std::abs(time - poses[k]), time, k);
    std::sort(pairs.begin(), pairs.end());
    std::set<std::size_t> taken;
    for (const auto& [gap, time, pose] : pairs)
      if (gap <= config.longest_gap && images[time] < 0.0 && taken.insert(pose).second)
        images[time] = static_cast<double>(pose);
    std::vector<double> expected, found;
    for (const auto& [time, pose] : images)
      if (pose >= 0.0) expected.push_back(pose);
    const DepthSequence sequence = open_sequence(folder_.path(), config);
    for (const DepthFrame& frame : sequence.frames)
      found.push_back(frame.T_world_camera.translation().x());
    EXPECT_EQ(found, expected) << seed;
    EXPECT_EQ(found.size() + sequence.without_pose, 40u);
  }
}

TEST_F(TumFolder, TextsAreTakenAsTheyAreWritten) {
  write_whole(folder_ / "depth.txt",
              "\xef\xbb\xbf# depth\r\n5.0\ta.png\r\n\r\n 1.00,a.png # ok\r\n");
  write_whole(folder_ / "groundtruth.txt",
              "1.0 +1 0 0 0 0 0 1.001\r\n2.0 nan 0 0 0 0 0 1\r\n5e0,2,0,0,0,0,0,1");
  const DepthSequence sequence = open_sequence(folder_.path());
  ASSERT_EQ(sequence.frames.size(), 2u);  // in the order of time
  EXPECT_EQ(sequence.frames[0].T_world_camera.translation().x(), 1.0);
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation().x(), 2.0);
  EXPECT_TRUE(sequence.frames[0].T_world_camera.linear().isIdentity(1e-12));
}

TEST_F(TumFolder, TheCameraIsThatOfTheFirstImageThatCanBeRead) {
  write_whole(folder_ / "bad.png", "no image");
  write_whole(folder_ / "depth.txt", "1.00 none.png\n1.02 bad.png\n1.10 a.png\n");
  EXPECT_EQ(open_sequence(folder_.path()).camera.width, 640);
  write_whole(folder_ / "depth.txt", "1.00 none.png\n1.02 bad.png\n");
  EXPECT_NE(refused().find("none.png: there is no such file"), std::string::npos) << refused();
}

TEST_F(TumFolder, ManyEqualTimesTakeNoLongTime) {
  std::string images, poses;
  for (int i = 0; i < 20000; ++i) {
    images += "1.0 a.png\n";
    poses += "1.0 0 0 0 0 0 0 1\n";
  }
  write_whole(folder_ / "depth.txt", images);
  write_whole(folder_ / "groundtruth.txt", poses);
  EXPECT_EQ(open_sequence(folder_.path()).frames.size(), 20000u);
}

TEST_F(TumFolder, MistakesAreNamedWithFileAndLine) {
  const auto with = [&](const char* file, const std::string& text) {
    const std::string before = read_whole(folder_ / file);
    write_whole(folder_ / file, text);
    std::string message = refused();
    write_whole(folder_ / file, before);
    return message;
  };
  const auto has = [](const std::string& message, const std::string& word) {
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  has(with("depth.txt", "1.0\n"), "depth.txt line 1");
  has(with("depth.txt", "# a\nsoon a.png\n"), "depth.txt line 2");
  has(with("depth.txt", "1.0 none.png\n"), "none.png");
  has(with("depth.txt", "nan a.png\n"), "depth.txt line 1");
  has(with("depth.txt", std::string("1.0 a.p\0ng\n", 11)), "zero byte");
  has(with("depth.txt", ""), "depth.txt: is empty");
  has(with("groundtruth.txt", std::string(10000, ',') + "1\n"), "is too short");
  has(with("groundtruth.txt", "1 1 1 1 1 1 1 1 1" + std::string(200, '\t') + "\x01\n"),
      "quaternion");
  has(with("groundtruth.txt", "soon\x1b[2J 1 0 0 0 0 0 1\n"), "'soon?[2J'");
  has(with("groundtruth.txt", "1.0 1 0 0 0 0\n"), "groundtruth.txt line 1");
  has(with("groundtruth.txt", "1.0 1 0 0 0 0 0 2\n"), "quaternion");
  has(with("groundtruth.txt", "1.0 nan 0 0 0 0 0 1\n"), "no image with a pose");
  has(with("groundtruth.txt", "9.0 1 0 0 0 0 0 1\n"), "no pose within 0.02 s of an image");
  write_whole(folder_ / "camera-intrinsics.txt", "525 0 900\n0 525 240\n0 0 1\n");
  has(refused(), "camera-intrinsics.txt camera cx");
  for (const char* focal : {"0", "-525", "nan", "inf", "1e-300", "1e300"}) {
    write_whole(folder_ / "camera-intrinsics.txt",
                focal + std::string(" 0 320\n0 525 240\n0 0 1\n"));
    has(refused(), "camera-intrinsics.txt camera fx");
  }
  write_whole(folder_ / "camera-intrinsics.txt", "525 0\n");
  has(refused(), "camera-intrinsics.txt");
  // Of a matrix whose rows are columns, or that has more than a pinhole camera.
  for (const char* matrix : {"525 0 0\n0 525 0\n320 240 1\n", "525 2 320\n0 525 240\n0 0 1\n",
                             "525 0 320\n0 525 240\n0 0 2\n"}) {
    write_whole(folder_ / "camera-intrinsics.txt", matrix);
    has(refused(), "camera-intrinsics.txt: ");
  }
  const TemporaryFolder empty;
  has(refusal([&] { open_sequence(empty.path()); }), "holds no recording");
  has(refusal([&] { open_sequence(empty / "none"); }), "is no folder");
}

TEST(DepthSequence, SevenScenesLayout) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    const std::string name = "frame-00000" + std::to_string(i);
    write_depth_png(random_image(64, 48, 1), folder / (name + ".depth.png"), 1000.0);
    write_whole(folder / (name + ".pose.txt"),
                i == 1 ? "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\n0 0 0 1\n"
                       : "0 0 1 " + std::to_string(i) + "\n-1 0 0 0\n0 -1 0 0\n0 0 0 1\n");
  }
  write_whole(folder / "camera-intrinsics.txt", "58 0 32\n0 58 24\n0 0 1\n");
  const DepthSequence sequence = open_sequence(folder.path());
  EXPECT_EQ(sequence.layout, "7-scenes");
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.without_pose, 1u);  // lost
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation().x(), 2.0);
  EXPECT_EQ(sequence.camera.fx, 58.0);
  write_whole(folder / "frame-000000.pose.txt", "2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n");
  for (const char* bad :
       {"2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n", "-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
        "1 0.1 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 1 1\n",
        "1 0 0 0\n0 1 0 0\n0 0 1 0\n", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n7\n", "",
        "-1.#IND\n"}) {
    write_whole(folder / "frame-000000.pose.txt", bad);
    EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("frame-000000.pose.txt"),
              std::string::npos)
        << bad;
  }
  write_whole(folder / "frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  std::filesystem::remove(folder / "camera-intrinsics.txt");
  EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("64 x 48"), std::string::npos);
}

TEST(DepthSequence, FusesToTheExactDistanceOfTheHouse) {
  const DepthSequence sequence = open_sequence(fs::path(RIDGEWAY_DATA_DIR) / "house_depth");
  ASSERT_EQ(sequence.frames.size(), 24u);
  EXPECT_EQ(sequence.without_pose, 0u);
  TsdfFusion fusion;
  for (const DepthFrame& frame : sequence.frames)
    fusion.integrate(read_frame(sequence, frame), sequence.camera, frame.T_world_camera);
  const World house = load_world(std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml");
  const MapErrors errors = errors_of(fusion.map(), house);
  EXPECT_GT(errors.voxels, 180000u);
  EXPECT_LT(errors.mean, 0.15);  // voxels
  EXPECT_LT(errors.p99, 2.0);
}

TEST(DepthSequence, ATrajectoryLogGivesThePosesOfTheImagesInOrder) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "depth");
  for (const char* name : {"000001.png", "000002.png", "000003.png"})
    write_depth_png(random_image(640, 480, 1), folder / "depth" / name, 1000.0);
  const std::string turn = "0 -1 0 1.5\n1 0 0 2.5\n0 0 1 3.5\n0 0 0 1\n";
  const std::string lost = "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\n0 0 0 1\n";
  write_whole(folder / "trajectory.log", "0 0 1\n" + turn + "1 1 2\n" + lost + "2 2 3\n" + turn);
  EXPECT_TRUE(holds_depth_images(folder.path()));
  const DepthSequence sequence = open_sequence(folder.path());
  EXPECT_EQ(sequence.layout, "open3d");
  EXPECT_EQ(sequence.units_per_metre, 1000.0);
  EXPECT_EQ(sequence.camera.fx, 525.0);
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.without_pose, 1u);
  EXPECT_EQ(sequence.frames[1].image.filename(), "000003.png");
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation(), Point(1.5, 2.5, 3.5));

  // In the order of the numbers, which text has otherwise.
  fs::rename(folder / "depth" / "000002.png", folder / "depth" / "12.png");
  EXPECT_EQ(open_sequence(folder.path()).frames[1].image.filename(), "12.png");
  write_whole(folder / "trajectory.log", "2 2 3\n" + turn + "0 0 1\n" + turn + "1 1 2\n" + turn);
  EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("has pose 0 after pose 2"),
            std::string::npos);
  write_whole(folder / "trajectory.log", "0 0 0\n" + turn + "0 0 0\n" + turn + "0 0 0\n" + turn);
  EXPECT_EQ(open_sequence(folder.path()).frames.size(), 3u);
  write_whole(folder / "trajectory.log", "0 0 1\n" + turn);
  EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("1 poses for 3 images"),
            std::string::npos);
  EXPECT_EQ(open_sequence(folder.path(), {.is_growing = true}).frames.size(), 1u);
  const std::string four = "0 0 1\n" + turn + "1 1 2\n" + turn + "2 2 3\n" + turn + "3 3 4\n";
  write_whole(folder / "trajectory.log", four + turn);
  EXPECT_EQ(open_sequence(folder.path(), {.is_growing = true}).frames.size(), 3u);
  // What is missing between two numbers may still come, and no image has the pose of another.
  fs::rename(folder / "depth" / "12.png", folder / "depth" / "000005.png");
  EXPECT_EQ(open_sequence(folder.path(), {.is_growing = true}).frames.size(), 1u);
  fs::rename(folder / "depth" / "000005.png", folder / "depth" / "000002.png");
  EXPECT_EQ(open_sequence(folder.path(), {.is_growing = true}).frames.size(), 3u);
  write_whole(folder / "trajectory.log", four + turn.substr(0, 6));
  EXPECT_EQ(open_sequence(folder.path(), {.is_growing = true}).frames.size(), 3u);
  write_whole(folder / "trajectory.log", "0 0 1\n1 2 3\n");
  EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("trajectory.log"),
            std::string::npos);
  write_whole(folder / "trajectory.log", "0 0 1\n" + turn.substr(0, 11));
  EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("ends within a pose"),
            std::string::npos);
}

}  // namespace
}  // namespace ridgeway
