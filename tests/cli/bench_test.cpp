// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>

#include "program.hpp"
#include "support/sanitized.hpp"

namespace ridgeway {
namespace {

const std::string kBenchmark = std::string(RIDGEWAY_DATA_DIR) + "/warframe/Simple.3dmap";

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

TEST_F(CliBench, FusionOfAWorldWithoutWallsComparesTheSameSpace) {
  write_whole(folder_ / "ground.yaml",
              "planes:\n  - {point: [0, 0, 0], normal: [0, 0, 1]}\n"
              "boxes:\n  - {centre: [2, 2, 1], size: [1, 1, 2]}\n");
  const Outcome outcome = run({"bench", "fusion", "--world", path("ground.yaml"), "--volume",
                               "0,0,1,6,6,3", "--scans", "2", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& row : rows) EXPECT_GT(row["voxels"], 1000) << row;
}

TEST_F(CliBench, MazeHasARowForEveryPlanner) {
  const Outcome outcome =
      run({"bench", "maze", "--cells", "3", "--voxel-size", "0.15", "--pairs", "4", "--long-pairs",
           "1", "--time-limit", "0.3", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 8u);
  for (const auto& row : rows) {
    EXPECT_EQ(row["solved"], row["queries"]) << row["planner"];
    EXPECT_GT(row["single"]["length"], 6.0) << row["planner"];
  }
  EXPECT_EQ(rows[3]["planner"], "esdf");
  EXPECT_EQ(rows[3]["length_over_esdf"]["median"], 1.0);
  EXPECT_EQ(rows[6]["planner"], "graph_quick");
  EXPECT_EQ(rows[7]["planner"], "graph");
  EXPECT_LE(rows[7]["length"]["median"], rows[5]["length"]["median"]);
  for (const char* file : {"maze.json", "maze.csv", "maze.png", "maze.svg"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
  EXPECT_EQ(file_count(), 5u);  // one picture of all paths; and the folder
}

TEST_F(CliBench, MazeIsPlannedOnWhatADroneHasExplored) {
  const Outcome outcome =
      run({"bench", "maze", "--explored", "--cells", "2", "--voxel-size", "0.2", "--pairs", "4",
           "--long-pairs", "0", "--repeat", "1", "--time-limit", "0.3", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = outcome.json();
  EXPECT_EQ(json["explored"], true);
  for (const auto& row : json["rows"])
    if (row["planner"] == "esdf" || row["planner"] == "graph") {
      EXPECT_EQ(row["solved"], 4) << row["planner"];
      EXPECT_GT(row["single"]["length"], 3.0) << row["planner"];
    }
}

TEST_F(CliBench, GridReproducesStoredOptimaAndReportsEveryRatio) {
  const Outcome outcome =
      run({"bench", "grid", kBenchmark, "--exact", "20", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto json = outcome.json();
  EXPECT_EQ(json["radius"], 0.5);
  ASSERT_EQ(json["rows"].size(), 1u);
  const auto row = json["rows"][0];
  EXPECT_EQ(row["map"], "Simple");
  for (const char* key : {"scenarios", "solvable", "solved"}) EXPECT_EQ(row[key], 250) << key;
  EXPECT_EQ(row["success"], 1.0);
  EXPECT_EQ(row["optimum_checked"], 20);
  EXPECT_EQ(row["optimum_reproduced"], 20);
  EXPECT_GT(row["build_seconds"], 0.0);
  EXPECT_GT(row["vertices"], 0);
  EXPECT_GT(row["edges"], 0);
  for (const auto& answers : {row, row["raw"]}) {
    const auto length = answers["length_over_optimum"];
    EXPECT_LE(length["median"], length["p95"]);
    EXPECT_LE(length["p95"], length["p99"]);
    EXPECT_LE(length["p99"], length["max"]);
    EXPECT_GT(answers["microseconds"]["median"], 0.0);
    EXPECT_LE(answers["microseconds"]["median"], answers["microseconds"]["p95"]);
  }
  EXPECT_LT(row["length_over_optimum"]["median"], row["raw"]["length_over_optimum"]["median"]);
  for (const char* file : {"grid.json", "grid.csv", "grid.png", "grid.svg"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
  EXPECT_NE(read_whole(folder_ / "out/grid.csv").find("raw.length_over_optimum.p99"),
            std::string::npos);
  const std::string lines = read_whole(folder_ / "out/grid_scenarios.csv");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 251);
}

TEST_F(CliBench, GridSpreadsASubsetAndTakesEitherNameOfTheScenarios) {
  std::filesystem::copy_file(kBenchmark, path("Simple.3dmap"));
  expect_refused({"bench", "grid", path("Simple.3dmap")},
                 {"Simple.3dmap", "no scenarios", "Simple.3dmap.3dscen", "Simple.3dscen"});
  std::filesystem::copy_file(kBenchmark + ".3dscen", path("Simple.3dscen"));
  const Outcome outcome =
      run({"bench", "grid", path("Simple.3dmap"), "--scenarios", "7", "--exact", "0", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto row = outcome.json()["rows"][0];
  EXPECT_EQ(row["scenarios"], 7);
  EXPECT_EQ(row["solved"], 7);
  EXPECT_EQ(row["optimum_checked"], 0);
}

TEST_F(CliBench, GridRefusesWhatIsNoBenchmark) {
  write_whole(folder_ / "short.3dmap", "vox");
  expect_refused({"bench", "grid", path("short.3dmap")}, {"short.3dmap", "MovingAI"});
  expect_refused({"bench", "grid", path("none.3dmap")}, {"none.3dmap"});
  write_whole(folder_ / "a.3dmap", "voxel 3 3 3\n");
  write_whole(folder_ / "a.3dscen", "version 1\na.3dmap\n");
  expect_refused({"bench", "grid", path("a.3dmap")}, {"a.3dscen", "no scenarios"});
  write_whole(folder_ / "a.3dscen", "version 1\na.3dmap\n0 0 0 0 0 0 0 1\n");
  expect_refused({"bench", "grid", path("a.3dmap")}, {"'a'", "optimum 0"});
  write_whole(folder_ / "a.3dscen", "version 1\nb.3dmap\n0 0 0 0 0 2 2 1\n");
  const Outcome other = run({"bench", "grid", path("a.3dmap")});
  EXPECT_EQ(other.code, 0);
  EXPECT_NE(other.err.find("b.3dmap"), std::string::npos) << other.err;
  expect_refused({"bench", "grid"}, {"maps"});
}

TEST_F(CliBench, HallHasARowForEveryMapAndNumberOfThreads) {
  std::string cells = "voxel 40 40 12\n";  // a pillar in a box of metres
  for (int z = 0; z < 12; ++z) cells += "20 20 " + std::to_string(z) + "\n";
  write_whole(folder_ / "box.3dmap", cells);
  const Outcome outcome =
      run({"bench", "hall", path("box.3dmap"), "--voxel-sizes", "0.5,0.35", "--threads-list", "1,2",
           "--repeat", "1", "--queries", "20", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 6u);
  for (const auto& row : rows) {
    for (const char* key : {"map", "voxel_size", "threads", "known_voxels", "allocated_voxels",
                            "peak_memory_bytes", "bandwidth", "first_answer", "batch"})
      EXPECT_TRUE(row.contains(key)) << key;
    for (const char* numbers : {"seconds", "bytes", "voxels_per_second"})
      for (const char* stage : {"esdf", "gvd", "edges", "thin", "kernel", "graph", "attach",
                                "tangents", "esdf_to_graph", "total"})
        EXPECT_GT(row[numbers][stage], 0.0) << numbers << "." << stage;
    EXPECT_GT(row["first_answer"]["total"], row["first_answer"]["load"]);
    EXPECT_GT(row["batch"]["solved"], 0);
  }
  EXPECT_EQ(rows[0]["map"], "hall");
  EXPECT_EQ(rows[0]["times_as_fast"]["total"], 1.0);
  EXPECT_EQ(rows[5]["map"], "box");
  EXPECT_EQ(rows[5]["threads"], 2);
  EXPECT_EQ(rows[5]["vertices"], rows[4]["vertices"]);
  for (const char* file : {"hall.json", "hall.csv", "hall_times.png", "hall_times.svg"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("out")), {}), 4);  // no more
}

TEST_F(CliBench, LiveHasARowForEveryWorldAndRecording) {
  const std::string recording = std::string(RIDGEWAY_DATA_DIR) + "/house_depth";
  const Outcome outcome =
      run({"bench", "live", "--worlds", "house", "--recording", recording, "--scans", "12",
           "--voxel-size", "0.25", "--verify", "6", "--queries", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["recording"], "house");
  EXPECT_EQ(rows[0]["scans"], 12);
  EXPECT_EQ(rows[0]["verified"], 2);
  EXPECT_GT(rows[0]["queries"], 0);
  EXPECT_GT(rows[0]["query_microseconds"]["live"], 0.0);
  EXPECT_EQ(rows[1]["recording"], "house_depth");
  for (const auto& row : rows) {
    EXPECT_EQ(row["identical"], row["verified"]);
    EXPECT_EQ(row["query_violations"], 0);
    EXPECT_GT(row["milliseconds"]["median"], 0.0);
    EXPECT_LE(row["milliseconds"]["median"], row["milliseconds"]["p99"]);
    EXPECT_GT(row["batch_milliseconds"]["median"], 0.0);
    if (testing::kIsSanitized)
      EXPECT_TRUE(row["memory_ratio"].is_null());
    else
      EXPECT_GT(row["memory_ratio"], 0.0);
  }
  EXPECT_GT(outcome.json()["stages"]["house"].size(), 10u);
  for (const char* file : {"live.json", "live.csv", "live_house.csv", "live_house.png"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
}

TEST_F(CliBench, ExploreHasARowForEveryPlannerAndSeedInAWorldOfAFile) {
  const Outcome outcome =
      run({"bench", "explore", "--world", room(), "--start", "2,2,1", "--seeds", "2", "--planners",
           "ridgeway,offline", "--longest", "20", "-o", path("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = outcome.json()["rows"];
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2]["world"], "room");
  EXPECT_EQ(rows[2]["seed"], 2);
  EXPECT_EQ(rows[3]["planner"], "offline");
  for (const auto& row : rows) {
    EXPECT_EQ(row["collisions"], 0);
    EXPECT_GT(row["coverage"], 0.9);
    EXPECT_GT(row["decision_milliseconds"]["p95"], 0.0);
  }
  for (const char* file : {"explore.json", "explore.csv", "explore_room_2_offline.png"})
    EXPECT_GT(read_whole(folder_ / "out" / file).size(), 100u) << file;
  expect_refused({"bench", "explore", "--world", path("room.yaml")}, {"--start", "--world"});
  expect_refused({"bench", "explore", "--start", "2,2,1"}, {"--start", "--world"});
  expect_refused({"bench", "explore", "--bounds", "0,0,0,1,1,1"}, {"--bounds", "--world"});
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

TEST_F(CliBench, ChangesThatLeaveNoRoadmapAreHeldAgainstBatchToo) {
  const auto row = run({"bench", "live", "--changes", "60", "--json"}).json()["rows"][0];
  EXPECT_EQ(row["change_sets"], 60);
  EXPECT_EQ(row["same_as_batch"], 60);
  EXPECT_GT(row["without_roadmap"], 0);
  EXPECT_LT(row["without_roadmap"], 30);
}

TEST_F(CliBench, NamesAreThereOnceAndQuotedInTables) {
  const std::string world = path("house.yaml");
  write_whole(world, read_whole(room()));
  const std::string grid = std::string(RIDGEWAY_DATA_DIR) + "/none.3dmap";
  expect_refused({"bench", "live", "--worlds", "house", "--world", world}, {"'house'", "twice"});
  expect_refused({"bench", "explore", "--worlds", "house", "--world", world, "--start", "1,1,1"},
                 {"'house'", "twice"});
  expect_refused({"bench", "grid", grid, grid}, {"'none'", "twice"});

  write_whole(folder_ / "a,b.3dmap", "voxel 9 9 9\n4 4 0\n");
  ASSERT_EQ(run({"bench", "hall", path("a,b.3dmap"), "--voxel-sizes", "0.5", "--threads-list", "1",
                 "--repeat", "1", "--queries", "1", "-o", path("out")})
                .code,
            0);
  EXPECT_NE(read_whole(folder_ / "out/hall.csv").find("\n\"a,b\","), std::string::npos);
}

TEST_F(CliBench, BadArgumentsAreRefused) {
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "none"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "moon"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "none", path("none.bt")}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--min-clearance", "-1"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--max-speed", "0"}).code, 1);
  EXPECT_EQ(run({"bench", "trajectory", "--worlds", "hall,hall"}).code, 1);
  EXPECT_EQ(run({"bench", "hall", path("none.bt")}).code, 1);
  EXPECT_EQ(run({"bench", "hall", "--threads-list", "0"}).code, 1);
  EXPECT_EQ(run({"bench", "hall", "--voxel-sizes", "0"}).code, 1);
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
