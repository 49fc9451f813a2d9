// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "recordings/depth_png.hpp"

#include <gtest/gtest.h>

#include "support/png_bytes.hpp"
#include "support/random_image.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

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

TEST(DepthPng, OnlyGreyImagesOf16BitsThatHoldWhatTheyPromise) {
  const TemporaryFolder folder;
  const auto read = [&](const PngHeader& header, std::size_t row_bytes) {
    write_whole(folder / "a.png", png_bytes(header, row_bytes));
    return refusal([&] { read_depth_png(folder / "a.png", 5000.0); });
  };
  constexpr std::size_t kRows = 48 * (1 + 2 * 64);
  EXPECT_EQ(read({}, kRows), "");
  EXPECT_EQ(read({.interlaced = 1}, kRows + 200), "");  // more, shorter rows
  EXPECT_NE(read({.bits = 8}, kRows).find("16-bit grey"), std::string::npos);
  EXPECT_NE(read({.colour = 2}, 3 * kRows).find("16-bit grey"), std::string::npos);
  EXPECT_NE(read({.bits = 8, .colour = 3}, kRows).find("16-bit grey"), std::string::npos);
  EXPECT_NE(read({.colour = 4}, 2 * kRows).find("16-bit grey"), std::string::npos);
  EXPECT_NE(read({.width = 0}, kRows), "");
  EXPECT_NE(read({.height = 0}, kRows), "");
  EXPECT_NE(read({.width = 0x7fffffff, .height = 0x7fffffff}, kRows), "");
  EXPECT_NE(read({.width = 20000}, kRows), "");
  // Refused by its length, before half a gigabyte is taken for it.
  EXPECT_NE(read({.width = 16384, .height = 16384}, kRows).find("ends too early"),
            std::string::npos);
  EXPECT_NE(read({.height = 49}, kRows), "");
}

}  // namespace
}  // namespace ridgeway
