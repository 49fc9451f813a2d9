// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.hpp"
#include "recordings/depth_png.hpp"

namespace ridgeway {
namespace {

class CliBadInput : public Program {
 protected:
  void expect_build_refused(const std::string& map, const std::vector<std::string>& options,
                            const std::vector<std::string>& words) {
    std::vector<std::string> arguments = {"build", map, "-o", path("out.ridge")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused(arguments, words);
  }

  /// A recording of one good image, 64 x 48, and a second one.
  std::string record(const std::string& second_pose) {
    const std::filesystem::path run = folder_ / "run";
    std::filesystem::create_directories(run);
    const DepthImage wall{64, 48, std::vector<float>(64 * 48, 2.0f)};
    write_depth_png(wall, run / "a.png", 5000.0);
    write_depth_png(wall, run / "b.png", 5000.0);
    write_whole(run / "camera-intrinsics.txt", "58 0 31.5\n0 58 23.5\n0 0 1\n");
    write_whole(run / "depth.txt", "0 a.png\n1 b.png\n");
    write_whole(run / "groundtruth.txt", "0 0 0 0 0 0 0 1\n1 " + second_pose + "\n");
    return run.string();
  }

  /// An OctoMap of eight occupied voxels about (0.1, 0.1, 0.1): one path of inner nodes.
  std::string write_occupied_octomap() {
    std::string bytes = "# Octomap OcTree binary file\nid OcTree\nsize 24\nres 0.1\ndata\n";
    bytes += std::string("\x00\xc0", 2);
    for (int depth = 1; depth < 15; ++depth) bytes += std::string("\x03\x00", 2);
    bytes += "\xaa\xaa";
    write_whole(folder_ / "solid.bt", bytes);
    return path("solid.bt");
  }
};

TEST_F(CliBadInput, MissingFile) {
  expect_build_refused(path("none.bt"), {}, {"none.bt", "no such file"});
}

TEST_F(CliBadInput, EmptyFile) {
  write_whole(folder_ / "empty.bt", "");
  expect_build_refused(path("empty.bt"), {}, {"empty.bt", "is empty"});
}

TEST_F(CliBadInput, TruncatedMap) {
  write_whole(folder_ / "short.bt", read_whole(kScan).substr(0, 300000));
  expect_build_refused(path("short.bt"), {}, {"short.bt"});
}

TEST_F(CliBadInput, FileOfNoKnownFormat) {
  write_whole(folder_ / "song.bt", std::string("\x7f\x45\x4c\x46\x00\x01", 6));
  expect_build_refused(path("song.bt"), {}, {"song.bt", ".pcd"});
  expect_refused({"info", path("song.bt")}, {"song.bt", ".pcd"});
}

TEST_F(CliBadInput, RoadmapInPlaceOfAMap) {
  expect_build_refused(rooms(), {}, {"rooms.ridge", "is a roadmap already"});
}

TEST_F(CliBadInput, MapInPlaceOfARoadmap) {
  expect_refused({"plan", kScan, "--from", "0,0,0", "--to", "1,0,0"}, {"fr_079.bt", "build"});
}

TEST_F(CliBadInput, FolderInPlaceOfAFile) {
  expect_build_refused(folder_.path().string(), {}, {"is a folder", "fused"});
  expect_refused({"info", folder_.path().string()}, {"holds no recording"});
  expect_refused({"check", folder_.path().string()}, {folder_.path().string()});
}

TEST_F(CliBadInput, OctomapWithoutFreeSpace) {
  expect_build_refused(write_occupied_octomap(), {}, {"solid.bt", "free space"});
}

TEST_F(CliBadInput, CloudWithoutBoundsOrVoxelSize) {
  const std::string cloud = two_rooms();
  expect_build_refused(cloud, {"--voxel-size", "0.1"}, {"rooms.xyz", "--bounds"});
  expect_build_refused(cloud, {}, {"rooms.xyz", "--voxel-size", "--bounds"});
}

TEST_F(CliBadInput, PointsThatAreNotFiniteAreSkippedAndCounted) {
  write_whole(folder_ / "holes.xyz", read_whole(two_rooms()) + "nan 0 0\n0 inf 1\n");
  std::vector<std::string> arguments = {"build", path("holes.xyz"), "-o", path("holes.ridge")};
  for (const std::string& option : room_options()) arguments.push_back(option);
  const Outcome built = run(arguments);
  EXPECT_EQ(built.code, 0) << built.err;
  EXPECT_NE(built.err.find("2 of 562 points"), std::string::npos) << built.err;
  EXPECT_EQ(run({"info", path("holes.xyz"), "--json"}).json()["skipped_points"], 2);

  write_whole(folder_ / "void.xyz", "nan nan nan\n");
  expect_build_refused(path("void.xyz"), room_options(), {"void.xyz", "finite"});
}

TEST_F(CliBadInput, FramesThatWouldSpoilAMapAreNamed) {
  const auto expect_fuse_refused = [&](const std::string& run,
                                       const std::vector<std::string>& words) {
    expect_refused({"fuse", run, "-o", path("map.ridge")}, words);
  };
  expect_fuse_refused(record("1e300 0 0 0 0 0 1"), {"b.png", "pose", "1e9 voxels"});
  expect_fuse_refused(record("0 0 0 0 0 0 2"), {"groundtruth.txt line 2", "quaternion"});
  const std::string run = record("0 0 0 0 0 0 1");
  write_depth_png({32, 24, std::vector<float>(32 * 24, 2.0f)}, folder_ / "run/b.png", 5000.0);
  expect_fuse_refused(run, {"b.png", "32 x 24", "64 x 48"});
  expect_refused({"fuse", run, "-o", path("run/depth.txt")}, {"depth.txt", "recording"});
  expect_refused({"fuse", run, "-o", path("no/map.ridge")}, {"no/map.ridge", "folder"});
  for (const char* size : {"1e-9", "1e9", "1e-6", "1e-5", "11", "nan"})
    expect_refused({"fuse", run, "-o", path("map.ridge"), "--voxel-size", size}, {"voxel"});
  expect_refused({"fuse", run, "-o", path("map.ridge"), "--truncation", "0.05"}, {"truncation"});
  for (const char* image : {"run/a.png", "run/b.png"}) write_whole(folder_ / image, "no image");
  expect_fuse_refused(run, {"no image that can be read", "a.png"});
  for (const char* image : {"run/a.png", "run/b.png"})
    write_depth_png({64, 48, std::vector<float>(64 * 48, 0.0f)}, folder_ / image, 5000.0);
  expect_fuse_refused(run, {"shows no free space"});
}

TEST_F(CliBadInput, PlacesThatAreNoPoints) {
  const std::string map = rooms();
  for (const char* bad : {"nan,0,1", "inf,0,1", "1,2", "1,2,3,4", "a,b,c", ""})
    expect_refused({"plan", map, "--from", bad, "--to", "1,0,1"}, {"--from"});
  expect_refused({"plan", map, "--from", "1,0,1", "--to", "0,-inf,1"}, {"--to '0,-inf,1'"});
}

TEST_F(CliBadInput, ValuesOutOfRange) {
  const std::string map = rooms();
  for (const char* radius : {"-0.3", "0", "nan", "inf"})
    expect_refused({"plan", map, "--from", "1,0,1", "--to", "2,0,1", "--radius", radius},
                   {"radius"});
  expect_refused({"plan", map, "--from", "1,0,1", "--to", "2,0,1", "--time-limit", "-1"},
                 {"--time-limit"});
  for (const char* clearance : {"-1", "0", "nan", "inf"})
    expect_build_refused(kScan, {"--min-clearance", clearance}, {"--min-clearance"});
  expect_build_refused(kScan, {"--min-clearance", "9"}, {"--min-clearance 9", "smaller"});
  for (const char* size : {"-1", "0", "nan", "inf"})
    expect_build_refused(kScan, {"--voxel-size", size}, {"--voxel-size"});
  expect_build_refused(kScan, {"--voxel-size", "0.01"}, {"finer"});
  expect_build_refused(kScan, {"--bounds", "1,0,0,0,1,1"}, {"--bounds"});
  expect_build_refused(kScan, {"--bounds", "0,0,0,1,1"}, {"--bounds", "x0,y0,z0"});
  expect_build_refused(kScan, {"--bounds", "90,90,90,91,91,91"},
                       {"fr_079.bt", "within the bounds"});
  expect_build_refused(kScan, {"--exclude", "0,0,0,nan,1,1"}, {"--exclude"});
  expect_build_refused(kScan, {"--transform", "1,2,3"}, {"--transform", "camera"});
  expect_build_refused(kScan, {"--transform", "2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1"}, {"transform"});
  expect_build_refused(kScan, {"--transform", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,1,1"}, {"transform"});
  expect_build_refused(kScan, {"--isolated", "-4"}, {"--isolated"});
}

TEST_F(CliBadInput, MoreMemoryThanTheMachineHas) {
  expect_build_refused(two_rooms(), {"--voxel-size", "0.0005", "--bounds", "-30,-30,-30,30,30,30"},
                       {"memory", "--voxel-size"});
}

TEST_F(CliBadInput, OutputThatCannotBeWritten) {
  const std::string cloud = two_rooms();
  std::vector<std::string> arguments = {"build", cloud, "-o", path("no/such/out.ridge")};
  for (const std::string& option : room_options()) arguments.push_back(option);
  expect_refused(arguments, {"no/such/out.ridge", "folder"});
  arguments[3] = folder_.path().string();
  expect_refused(arguments, {folder_.path().string()});
  if (::geteuid() != 0) {
    std::filesystem::create_directory(folder_ / "locked");
    std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::owner_read);
    arguments[3] = path("locked/out.ridge");
    expect_refused(arguments, {"locked/out.ridge"});
    std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::owner_all);
  }
  const std::string map = rooms();
  expect_refused({"plan", map, "--from", "1,0,1", "--to", "2,0,1", "-o", path("no/path.csv")},
                 {"no/path.csv"});
  expect_refused({"plan", map, "--from", "1,0,1", "--to", "2,0,1", "-o", path("path.txt")},
                 {"path.txt", ".csv"});
  expect_refused({"check", map, "--paths", path("no/paths.json")}, {"no/paths.json"});
}

TEST_F(CliBadInput, DamagedRoadmap) {
  const std::string whole = read_whole(rooms());
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x10);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"flipped.ridge", damaged},
      {"short.ridge", whole.substr(0, whole.size() / 2)},
      {"head.ridge", whole.substr(0, 20)},
      {"empty.ridge", ""},
      {"text.ridge", "RIDGEWAY is a word\n"}};
  for (const auto& [name, bytes] : files) {
    write_whole(folder_ / name, bytes);
    expect_refused({"plan", path(name), "--from", "1,0,1", "--to", "2,0,1"}, {name});
    expect_refused({"info", path(name)}, {name});
    expect_refused({"check", path(name)}, {name});
    expect_refused({"export", path(name), "--picture", path("out.png")}, {name});
  }
}

TEST_F(CliBadInput, OutputThatIsTheInput) {
  const std::string cloud = two_rooms(), before = read_whole(folder_ / "rooms.xyz");
  std::vector<std::string> arguments = {"build", cloud, "-o", path("./rooms.xyz")};
  for (const std::string& option : room_options()) arguments.push_back(option);
  expect_refused(arguments, {"rooms.xyz", "is read"});
  EXPECT_EQ(read_whole(folder_ / "rooms.xyz"), before);
  const std::string map = rooms();
  expect_refused({"check", map, "--paths", map}, {"is read"});
  expect_refused({"export", map, "--json-graph", map}, {"is read"});
  write_whole(folder_ / "path.json", "[[1, 0, 1], [2, 0, 1]]");
  expect_refused({"export", map, "--json-graph", path("path.json"), "--picture", path("map.png"),
                  "--path", path("path.json")},
                 {"path.json", "is read"});
  EXPECT_EQ(read_whole(folder_ / "path.json"), "[[1, 0, 1], [2, 0, 1]]");
  expect_refused({"export", map, "-o", path("graph.json"), "--json-graph", path("./graph.json")},
                 {"graph.json", "twice"});
}

TEST_F(CliBadInput, PipesInPlaceOfFiles) {  // opening one would wait for a writer
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  expect_build_refused(path("pipe"), {}, {"pipe", "regular file"});
  expect_refused({"info", path("pipe")}, {"pipe", "regular file"});
  expect_refused({"plan", path("pipe"), "--from", "1,0,1", "--to", "2,0,1"}, {"pipe"});
  expect_refused({"plan", rooms(), "--queries", path("pipe")}, {"pipe", "regular file"});
}

TEST_F(CliBadInput, QueryFiles) {
  const std::string map = rooms();
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"", "is empty"},
           {"# nothing\n", "no query"},
           {"x,y,z,x,y,z\n1,0,1,2,0,1\n1,0,1,2,0\n", "line 3"},
           {"1,0,1,2,0,1,-0.3\n", "line 1"},
           {"1,0,1,2,0,1\nx,y,z,x,y,z\n", "line 2"},
           {"nan,0,1,2,0,1\n", "line 1"}}) {
    write_whole(folder_ / "queries.csv", text);
    expect_refused({"plan", map, "--queries", path("queries.csv")}, {"queries.csv", word});
  }
  expect_refused({"plan", map, "--queries", folder_.path().string()}, {"is a folder"});
}

TEST_F(CliBadInput, CheckOptions) {
  const std::string map = rooms();
  for (const char* bad : {"-1", "1.5", "many", "1000000000"})
    expect_refused({"check", map, "--queries", bad}, {"--queries"});
  for (const char* bad : {"-1", "1.5", "any", "99999999999999999999999"})
    expect_refused({"check", map, "--seed", bad}, {"--seed"});
  for (const char* bad : {"0.5", "nan", "better", ""})
    expect_refused({"check", map, "--quality", bad}, {"--quality"});
}

TEST_F(CliBadInput, FileThatMayNotGrow) {
  const std::string cloud = two_rooms();
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const struct rlimit small = {4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  std::vector<std::string> options = room_options();
  options.emplace_back("--quiet");
  expect_build_refused(cloud, options, {"out.ridge", "cannot be written"});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
}

TEST_F(CliBadInput, KeepsAnOlderFileWhenABuildFails) {
  write_whole(folder_ / "old.ridge", "as it was");
  EXPECT_EQ(run({"build", write_occupied_octomap(), "-o", path("old.ridge")}).code, 1);
  EXPECT_EQ(read_whole(folder_ / "old.ridge"), "as it was");
}

}  // namespace
}  // namespace ridgeway
