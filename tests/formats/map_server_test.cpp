// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/map_server.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "ridgeway/formats/load_map.hpp"
#include "support/png_bytes.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

std::string yaml(const std::string& image, const std::string& origin,
                 const std::string& more = "") {
  return "image: " + image + "\nresolution: 0.5\norigin: " + origin +
         "\noccupied_thresh: 0.65\nfree_thresh: 0.196\n" + more;
}

/// 4 x 3 pixels: black at the lower left, grey at the upper right, else white.
std::string pgm() {
  return "P2\n# made by hand\n4 3\n255\n254 254 254 205\n254 254 254 254\n0 254 254 254\n";
}

VoxelState at(const OccupancyMap& map, double x, double y) {
  return map.at(voxel_at(Point(x, y, 0.25), map.voxel_size) - map.origin);
}

TEST(MapServer, PixelsLieWhereTheOriginSays) {
  const TemporaryFolder folder;
  write_whole(folder / "a.pgm", pgm());
  write_whole(folder / "a.yaml", yaml("a.pgm", "[-1.0, 2.0, 0.0]"));
  const OccupancyMap map = load_map(folder / "a.yaml");
  EXPECT_TRUE(map.planar);
  EXPECT_EQ(map.voxel_size, 0.5);
  EXPECT_EQ(at(map, -0.75, 2.25), VoxelState::kOccupied);
  EXPECT_EQ(at(map, -0.25, 2.25), VoxelState::kFree);
  EXPECT_EQ(at(map, 0.75, 3.25), VoxelState::kUnknown);
  EXPECT_EQ(at(map, -0.75, 3.25), VoxelState::kFree);
  EXPECT_EQ(at(map, 1.25, 2.25), VoxelState::kUnknown);
}

TEST(MapServer, AQuarterTurnIsExactAndAnyOtherLosesNoObstacle) {
  const TemporaryFolder folder;
  write_whole(folder / "a.pgm", pgm());
  write_whole(folder / "quarter.yaml", yaml("a.pgm", "[0, 0, 1.5707963267948966]"));
  const OccupancyMap quarter = load_map(folder / "quarter.yaml");
  EXPECT_EQ(at(quarter, -0.25, 0.25), VoxelState::kOccupied);
  EXPECT_EQ(at(quarter, -0.25, 0.75), VoxelState::kFree);
  for (const char* few_decimals : {"1.5708", "1.571", "-4.712389"}) {
    write_whole(folder / "few.yaml", yaml("a.pgm", std::string("[0, 0, ") + few_decimals + "]"));
    const OccupancyMap few = load_map(folder / "few.yaml");
    EXPECT_EQ(count_voxels(few).occupied, 1u) << few_decimals;
    EXPECT_EQ(at(few, -0.25, 0.25), VoxelState::kOccupied) << few_decimals;
  }
  write_whole(folder / "turned.yaml", yaml("a.pgm", "[0.1, 0.2, 0.4]"));
  const OccupancyMap turned = load_map(folder / "turned.yaml");
  for (double u = 0.02; u < 0.5; u += 0.04)
    for (double v = 0.02; v < 0.5; v += 0.04)
      EXPECT_EQ(at(turned, 0.1 + std::cos(0.4) * u - std::sin(0.4) * v,
                   0.2 + std::sin(0.4) * u + std::cos(0.4) * v),
                VoxelState::kOccupied);
}

TEST(MapServer, ModesAndThresholdsDecideOnPixels) {
  MapServerFile file;
  const auto state = [&](int grey) {
    return state_of_pixel(file, static_cast<std::uint8_t>(grey), 255);
  };
  EXPECT_EQ(state(0), VoxelState::kOccupied);
  EXPECT_EQ(state(89), VoxelState::kOccupied);
  EXPECT_EQ(state(90), VoxelState::kUnknown);
  EXPECT_EQ(state(205), VoxelState::kUnknown);
  EXPECT_EQ(state(206), VoxelState::kFree);
  EXPECT_EQ(state_of_pixel(file, 255, 254), VoxelState::kUnknown);
  EXPECT_EQ(state_of_pixel(file, 0, 0), VoxelState::kOccupied);  // a wall whose edge is smoothed
  EXPECT_EQ(state_of_pixel(file, 60, 128), VoxelState::kOccupied);
  EXPECT_EQ(state_of_pixel(file, 205, 254), VoxelState::kUnknown);
  file.negate = true;
  EXPECT_EQ(state(255), VoxelState::kOccupied);
  EXPECT_EQ(state(0), VoxelState::kFree);
  file.negate = false;
  file.mode = MapServerFile::Mode::kScale;
  EXPECT_EQ(state_of_pixel(file, 0, 0), VoxelState::kUnknown);
  file.mode = MapServerFile::Mode::kRaw;
  EXPECT_EQ(state(0), VoxelState::kFree);
  EXPECT_EQ(state(100), VoxelState::kOccupied);
  EXPECT_EQ(state(255), VoxelState::kUnknown);
}

TEST(MapServer, FilesAreKnownByTheirImageHoweverTheyAreWritten) {
  for (const char* text : {"image: a.png\n", "mode: raw\nimage : a.png\n", "{image: a.png}",
                           "{resolution: 0.1,image: a.png}", "{resolution: 0.1,\n  image : a.png}",
                           "\xef\xbb\xbfimage: a.png", "{\"image\": \"a.png\"}",
                           "# made by hand\n\n  image: a.png\n", "mode: [\nimage: a.png\n"})
    EXPECT_TRUE(is_map_server(text)) << text;
  for (const char* text :
       {"", "name: image\n", "images: a.png\n", "boxes:\n  image: a.png\n", "{name: image}",
        "{boxes: {image: a}}", "{name: 'x, image: y'}", "boxes: []\n# image: a.png\n"})
    EXPECT_FALSE(is_map_server(text)) << text;
}

TEST(MapServer, ColouredPicturesAreAveragedAndWhatOneSeesThroughIsUnknown) {
  const TemporaryFolder folder;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 2;
  image.format = PNG_FORMAT_RGBA;
  const std::uint8_t pixels[16] = {255, 255, 255, 255, 30, 60, 90, 255,
                                   255, 255, 255, 0,   0,  0,  0,  255};
  ASSERT_NE(png_image_write_to_file(&image, (folder / "a.png").c_str(), 0, pixels, 0, nullptr), 0);
  write_whole(folder / "a.yaml", yaml("a.png", "[0, 0, 0]"));
  const OccupancyMap map = load_map(folder / "a.yaml");
  EXPECT_EQ(at(map, 0.25, 0.75), VoxelState::kFree);
  EXPECT_EQ(at(map, 0.75, 0.75), VoxelState::kOccupied);
  EXPECT_EQ(at(map, 0.25, 0.25), VoxelState::kUnknown);
  EXPECT_EQ(at(map, 0.75, 0.25), VoxelState::kOccupied);
}

/// Numbers of pixels are states, however bright a file says they are meant to look.
TEST(MapServer, PixelsCountAsTheyAre) {
  const TemporaryFolder folder;
  const std::uint8_t states[4] = {205, 254, 0, 80};  // unknown, free, occupied, occupied
  const auto known_as = [&](int bits, const std::string& chunks) {
    std::string start(13, '\0'), rows;
    start[3] = start[7] = 2;
    start[8] = static_cast<char>(bits);
    for (int i = 0; i < 4; ++i) {
      if (i % 2 == 0) rows += '\0';  // no filter
      rows.append(static_cast<std::size_t>(bits / 8), static_cast<char>(states[i]));
    }
    uLongf size = ::compressBound(rows.size());
    std::string packed(size, '\0');
    ::compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(rows.data()), rows.size());
    packed.resize(size);
    write_whole(folder / "a.png", "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", start) + chunks +
                                      png_chunk("IDAT", packed) + png_chunk("IEND", ""));
    write_whole(folder / "a.yaml", "\xef\xbb\xbf" + yaml("a.png", "[0, 0, 0]"));
    const OccupancyMap map = load_map(folder / "a.yaml");
    return std::vector{at(map, 0.25, 0.75), at(map, 0.75, 0.75), at(map, 0.25, 0.25),
                       at(map, 0.75, 0.25)};
  };
  const std::vector expected = {VoxelState::kUnknown, VoxelState::kFree, VoxelState::kOccupied,
                                VoxelState::kOccupied};
  const std::string linear("\x00\x01\x86\xa0", 4), dark("\x00\x00\xb1\x8f", 4);
  for (const int bits : {8, 16}) {
    EXPECT_EQ(known_as(bits, ""), expected) << bits;
    EXPECT_EQ(known_as(bits, png_chunk("gAMA", linear)), expected) << bits;
    EXPECT_EQ(known_as(bits, png_chunk("gAMA", dark)), expected) << bits;
    EXPECT_EQ(known_as(bits, png_chunk("sRGB", std::string(1, '\0'))), expected) << bits;
  }
}

/// A pixel is one voxel of the plane, however many layers it is read into.
TEST(MapServer, SpecksAreCountedInPixels) {
  const TemporaryFolder folder;
  write_whole(folder / "a.pgm", "P2\n6 2\n255\n0 0 254 254 254 0\n0 254 254 254 254 254\n");
  write_whole(folder / "a.yaml", yaml("a.pgm", "[0, 0, 0]"));
  const auto occupied = [&](int isolated_below, std::optional<double> voxel_size) {
    LoadConfig config;
    config.isolated_below = isolated_below;
    config.voxel_size = voxel_size;
    return count_voxels(load_map(folder / "a.yaml", config)).occupied;
  };
  EXPECT_EQ(occupied(1, {}), 4u);
  EXPECT_EQ(occupied(2, {}), 3u);
  EXPECT_EQ(occupied(3, {}), 3u);
  EXPECT_EQ(occupied(4, {}), 0u);
  EXPECT_EQ(occupied(1, 1.0), 2u);
  EXPECT_EQ(occupied(2, 1.0), 0u);
}

TEST(MapServer, OneWithoutAnImageIsToldSo) {
  const TemporaryFolder folder;
  write_whole(folder / "a.yaml", "resolution: 0.5\norigin: [0, 0, 0]\n");
  EXPECT_NE(refusal([&] { load_map(folder / "a.yaml"); }).find("image"), std::string::npos);
}

TEST(MapServer, DamagedFilesAreRefusedByName) {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& text, const std::string& image) {
    write_whole(folder / "a.pgm", image);
    write_whole(folder / "a.yaml", text);
    return refusal([&] { load_map(folder / "a.yaml"); });
  };
  write_whole(folder / "b.pgm", pgm());
  EXPECT_NE(refusal([&] { load_map(folder / "b.pgm"); }).find("give the .yaml"), std::string::npos);
  const std::string good = yaml("a.pgm", "[0, 0, 0]");
  EXPECT_NE(says(yaml("none.pgm", "[0, 0, 0]"), pgm()).find("none.pgm"), std::string::npos);
  EXPECT_NE(says(yaml("a.pgm", "[0, 0]"), pgm()).find("a.yaml line 3"), std::string::npos);
  EXPECT_NE(says(yaml("a.pgm", "[0, .nan, 0]"), pgm()).find("origin"), std::string::npos);
  EXPECT_NE(says(yaml("a.pgm", "[0, 0, 0]", "mode: odd\n"), pgm()).find("mode"), std::string::npos);
  EXPECT_NE(says("image: a.pgm\norigin: [0, 0, 0]\n", pgm()).find("resolution"), std::string::npos);
  EXPECT_NE(says(yaml("a.pgm", "[0, 0, 0]", "resolution: 2\n"), pgm()).find("'resolution' again"),
            std::string::npos);
  EXPECT_NE(says(good, "P5\n4 3\n255\nshort").find("a.pgm"), std::string::npos);
  EXPECT_NE(says(good, "P5\n99999 99999\n255\n").find("a.pgm"), std::string::npos);
  EXPECT_NE(says(good, "P2\n2 2\n255\n1 2 3 999\n").find("brighter"), std::string::npos);
  EXPECT_NE(says(good, "P6\n").find("no image"), std::string::npos);
  EXPECT_NE(says(good, "P2\n1 1\n255\n205\n"), "");  // nothing is known
}

}  // namespace
}  // namespace ridgeway
