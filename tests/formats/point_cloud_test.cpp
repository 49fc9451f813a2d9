// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "formats/pcd.hpp"
#include "formats/ply_cloud.hpp"
#include "formats/xyz.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "support/lattice.hpp"
#include "support/map_file_writers.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

using testing::CloudPoint;

std::vector<CloudPoint> some_points(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> metres(-40.0, 40.0);
  std::vector<CloudPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    // x is stored as float
    points.push_back(
        {static_cast<float>(metres(random)), metres(random), std::round(metres(random))});
  }
  return points;
}

struct Encoded {
  const char* name;
  PointCloud (*read)(std::string_view, const std::string&);
  std::string bytes;
};

std::vector<Encoded> all_encodings(const std::vector<CloudPoint>& points) {
  return {{"pcd ascii", read_pcd, testing::write_pcd(points, "ascii")},
          {"pcd binary", read_pcd, testing::write_pcd(points, "binary")},
          {"pcd binary_compressed", read_pcd, testing::write_pcd(points, "binary_compressed")},
          {"ply ascii", read_ply, testing::write_ply(points, "ascii")},
          {"ply little", read_ply, testing::write_ply(points, "binary_little_endian")},
          {"ply big", read_ply, testing::write_ply(points, "binary_big_endian")},
          {"xyz", read_xyz, testing::write_xyz(points)}};
}

TEST(PointCloudFiles, EveryEncodingGivesThePointsBack) {
  const auto points = some_points(500);
  for (const auto& [name, read, bytes] : all_encodings(points)) {
    const PointCloud cloud = read(bytes, name);
    ASSERT_EQ(cloud.points.size(), points.size()) << name;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_EQ(cloud.points[i][static_cast<int>(axis)], points[i][axis]) << name;
    EXPECT_EQ(cloud.skipped, 0u);
  }
}

TEST(PointCloudFiles, PointsThatAreNoNumbersAreSkippedAndCounted) {
  auto points = some_points(20);
  points[3][0] = std::nan("");
  points[7][1] = std::numeric_limits<double>::infinity();
  points[8] = {std::nan(""), std::nan(""), -std::numeric_limits<double>::infinity()};
  for (const auto& [name, read, bytes] : all_encodings(points)) {
    const PointCloud cloud = read(bytes, name);
    EXPECT_EQ(cloud.points.size(), 17u) << name;
    EXPECT_EQ(cloud.skipped, 3u) << name;
  }
}

TEST(PointCloudFiles, WindowsLineEndsAreFine) {
  int texts = 0;
  for (const auto& [name, read, bytes] : all_encodings(some_points(9))) {
    if (bytes.find('\0') != std::string::npos) continue;  // text only
    std::string windows;
    for (const char c : bytes) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(read(windows, name).points.size(), 9u) << name;
    ++texts;
  }
  EXPECT_GT(texts, 0);
}

TEST(Pcd, IntegerCoordinatesAndOldHeadersAreRead) {
  std::string file =
      "VERSION .5\nFIELDS y x z\nSIZE 2 1 4\nTYPE I U I\nWIDTH 1\nHEIGHT 1\nDATA binary\n";
  testing::append(file, std::int16_t{-300});
  testing::append(file, std::uint8_t{200});
  testing::append(file, std::int32_t{-70000});
  const PointCloud cloud = read_pcd(file, "old.pcd");
  ASSERT_EQ(cloud.points.size(), 1u);
  EXPECT_EQ(cloud.points[0], Point(200, -300, -70000));
  EXPECT_TRUE(is_pcd("# made by hand\n#.PCD v.7\n" + file));
  EXPECT_FALSE(is_pcd("# made by hand"));
}

TEST(Pcd, HeadersThatLieAreRefused) {
  const std::string good = testing::write_pcd(some_points(3), "binary");
  const std::vector<std::pair<std::string, std::string>> lies = {
      {"POINTS 3", "POINTS 4"},
      {"WIDTH 3", "WIDTH 3000000000000"},
      {"WIDTH 3\nHEIGHT 1", "WIDTH 2000000000\nHEIGHT 2000000000"},
      {"FIELDS intensity z", "FIELDS intensity q"},
      {"SIZE 1 8", "SIZE 1 7"},
      {"SIZE 1 8", "SIZE 1 -8"},
      {"COUNT 1 1 3", "COUNT 1 1 99999999999"},
      {"TYPE U F", "TYPE U G"},
      {"DATA binary", "DATA binary_squeezed"},
      {"VERSION 0.7", "VERSION"},
      {"VERSION 0.7", "COLOUR red"}};
  for (const auto& [truth, lie] : lies) {
    std::string bad = good;
    bad.replace(bad.find(truth), truth.size(), lie);
    EXPECT_THROW(read_pcd(bad, "lie.pcd"), InputError) << lie;
  }
  std::string huge = good;
  huge.replace(huge.find("WIDTH 3"), 7, "WIDTH 1000000000");
  huge.replace(huge.find("POINTS 3"), 8, "POINTS 1000000000");
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    std::string bad = huge;
    bad.replace(bad.find("DATA binary"), 11, std::string("DATA ") + data);
    EXPECT_THROW(read_pcd(bad, "huge.pcd"), InputError) << data;
  }
}

TEST(Ply, HeadersThatLieAreRefused) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string good = testing::write_ply(some_points(3), format, true);
    const std::vector<std::pair<std::string, std::string>> lies = {
        {"element vertex 3", "element vertex 4"},
        {"element vertex 3", "element vertex 99999999999999999"},
        {"element vertex 3", "element vertex -3"},
        {"element camera 2\nproperty float focal\n", "element camera 99999999999999999\n"},
        {"element camera 2", "element camera 18446744073709551615"},
        {"element vertex", "element vortex"},
        {"property float x", "property quad x"},
        {"float64 z", "float64 w"},
        {"element face 1", "element face 2"},
        {"element face 1", "element face 0"},
        {"element face", "element vertex"},
        {"1.0\n", "1.0\nproperty float x\n"},
        {"format", "former"}};
    for (const auto& [truth, lie] : lies) {
      std::string bad = good;
      bad.replace(bad.find(truth), truth.size(), lie);
      EXPECT_THROW(read_ply(bad, "lie.ply"), InputError) << lie;
    }
  }
}

TEST(Ply, FacesAreCountedWhateverTheyAreCalled) {
  const std::string file = testing::write_ply(some_points(3), "ascii", true);
  EXPECT_EQ(read_ply(testing::write_ply(some_points(3), "ascii"), "a.ply").faces, 0u);
  for (const char* name : {"element face", "element tristrips", "element polygon"}) {
    std::string named = file;
    named.replace(named.find("element face"), 12, name);
    EXPECT_EQ(read_ply(named, "a.ply").faces, 1u) << name;
  }
}

TEST(Xyz, SeparatorsAndCommentsAreRead) {
  const PointCloud cloud = read_xyz(
      "x,y,z\n# comment\n\n1 2 3\n\t4\t5\t6\n7,8,9,\n// more\n 1e1 ; +1.5;-.25\n-0 0 0", "a.xyz");
  ASSERT_EQ(cloud.points.size(), 5u);
  EXPECT_EQ(cloud.points[1], Point(4, 5, 6));
  EXPECT_EQ(cloud.points[2], Point(7, 8, 9));
  EXPECT_EQ(cloud.points[3], Point(10, 1.5, -0.25));
}

TEST(Xyz, ColumnsThatAreNamedAreFoundByTheirNames) {
  for (const char* text :
       {"x y z intensity\n1 2 3 0.5\n", "# x y z r g b\n1 2 3 255 0 7\n",
        "//X Y Z R G B\n1 2 3 9 9 9\n", "\"Gps_Time\",\"Z\",\"Y\",\"X\"\n1e9,3,2,1\n",
        "label,x,y,z,class\n,1,2,3,\n", ",x,y,z\n0,1,2,3\n", "x;;y;z\n1;;2;3\n",
        "label,x,y,z,class\n , 1,2\t, 3,7,\n", "# made by hand\n#x y z label\n1 2 3 chair\n",
        "X;Y;Z;Nx;Ny;Nz\n1;2;3;0;0;1\n"}) {
    const PointCloud cloud = read_xyz(text, "a.xyz");
    ASSERT_EQ(cloud.points.size(), 1u) << text;
    EXPECT_EQ(cloud.points[0], Point(1, 2, 3)) << text;
  }
}

/// Corners of boxes, spheres and the like begin with x, y, z too.
TEST(Xyz, ColumnsThatNothingNamesAreRefused) {
  for (const char* text :
       {"0 0 0 10 6 3\n", "0 0 0 1\n", "1 2 3\n4 5 6 7\n", "x y z\n0 0 0 10 6 3\n",
        "# x y z r g b\n1 2 3\n", "# boxes, x y z of both corners\n0 0 0 10 6 3\n",
        "x y z radius\n0 0 0 1\n", "x1 y1 z1 x2 y2 z2\n0 0 0 10 6 3\n",
        "x y z x y z\n0 0 0 10 6 3\n", "1.5 0 0 0 0 0 0 1\n"}) {
    try {
      read_xyz(text, "boxes.xyz");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("boxes.xyz: line "), std::string::npos)
          << error.what();
    }
  }
}

TEST(Xyz, BadLinesAreNamedByNumber) {
  for (const char* text :
       {"1 2 3\n4 5\n", "1 2 3\n4 5 six\n", "1 2 3\n4 5 6m\n", "1 2 3\nx y z\n", "1,2,3\n1,,2,3\n",
        "1;2;3\n;1;2;3\n", "label,x,y,z,class\n,1,1,1,2,7\n"}) {
    try {
      read_xyz(text, "bad.xyz");
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("bad.xyz: line 2"), std::string::npos)
          << error.what();
    }
  }
}

TEST(MapFromPoints, VoxelsWithPointsAreOccupiedAndTheRestOfTheBoundsFree) {
  const auto points = some_points(2000);
  PointCloud cloud;
  for (const auto& [x, y, z] : points) cloud.add(x, y, z);
  const OccupancyMap map = map_from_points(
      cloud, {.voxel_size = 0.5, .bounds = {Point::Constant(-10), Point::Constant(10)}}, "cloud");
  std::size_t inside = 0;
  std::set<VoxelIndex> on_the_upper_faces;
  for (const Point& p : cloud.points) {
    const bool within = p.minCoeff() >= -10.0 && p.maxCoeff() <= 10.0;
    inside += within ? 1 : 0;
    if (within && p.maxCoeff() == 10.0) on_the_upper_faces.insert(voxel_at(p, 0.5));
    EXPECT_EQ(testing::state_at(map, voxel_at(p, 0.5)),
              within ? VoxelState::kOccupied : VoxelState::kUnknown);
  }
  EXPECT_GT(inside, 10u);
  EXPECT_EQ(count_voxels(map).known(), 64000u + on_the_upper_faces.size());
  EXPECT_LE(count_voxels(map).occupied, inside);
}

TEST(MapFromPoints, PointsThatAreLeftOutAreTold) {
  PointCloud cloud;
  for (const double x : {500.0, 1000.0, 0.5}) cloud.add(x, 0.5, 0.5);  // millimetres, and a speck
  cloud.add(std::nan(""), 0, 0);
  const CloudMapConfig config{.voxel_size = 0.5, .bounds = {Point::Zero(), Point::Constant(1)}};
  LoadNotes notes;
  map_from_points(cloud, config, "cloud", &notes);
  ASSERT_EQ(notes.notes.size(), 2u);
  EXPECT_EQ(notes.notes[0], "1 of 4 points were skipped: a coordinate is not finite");
  EXPECT_EQ(
      notes.notes[1],
      "2 of 3 points lie outside of the bounds and are left out; all points span 0.5,0.5,0.5 to "
      "1000,0.5,0.5: are the bounds in metres, and the points too?");
  // One on the bounds is not outside of them.
  cloud = {};
  cloud.add(1, 1, 1);
  cloud.add(0.2, 0.2, 0.2);
  LoadNotes none;
  map_from_points(cloud, config, "cloud", &none);
  EXPECT_TRUE(none.notes.empty());
  CloudMapConfig negative = config;
  negative.margin = -1;
  EXPECT_THROW(map_from_points(cloud, negative, "cloud"), InputError);
}

/// Who takes the extent of a cloud for its bounds has points on all of them.
TEST(MapFromPoints, PointsOnTheBoundsAndInVoxelsThatTheyCutThroughAreObstacles) {
  for (const double wall : {4.0, 4.03}) {  // on a plane of the lattice, and within a voxel
    PointCloud cloud;
    for (double y = 0.05; y < 2.0; y += 0.1)
      for (double z = 0.05; z < 2.0; z += 0.1)
        for (const double x : {0.0, wall}) cloud.add(x, y, z);
    cloud.add(4.09, 1.0, 1.0);  // outside, in a voxel that the bounds cut through
    const Box bounds{Point::Zero(), Point(wall == 4.0 ? wall : 4.05, 2.0, 2.0)};
    for (const int filter : {0, 2}) {
      LoadConfig config;
      config.voxel_size = 0.1;
      config.bounds = bounds;
      config.isolated_below = filter;
      const TemporaryFolder folder;
      std::string text;
      for (const Point& p : cloud.points)
        text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) +
                "\n";
      write_whole(folder / "walls.xyz", text);
      LoadNotes notes;
      const OccupancyMap map = load_map(folder / "walls.xyz", config, &notes);
      for (int y = 0; y < 20; ++y)
        for (int z = 0; z < 20; ++z) {
          EXPECT_EQ(testing::state_at(map, {40, y, z}), VoxelState::kOccupied);
          EXPECT_EQ(testing::state_at(map, {39, y, z}), VoxelState::kFree);
          EXPECT_EQ(testing::state_at(map, {41, y, z}), VoxelState::kUnknown);
        }
      EXPECT_EQ(count_voxels(map).known(), 41u * 20u * 20u);
      EXPECT_TRUE(std::any_of(notes.notes.begin(), notes.notes.end(), [](const std::string& note) {
        return note.starts_with("1 of 801 points lie outside");
      }));
    }
  }
}

/// 0.3 / 0.1 is less than 3, and 0.6 / 0.2 too.
TEST(MapFromPoints, PointsOnALowFaceAreObstaclesHoweverItIsRounded) {
  for (const double floor : {0.3, 0.4, 0.6, 0.7, 1.2, -0.3}) {
    PointCloud cloud;
    for (double x = 0.05; x < 3.0; x += 0.1)
      for (double y = 0.05; y < 3.0; y += 0.1) cloud.add(x, y, floor);
    const OccupancyMap map = map_from_points(
        cloud, {.voxel_size = 0.1, .bounds = {Point(0, 0, floor), Point(3, 3, floor + 2.0)}}, "a");
    EXPECT_EQ(count_voxels(crop(map, {Point(0, 0, floor), Point(3, 3, floor + 2.0)})).occupied,
              900u)
        << floor;
  }
}

TEST(MapFromPoints, RefusesPointsBeyondTheLattice) {
  PointCloud cloud;
  cloud.add(0, 0, 0);
  cloud.add(0, 0, 3e8);
  const CloudMapConfig config{.voxel_size = 0.1,
                              .bounds = {Point::Constant(-1), Point::Constant(1)}};
  EXPECT_THROW(map_from_points(cloud, config, "far"), InputError);
}

TEST(MapFromPoints, IsMovedByWhatMovesNoPointsApart) {
  PointCloud cloud;
  cloud.points = {{1.0, 1.0, 1.0}};
  CloudMapConfig config;
  config.voxel_size = 0.1;
  config.bounds = {Point::Zero(), Point::Constant(2.0)};
  config.T_map_cloud.linear() *= 2.0;
  EXPECT_THROW(map_from_points(cloud, config, "cloud", nullptr), InputError);
}

}  // namespace
}  // namespace ridgeway
