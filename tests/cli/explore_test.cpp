// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "program.hpp"

namespace ridgeway {
namespace {

class CliExplore : public Program {
 protected:
  /// One room of 5 x 4 x 2.4 m.
  std::string room() {
    write_whole(folder_ / "room.yaml",
                "name: room\n"
                "planes:\n"
                "  - {point: [0, 0, 0], normal: [1, 0, 0]}\n"
                "  - {point: [5, 0, 0], normal: [-1, 0, 0]}\n"
                "  - {point: [0, 0, 0], normal: [0, 1, 0]}\n"
                "  - {point: [0, 4, 0], normal: [0, -1, 0]}\n"
                "  - {point: [0, 0, 0], normal: [0, 0, 1]}\n"
                "  - {point: [0, 0, 2.4], normal: [0, 0, -1]}\n");
    return path("room.yaml");
  }
  std::vector<std::string> words(const std::string& start) {
    return {"explore", room(),     "-o",  path("room.ridge"), "--start", start, "--width",
            "80",      "--radius", "0.2", "--max-distance",   "2"};
  }
};

TEST_F(CliExplore, WritesAllThatIsAskedFor) {
  std::vector<std::string> all = words("1.3,1.3,1.2");
  for (const char* option : {"--flight", "flight.csv", "--volume", "volume.csv", "--picture",
                             "room.svg", "--record", "frames"}) {
    const std::string word = option;
    all.push_back(word.starts_with("--") ? word : path(word));
  }
  all.emplace_back("--json");
  const Outcome outcome = run(all);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = outcome.json();
  EXPECT_EQ(json["complete"], true);
  EXPECT_GE(json["coverage"], 0.99);
  EXPECT_EQ(json["collisions"], 0);
  EXPECT_GE(json["nearest"], 0.0);
  EXPECT_EQ(run({"check", path("room.ridge"), "--queries", "20"}).code, 0);
  for (const char* file : {"flight.csv", "volume.csv", "room.svg", "frames/depth.txt"})
    EXPECT_FALSE(read_whole(folder_ / file).empty()) << file;
  // The recording gives a roadmap, too.
  EXPECT_EQ(run({"live", path("frames"), "-o", path("again.ridge"), "--voxel-size", "0.2"}).code,
            0);
}

TEST_F(CliExplore, ALidarIsRecordedAsScansThatLiveReads) {
  std::vector<std::string> all = words("1.3,1.3,1.2");
  for (const std::string word : {"--camera", "lidar", "--rows", "16", "--vertical-angle", "70"})
    all.push_back(word);
  all.insert(all.end(), {"--record", path("scans"), "--json"});
  const Outcome outcome = run(all);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["complete"], true);
  EXPECT_EQ(outcome.json()["collisions"], 0);
  const Outcome again = run({"live", path("scans"), "-o", path("again.ridge"), "--voxel-size",
                             "0.2", "--max-range", "2"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("points beyond --max-range"), std::string::npos) << again.err;
}

TEST_F(CliExplore, SaysThatAFlightWasCutOff) {
  std::vector<std::string> all = words("1.3,1.3,1.2");
  all.insert(all.end(), {"--longest", "0.3", "--scan-rate", "4", "--json"});
  const Outcome outcome = run(all);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["end"], "cut_off");
  EXPECT_TRUE(outcome.json()["nearest"].is_number());
}

TEST_F(CliExplore, RefusesBeforeTheFlight) {
  expect_refused(words("9,1,1"), {"outside"});
  for (const std::string option : {"--rows", "--vertical-angle"}) {
    std::vector<std::string> of_a_lidar = words("1.3,1.3,1.2");
    of_a_lidar.insert(of_a_lidar.end(), {option, "10"});
    expect_refused(of_a_lidar, {option, "is of a lidar"});
  }
  for (const std::string option : {"--least-frontier", "--spacing"}) {
    std::vector<std::string> of_frontiers = words("1.3,1.3,1.2");
    of_frontiers.insert(of_frontiers.end(), {option, "2", "--planner", "nbvp"});
    expect_refused(of_frontiers, {option, "look for frontiers"});
  }
  expect_refused(words("0.1,1,1"), {"from an obstacle"});
  std::vector<std::string> near_sighted = words("1.3,1.3,1.2");
  near_sighted.insert(near_sighted.end(), {"--max-range", "0.3"});
  expect_refused(near_sighted, {"max-range"});
  std::vector<std::string> hasty = words("1.3,1.3,1.2");
  hasty.insert(hasty.end(), {"--budget", "1"});
  expect_refused(hasty, {"budget"});
  std::vector<std::string> greedy = words("1.3,1.3,1.2");
  greedy.insert(greedy.end(), {"--budget", "20", "--planner", "nbvp"});
  expect_refused(greedy, {"budget", "no other comes back"});
  std::vector<std::string> slow = words("1.3,1.3,1.2");
  slow.insert(slow.end(), {"--budget", "6", "--scan-rate", "0.1"});
  expect_refused(slow, {"budget", "between two images"});
  write_whole(folder_ / "open.yaml", "name: open\nspheres:\n  - {centre: [0, 0, 0], radius: 1}\n");
  expect_refused({"explore", path("open.yaml"), "-o", path("x.ridge"), "--start", "0,0,0"},
                 {"inside an obstacle"});
}

/// A folder that is written whole in the end has no room for other files.
TEST_F(CliExplore, OutputsLieOutsideOfTheRecording) {
  std::filesystem::create_directory(folder_ / "run");
  std::vector<std::string> inside = words("1.3,1.3,1.2");
  inside.insert(inside.end(), {"--record", path("run"), "--flight", path("run/flight.csv")});
  expect_refused(inside, {"run/flight.csv", "lies in"});
  std::vector<std::string> same = words("1.3,1.3,1.2");
  same.insert(same.end(), {"--record", path("room.ridge")});
  expect_refused(same, {"room.ridge", "lies in"});
}

}  // namespace
}  // namespace ridgeway
