// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "program.hpp"

namespace ridgeway {
namespace {

using CliBuild = Program;

TEST_F(CliBuild, PeakMemoryIsItsOwnNotThatOfWhoStartedIt) {
  constexpr std::uint64_t kMany = 600'000'000;
  const auto peak = [&](const std::string& name) {
    return build_rooms(name, {"--json"}).json()["peak_memory_bytes"].get<std::uint64_t>();
  };
  const std::uint64_t before = peak("a.ridge");
  const std::vector<char> held(kMany, 1);
  EXPECT_LT(peak("b.ridge"), before + kMany / 2);
  EXPECT_EQ(held.back(), 1);
}

TEST_F(CliBuild, JsonHasTheKeysThatScriptsRelyOn) {
  const Outcome built = build_rooms("rooms.ridge", {"--json"});
  ASSERT_EQ(built.code, 0) << built.err;
  const Json json = built.json();
  EXPECT_DOUBLE_EQ(json["voxel_size"], 0.1);
  EXPECT_EQ(json["voxels"]["occupied"], 28 * 20);
  EXPECT_EQ(json["voxels"]["free"], 60 * 40 * 20 - 28 * 20);
  EXPECT_TRUE(json["voxels"]["unknown"].is_number_unsigned());
  EXPECT_EQ(json["traversable"]["components"], 1);
  EXPECT_EQ(json["graph"]["components"], 1);
  EXPECT_DOUBLE_EQ(json["graph"]["min_clearance"], 0.3);
  for (const char* key : {"gvd_voxels", "edge_voxels", "kernel_voxels", "diagram_voxels",
                          "allocated_voxels", "file_bytes", "peak_memory_bytes"})
    EXPECT_GT(json[key].get<std::size_t>(), 0u) << key;
  for (const char* key : {"vertices", "edges"})
    EXPECT_GT(json["graph"][key].get<std::size_t>(), 0u) << key;
  EXPECT_GT(json["traversable"]["voxels"].get<std::size_t>(), 0u);
  for (const char* key : {"load", "esdf", "gvd", "edges", "thin", "kernel", "graph", "attach",
                          "tangents", "save", "total"})
    EXPECT_GE(json["seconds"][key].get<double>(), 0.0) << key;
  EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(path("rooms.ridge")));
}

TEST_F(CliBuild, NotesOfMeshesNameTheOptionsThatDecide) {
  const Outcome built = run({"build", std::string(RIDGEWAY_DATA_DIR) + "/levine.stl", "-o",
                             path("levine.ridge"), "--min-clearance", "0.3"});
  ASSERT_EQ(built.code, 0) << built.err;
  for (const char* words :
       {"(--units, --up)", "(--voxel-size)", "-2.3,-0.3,-0.002 to 12.8,27.3,2.5 (--bounds)",
        "(--inside 1.65,16.65,0.15 takes that one as free, all else as unknown)"})
    EXPECT_NE(built.err.find(words), std::string::npos) << words << " is not in: " << built.err;
  EXPECT_EQ(built.err.find("(option"), std::string::npos) << built.err;
}

TEST_F(CliBuild, SameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2"}) {
    const Outcome built = run({"build", kScan, "-o", path(threads) + ".ridge", "--min-clearance",
                               "0.3", "--threads", threads, "--quiet"});
    ASSERT_EQ(built.code, 0) << built.err;
  }
  EXPECT_TRUE(read_whole(folder_ / "1.ridge") == read_whole(folder_ / "2.ridge"));
}

TEST_F(CliBuild, SummaryIsForPeopleAndNotesGoToStderr) {
  const Outcome built = build_rooms("rooms.ridge");
  EXPECT_NE(built.out.find("graph"), std::string::npos);
  EXPECT_NE(built.err.find("does not record free space"), std::string::npos) << built.err;
  EXPECT_EQ(built.err.find('\r'), std::string::npos) << "progress without a terminal";
  EXPECT_EQ(build_rooms("rooms.ridge", {"--quiet"}).err, "");
}

TEST_F(CliBuild, WarnsOfVoxelsTooCoarseForTheRobot) {
  const Outcome built = build_rooms("rooms.ridge", {"--voxel-size", "0.2", "--json"});
  EXPECT_EQ(built.code, 1) << "an option given twice";
  const Outcome coarse = run({"build", two_rooms(), "-o", path("rooms.ridge"), "--voxel-size",
                              "0.2", "--bounds", "-3,-2,0,3,2,2", "--min-clearance", "0.3"});
  EXPECT_EQ(coarse.code, 0) << coarse.err;
  EXPECT_NE(coarse.err.find("warning: --min-clearance 0.3"), std::string::npos) << coarse.err;
}

TEST_F(CliBuild, RepeatedBuildsGiveTheSameFile) {
  ASSERT_EQ(build_rooms("once.ridge").code, 0);
  const Outcome built = build_rooms("thrice.ridge", {"--repeat", "3", "--json"});
  EXPECT_EQ(built.json()["repeat"], 3);
  EXPECT_TRUE(read_whole(folder_ / "once.ridge") == read_whole(folder_ / "thrice.ridge"));
}

TEST_F(CliBuild, CameraAxesAndTheirMatrixAreTheSame) {
  // A wall 2 m before the camera: z forward, x right, y down.
  std::string points;
  for (int x = -10; x < 10; ++x)
    for (int y = -10; y < 10; ++y)
      points += std::to_string(0.1 * x + 0.05) + "," + std::to_string(0.1 * y + 0.05) + ",2.05\n";
  write_whole(folder_ / "camera.xyz", points);
  const std::vector<std::string> transforms = {"camera", "0,0,1,0,-1,0,0,0,0,-1,0,0,0,0,0,1",
                                               "0,0,0,-90,0,-90"};
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    const std::string out = path(std::to_string(i) + ".ridge");
    const Outcome built =
        run({"build", path("camera.xyz"), "-o", out, "--voxel-size", "0.1", "--bounds",
             "0,-1,-1,3,1,1", "--min-clearance", "0.2", "--transform", transforms[i], "--json"});
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_EQ(built.json()["voxels"]["occupied"], 20 * 20) << transforms[i];
    const Outcome beyond = run({"plan", out, "--from", "0.5,0,0", "--to", "2.6,0,0"});
    EXPECT_EQ(beyond.code, 2) << "the wall must close the way forward";
  }
}

TEST_F(CliBuild, NoFlyBoxesMayBeRepeated) {
  const Outcome built = build_rooms(
      "rooms.ridge", {"--exclude", "-3,-2,0,-2,2,2", "--exclude", "2,-2,0,3,2,2", "--json"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.json()["voxels"]["occupied"], 28 * 20 + 2 * 10 * 40 * 20);
}

TEST_F(CliBuild, SourceIsNamedWithoutItsFolder) {
  const Json info = run({"info", rooms(), "--json"}).json();
  EXPECT_EQ(info["source"], "rooms.xyz");
  EXPECT_EQ(info["config"]["bounds"], "-3,-2,0,3,2,2");
}

}  // namespace
}  // namespace ridgeway
