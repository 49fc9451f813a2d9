// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>

#include "program.hpp"

namespace ridgeway {
namespace {

using CliCheck = Program;
using CliInfo = Program;
using CliExport = Program;
using CliProgram = Program;

TEST_F(CliCheck, JsonHasTheKeysThatScriptsRelyOn) {
  const Outcome checked = run({"check", rooms(), "--queries", "20", "--seed", "3", "--json",
                               "--paths", path("paths.json")});
  ASSERT_EQ(checked.code, 0) << checked.out;
  const Json json = checked.json();
  EXPECT_EQ(json["queries"], 20);
  EXPECT_EQ(json["graph_ok"], json["esdf_ok"]);
  for (const char* key : {"edges_below_clearance", "disagreements", "paths_below_clearance"})
    EXPECT_EQ(json[key], 0) << key;
  for (const char* key : {"edges", "components"}) EXPECT_GT(json[key].get<int>(), 0) << key;
  for (const char* key : {"median", "p95", "p99", "max"}) {
    EXPECT_GE(json["length_ratio"][key].get<double>(), 1.0) << key;
    EXPECT_GT(json["microseconds"][key].get<double>(), 0.0) << key;
    EXPECT_GT(json["raw_microseconds"][key].get<double>(), 0.0) << key;
    EXPECT_GT(json["esdf_milliseconds"][key].get<double>(), 0.0) << key;
  }
  EXPECT_TRUE(json["fallbacks"].is_number_unsigned());

  const Json paths = Json::parse(read_whole(folder_ / "paths.json"));
  ASSERT_EQ(paths.size(), json["graph_ok"].get<std::size_t>());
  EXPECT_GE(paths[0]["radius"].get<double>(), 0.3);
  EXPECT_EQ(paths[0]["waypoints"][0].size(), 3u);
}

TEST_F(CliCheck, MeasuresTheAnswersOfAQuality) {
  const std::string map = rooms();
  const auto length_of = [&](const char* quality) {
    const Outcome checked = run({"check", map, "--queries", "200", "--quality", quality, "--json"});
    EXPECT_EQ(checked.code, 0) << checked.err;
    const Json json = checked.json();
    EXPECT_TRUE(json["clean"]);
    return json["length_ratio"]["p95"].get<double>();
  };
  const double quick = length_of("quick"), best = length_of("best");
  EXPECT_LE(best, length_of("default"));
  EXPECT_LT(best, quick);
  EXPECT_LE(length_of("1.5"), quick);
}

TEST_F(CliInfo, TellsWhatARecordingHolds) {
  const std::string house = RIDGEWAY_WORLDS_DIR "/house.yaml", images = path("images");
  ASSERT_EQ(run({"simulate", house, "-o", images, "--frames", "5"}).code, 0);
  const Json json = run({"info", images, "--json"}).json();
  EXPECT_EQ(json["layout"], "tum");
  EXPECT_EQ(json["topics"][0], Json({{"name", "depth"}, {"type", "depth_image"}, {"count", 5}}));
  EXPECT_EQ(json["camera"]["width"], 320);
  EXPECT_NEAR(json["seconds"].get<double>(), 0.4, 1e-6);
  EXPECT_GT(json["sensor"]["length"].get<double>(), 0.0);
  EXPECT_NE(run({"info", images}).out.find("5 with a pose, 0 without"), std::string::npos);

  std::filesystem::remove(folder_ / "images/camera-intrinsics.txt");
  const Outcome without = run({"info", images});
  EXPECT_NE(without.out.find("--intrinsics"), std::string::npos) << without.out;
  EXPECT_NE(without.err.find("camera-intrinsics.txt"), std::string::npos) << without.err;
  std::filesystem::remove(folder_ / "images/groundtruth.txt");
  expect_refused({"info", images}, {"groundtruth.txt"});

  std::filesystem::create_directory(folder_ / "scans");
  write_whole(folder_ / "scans/a.xyz", "1 2 3\n");
  write_whole(folder_ / "scans/poses.txt", "a.xyz 0 0 0 0 0 0 1\n");
  EXPECT_EQ(run({"info", path("scans"), "--json"}).json()["topics"][0],
            Json({{"name", "scans"}, {"type", "point_cloud"}, {"count", 1}}));
}

TEST_F(CliInfo, TellsOfARoadmap) {
  const std::string map = rooms();
  const Outcome told = run({"info", map, "--json"});
  ASSERT_EQ(told.code, 0) << told.err;
  const Json json = told.json();
  EXPECT_EQ(json["format"], "ridge");
  EXPECT_DOUBLE_EQ(json["voxel_size"], 0.1);
  EXPECT_EQ(json["unknown_policy"], "obstacle");
  EXPECT_NEAR(json["bounds"]["max"][0].get<double>(), 3.0, 1e-9);
  EXPECT_EQ(json["graph"]["components"], 1);
  ASSERT_EQ(json["components"].size(), 1u);
  EXPECT_GT(json["components"][0]["clearance"].get<double>(), 0.9);
  EXPECT_GT(json["memory_bytes"]["total"].get<std::size_t>(), 0u);
  EXPECT_NE(run({"info", map}).out.find("component 1"), std::string::npos);
}

TEST_F(CliInfo, TellsWhereASmallerRobotWouldFindPartsJoined) {
  const Outcome built =
      build_rooms("tight.ridge", {"--exclude", "0,-2,0,0.1,0,2", "--exclude", "0,0.5,0,0.1,2,2"});
  ASSERT_EQ(built.code, 0) << built.err;
  const Json json = run({"info", path("tight.ridge"), "--json"}).json();
  ASSERT_EQ(json["components"].size(), 2u);
  ASSERT_EQ(json["joins"].size(), 1u);
  EXPECT_LT(json["joins"][0]["radius"].get<double>(), 0.3);
  EXPECT_NEAR(json["joins"][0]["place"][1].get<double>(), 0.25, 0.06);
  EXPECT_NE(run({"info", path("tight.ridge")}).out.find("would join"), std::string::npos);
}

TEST_F(CliInfo, GivesAPlanThatCanBeRun) {
  std::vector<std::string> maps = {rooms()};
  ASSERT_EQ(build_rooms("a 'tight' one.ridge", {"--exclude", "0,-2,0,0.1,2,2"}).code, 0);
  maps.push_back(path("a 'tight' one.ridge"));
  ASSERT_EQ(build_rooms("flat.ridge", {"--planar", "0.5,1.5"}).code, 0);
  maps.push_back(path("flat.ridge"));
  for (const std::string& map : maps) {
    const Outcome told = run({"info", map, "--json"});
    ASSERT_EQ(told.code, 0) << told.err;
    const Json example = told.json()["example"];
    ASSERT_EQ(example["from"].size(), 3u) << map;
    EXPECT_EQ(run({"info", map, "--json"}).json()["example"], example);
    double squared = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      squared += std::pow(example["from"][i].get<double>() - example["to"][i].get<double>(), 2);
    EXPECT_GT(std::sqrt(squared), 1.0) << map;
    const std::string out = run({"info", map}).out, start = "ridgeway plan ";
    const std::size_t at = out.find(start);
    ASSERT_NE(at, std::string::npos) << out;
    // The shell takes the printed line apart as it is.
    const std::string line = out.substr(at + start.size(), out.find('\n', at) - at - start.size());
    const Outcome planned = run({"plan"}, line + " > " + path("planned"));
    EXPECT_EQ(planned.code, 0) << line << planned.err << read_whole(folder_ / "planned");
  }
}

TEST_F(CliInfo, TellsOfMapsWithoutBuilding) {
  const Json scan = run({"info", kScan, "--json"}).json();
  EXPECT_EQ(scan["format"], "octomap_bt");
  EXPECT_DOUBLE_EQ(scan["voxel_size"], 0.05);
  EXPECT_EQ(scan["voxels"]["free"], 4807673);

  const Json cloud = run({"info", two_rooms(), "--json"}).json();
  EXPECT_EQ(cloud["format"], "xyz");
  EXPECT_EQ(cloud["points"], 28 * 20);
  EXPECT_DOUBLE_EQ(cloud["bounds"]["min"][1], -1.95);

  write_whole(folder_ / "small.3dmap", "voxel 4 4 4\n1 1 1\n");
  const Json grid = run({"info", path("small.3dmap"), "--json"}).json();
  EXPECT_EQ(grid["format"], "3dmap");
  EXPECT_EQ(grid["voxels"]["free"], 63);
}

TEST_F(CliExport, WritesEveryFormat) {
  const Outcome exported = run({"export", rooms(), "-o", path("g.json"), "-o", path("g.graphml"),
                                "-o", path("g.ply"), "-o", path("g.svg"), "--json-graph",
                                path("links.json"), "--picture", path("g.png"), "--json"});
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_EQ(exported.json()["written"].size(), 6u);
  for (const char* name : {"g.json", "g.graphml", "g.ply", "g.svg", "links.json", "g.png"})
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_EQ(read_whole(folder_ / "g.json"), read_whole(folder_ / "links.json"));
  ASSERT_EQ(run({"export", path("rooms.ridge"), "--what", "diagram", "-o", path("d.ply")}).code, 0);
  EXPECT_NE(read_whole(folder_ / "d.ply"), read_whole(folder_ / "g.ply"));
}

TEST_F(CliExport, DrawsSeveralPathsAndViews) {
  const std::string map = rooms();
  for (const char* end : {"0.5", "-0.5"})
    ASSERT_EQ(run({"plan", map, "--from=-2,0,1", std::string("--to=2,") + end + ",1", "-o",
                   path(std::string("to") + end + ".csv")})
                  .code,
              0);
  const auto draw = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {"export", map, "--picture", path("p.png")};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(run(words).code, 0);
    return read_whole(folder_ / "p.png");
  };
  std::vector<std::string> pictures = {draw({})};
  const std::vector<std::vector<std::string>> all = {
      {"--path", path("to0.5.csv"), "--path", path("to-0.5.csv")},
      {"--sides"},
      {"--section-y", "-0.3", "--narrow"},
      {"--colour", "component"}};
  for (const auto& options : all) {
    pictures.push_back(draw(options));
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i)
      EXPECT_FALSE(pictures[i] == pictures.back()) << options.front() << " and picture " << i;
  }
}

TEST_F(CliExport, RefusesWhatItCannotWriteBeforeAnyFile) {
  const std::string map = rooms();
  expect_refused({"export", map}, {"--picture"});
  expect_refused({"export", map, "-o", path("a.ply"), "-o", path("b.obj")}, {"b.obj", ".graphml"});
  expect_refused({"export", map, "--what", "diagram", "-o", path("a.json")}, {"a.json", ".ply"});
  expect_refused({"export", map, "--picture", path("a.ply")}, {"a.ply", ".png"});
  expect_refused({"export", map, "-o", path("a.json"), "--floors"}, {"--floors", "--picture"});
  expect_refused(
      {"export", map, "-o", path("a.json"), "--picture", path("a.png"), "--section-y", "20"},
      {"--section-y", "20 is outside the map", "give one from -2 to 2"});
  expect_refused({"export", map, "--picture", path("a.png"), "--path", path("none.json")},
                 {"none.json"});
}

TEST_F(CliProgram, HelpHasAnExampleForEveryCommand) {
  for (const char* command : {"build", "plan", "check", "info", "export"}) {
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find(std::string("  ridgeway ") + command), std::string::npos) << help.out;
  }
  EXPECT_EQ(run({"--version"}).code, 0);
}

TEST_F(CliProgram, BadUsageIsExitCodeOneAndOneLine) {
  expect_refused({}, {"no command"});
  expect_refused({"frobnicate"}, {"frobnicate"});
  expect_refused({"build"}, {"ridgeway build --help"});
  expect_refused({"build", kScan, "-o", path("x.ridge"), "--unknown", "maybe"}, {"maybe"});
  expect_refused({"info", kScan, "--threads", "-1"}, {"--threads"});
  expect_refused({"plan", kScan, "--from", "0,0,0"}, {"--to"});
}

TEST_F(CliProgram, ErrorsAreJsonTooWhenAskedFor) {
  const Outcome refused = run({"info", path("none.bt"), "--json"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.json()["error"].get<std::string>().find("none.bt"), std::string::npos);
  EXPECT_TRUE(refused.err.starts_with("ridgeway: error: "));
  EXPECT_TRUE(run({"--json", "build"}).json().contains("error"));
}

TEST_F(CliProgram, ResultThatCannotBeWrittenIsAnError) {
  const Outcome full = run({"info", kScan}, "> /dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find("stdout"), std::string::npos) << full.err;
}

}  // namespace
}  // namespace ridgeway
