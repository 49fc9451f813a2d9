// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/io/depth_sequence.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "ridgeway/common/error.hpp"
#include "ridgeway/io/depth_png.hpp"
#include "ridgeway/sensing/poses.hpp"
#include "ridgeway/sensing/random.hpp"
#include "temporary_folder.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

DepthImage random_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  DepthImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.depth.push_back(random.below(5) == 0 ? 0.0f
                                               : static_cast<float>(random.uniform(0.1, 10.0)));
  return image;
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(DepthPng, GivesBackDepthsToTheUnit) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(37, 5), std::pair(320, 240)}) {
    const DepthImage image = random_image(width, height, 3);
    write_depth_png(image, folder / "depth.png", 5000.0);
    const DepthImage read = read_depth_png(folder / "depth.png", 5000.0);
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, height);
    for (std::size_t i = 0; i < image.depth.size(); ++i)
      ASSERT_NEAR(read.depth[i], image.depth[i], 0.5 / 5000.0 + 1e-6);
  }
  DepthImage far{2, 1, {20.0f, 65535.0f / 5000.0f}};  // does not fit, and would mean "none"
  write_depth_png(far, folder / "far.png", 5000.0);
  EXPECT_EQ(read_depth_png(folder / "far.png", 5000.0).depth, std::vector<float>(2, 0.0f));
}

TEST(DepthPng, DamagedAndOtherImagesAreRefused) {
  const TemporaryFolder folder;
  write_depth_png(random_image(40, 30, 1), folder / "good.png", 5000.0);
  const std::string bytes = read_whole(folder / "good.png");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 8) {
    write_whole(folder / "bad.png", bytes.substr(0, length));
    EXPECT_NE(refusal([&] { read_depth_png(folder / "bad.png", 5000.0); }).find("bad.png"),
              std::string::npos)
        << length;
  }
  Random random(2);
  for (int i = 0; i < 300; ++i) {  // a refusal or an image, never a crash
    std::string bad = bytes;
    for (int k = 0; k < 3; ++k)
      bad[random.below(bad.size())] = static_cast<char>(random.below(256));
    write_whole(folder / "bad.png", bad);
    refusal([&] { read_depth_png(folder / "bad.png", 5000.0); });
  }
  std::string shallow = bytes;
  shallow[24] = 8;  // bits; the checksum is then wrong as well
  write_whole(folder / "bad.png", shallow);
  EXPECT_FALSE(refusal([&] { read_depth_png(folder / "bad.png", 5000.0); }).empty());
}

TEST(DepthSequence, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const PinholeCamera camera{40, 30, 20.0, 21.0, 19.5, 14.5};
  SequenceWriter writer(folder / "run", camera);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back(level_pose({0.1 * i, 2.0, -1.0}, 0.3 * i));
    writer.add(random_image(40, 30, static_cast<std::uint64_t>(i)), poses.back());
  }
  EXPECT_THROW(open_sequence(folder / "run"), InputError);  // not finished
  writer.finish();
  const DepthSequence sequence = open_sequence(folder / "run");
  EXPECT_EQ(sequence.layout, "tum");
  EXPECT_EQ(sequence.camera.fy, 21.0);
  EXPECT_EQ(sequence.camera.width, 40);
  ASSERT_EQ(sequence.frames.size(), 12u);
  EXPECT_EQ(sequence.without_pose, 0u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_LT((sequence.frames[i].T_world_camera.matrix() - poses[i].matrix()).norm(), 1e-12);
    EXPECT_NEAR(read_frame(sequence, sequence.frames[i]).depth[7], random_image(40, 30, i).depth[7],
                1e-3);
  }
  EXPECT_THROW(SequenceWriter(folder / "run", camera), InputError);
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

TEST_F(TumFolder, TimesAreMatchedNearestFirst) {
  const DepthSequence sequence = open_sequence(folder_.path());
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.frames[0].T_world_camera.translation().x(), 1.0);
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation().x(), 3.0);
  EXPECT_EQ(sequence.without_pose, 1u);
  EXPECT_EQ(sequence.camera.fx, 525.0);
}

TEST_F(TumFolder, MistakesAreNamedWithFileAndLine) {
  const auto with = [&](const char* file, const std::string& text) {
    const std::string before = read_whole(folder_ / file);
    write_whole(folder_ / file, text);
    const std::string message = refused();
    write_whole(folder_ / file, before);
    return message;
  };
  const auto has = [](const std::string& message, const std::string& word) {
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  has(with("depth.txt", "1.0\n"), "depth.txt line 1");
  has(with("depth.txt", "# a\nsoon a.png\n"), "depth.txt line 2");
  has(with("depth.txt", "1.0 none.png\n"), "none.png");
  has(with("groundtruth.txt", "1.0 1 0 0 0 0\n"), "groundtruth.txt line 1");
  has(with("groundtruth.txt", "1.0 1 0 0 0 0 0 2\n"), "quaternion");
  has(with("groundtruth.txt", "1.0 nan 0 0 0 0 0 1\n"), "no image with a pose");
  has(with("groundtruth.txt", "9.0 1 0 0 0 0 0 1\n"), "no image with a pose");
  write_whole(folder_ / "camera-intrinsics.txt", "525 0 900\n0 525 240\n0 0 1\n");
  has(refused(), "camera cx");
  write_whole(folder_ / "camera-intrinsics.txt", "525 0\n");
  has(refused(), "camera-intrinsics.txt");
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
  EXPECT_NE(refusal([&] { open_sequence(folder.path()); }).find("frame-000000.pose.txt"),
            std::string::npos);
}

/// A recording made here, and the real one of a room where RIDGEWAY_MAPS names its folder.
std::vector<fs::path> recordings(const TemporaryFolder& made) {
  SequenceWriter writer(made / "run", {.width = 64, .height = 48, .cx = 31.5, .cy = 23.5});
  for (int i = 0; i < 4; ++i)
    writer.add(random_image(64, 48, static_cast<std::uint64_t>(i)), level_pose({0, 0, 1}, i));
  writer.finish();
  std::vector<fs::path> folders = {made / "run"};
  const char* maps = std::getenv("RIDGEWAY_MAPS");
  if (maps != nullptr && fs::exists(fs::path(maps) / "rgbd_room"))
    folders.push_back(fs::path(maps) / "rgbd_room");
  return folders;
}

TEST(DepthSequence, FramesShowMostOfWhatIsBeforeTheCamera) {
  const TemporaryFolder made;
  for (const fs::path& folder : recordings(made)) {
    SCOPED_TRACE(folder.string());
    const DepthSequence sequence = open_sequence(folder);
    EXPECT_EQ(sequence.without_pose, 0u);
    const DepthImage image = read_frame(sequence, sequence.frames[sequence.frames.size() / 2]);
    std::size_t seen = 0;
    for (const float depth : image.depth) seen += depth > 0.1f && depth < 10.0f;
    EXPECT_GT(seen, image.depth.size() / 2);
  }
}

}  // namespace
}  // namespace ridgeway
