// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>

#include "program.hpp"

namespace ridgeway {
namespace {

class CliBench : public Program {
 protected:
  /// A room of 4 x 4 x 2 m.
  std::string room() {
    std::string planes = "name: room\nplanes:\n";
    const char* const ends[] = {"[0, 0, 0]", "[4, 4, 2]"};
    const char* const normals[][2] = {
        {"[1, 0, 0]", "[-1, 0, 0]"}, {"[0, 1, 0]", "[0, -1, 0]"}, {"[0, 0, 1]", "[0, 0, -1]"}};
    for (const auto& axis : normals)
      for (int end = 0; end < 2; ++end)
        planes.append("  - {point: ")
            .append(ends[end])
            .append(", normal: ")
            .append(axis[end])
            .append("}\n");
    write_whole(folder_ / "room.yaml", planes);
    return path("room.yaml");
  }
};

TEST_F(CliBench, NoisePrintsWritesAndDraws) {
  const Outcome outcome = run({"bench", "noise", "--world", room(), "--volume", "0,0,0,4,4,2",
                               "--voxel-sizes", "0.1,0.2", "--sigmas", "0.05", "--scans", "20",
                               "--pairs", "10", "--queries", "5", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json["pairs"], 10);
  EXPECT_GE(json["size_ratio"], 1.0);
  ASSERT_EQ(json["rows"].size(), 4u);
  const auto row = json["rows"][1];
  for (const char* key :
       {"voxel_size", "source", "sigma", "diagram_voxels", "vertices", "edges", "components",
        "traversable_components", "cycles", "success", "length_ratio", "scan_milliseconds"})
    EXPECT_TRUE(row.contains(key)) << key;
  EXPECT_EQ(row["sigma"], 0.05);
  EXPECT_EQ(row["success"], 1.0);
  EXPECT_EQ(json["rows"][0]["source"], "truth");
  for (const char* file : {"noise.json", "noise.csv", "noise_elements.png", "noise_elements.svg",
                           "noise_maps.png", "noise_maps.svg"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
  const std::string csv = read_whole(folder_ / "out/noise.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_NE(csv.find("length_ratio.p95"), std::string::npos);
}

TEST_F(CliBench, FusionComparesWithPlainLoops) {
  const Outcome outcome = run(
      {"bench", "fusion", "--world", room(), "--volume", "0,0,0,4,4,2", "--scans", "5", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0]["integrator"], "projective");
  EXPECT_GT(rows[0]["times_as_fast"], 0.0);
}

TEST_F(CliBench, MazeHasARowForEveryPlanner) {
  const Outcome outcome =
      run({"bench", "maze", "--cells", "3", "--voxel-size", "0.15", "--pairs", "4", "--long-pairs",
           "1", "--time-limit", "0.3", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 7u);
  for (const auto& row : rows) {
    EXPECT_EQ(row["solved"], row["queries"]) << row["planner"];
    EXPECT_GT(row["single"]["length"], 6.0) << row["planner"];
  }
  EXPECT_EQ(rows[3]["planner"], "esdf");
  EXPECT_EQ(rows[3]["length_over_esdf"]["median"], 1.0);
  EXPECT_EQ(rows[6]["planner"], "graph");
  EXPECT_LE(rows[6]["length"]["median"], rows[5]["length"]["median"]);
  EXPECT_GT(read_whole(folder_ / "out/maze_graph.png").size(), 1000u);
}

TEST_F(CliBench, TrajectoryHasARowForEveryMapAndNoViolation) {
  const std::string map = std::string(RIDGEWAY_DATA_DIR) + "/fr_079.bt";
  const Outcome outcome = run({"bench", "trajectory", map, "--worlds", "hall", "--voxel-size",
                               "0.2", "--queries", "5", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["map"], "hall");
  EXPECT_EQ(rows[1]["map"], "fr_079");
  for (const auto& row : rows) {
    EXPECT_EQ(row["queries"], 5);
    EXPECT_EQ(row["solved"], 5);
    EXPECT_EQ(row["violations"], 0);
    EXPECT_EQ(row["longer_than_stop_and_go"], 0);
    EXPECT_LE(row["duration_over_stop_and_go"]["median"], 1.0);
    EXPECT_GT(row["seconds"]["p95"], 0.0);
    EXPECT_EQ(row["fallbacks"].get<int>() + row["steps"]["smooth"].get<int>(), 5);
    EXPECT_TRUE(row["plain_spline"].contains("success"));
  }
  for (const char* file : {"trajectory.json", "trajectory.csv", "trajectory_durations.png",
                           "trajectory_hall.svg", "trajectory_fr_079.png"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
}

TEST_F(CliBench, BadArgumentsAreRefused) {
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "none"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "moon"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "none", path("none.bt")}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--min-clearance", "-1"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--max-speed", "0"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "hall,hall"}).code, 1);
  EXPECT_EQ(run({"bench", "maze", "--min-clearance", "2"}).code, 1);
  EXPECT_EQ(run({"bench"}).code, 1);
  EXPECT_EQ(run({"bench", "noise", "--world", path("none.yaml")}).code, 1);
  EXPECT_EQ(run({"bench", "noise", "--world", room(), "--voxel-sizes", "-1"}).code, 1);
  write_whole(folder_ / "file", "x");
  EXPECT_EQ(run({"bench", "noise", "--world", room(), "-o", path("file")}).code, 1);
  EXPECT_EQ(run({"bench", "fusion", "--world", room(), "--volume", "1,2,3"}).code, 1);
}

}  // namespace
}  // namespace ridgeway
