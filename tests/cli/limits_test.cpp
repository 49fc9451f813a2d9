// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Limits of flights, and what else people mean by where a robot may be.
#include <algorithm>
#include <cmath>

#include "program.hpp"

namespace ridgeway {
namespace {

class CliLimits : public Program {
 protected:
  /// The two rooms for robots of another radius.
  void build_for(const std::string& radius, const std::string& name) {
    const Outcome built = run({"build", two_rooms(), "-o", path(name), "--voxel-size", "0.1",
                               "--bounds", "-3,-2,0,3,2,2", "--min-clearance", radius});
    ASSERT_EQ(built.code, 0) << built.err;
  }
  std::vector<std::string> plan(const std::string& map, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"plan", map, "--from", "-2,1,1", "--to", "2,1,1", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(CliLimits, AreKeptByPathsWithoutBuildingAgain) {
  const std::string map = rooms();
  // Through the door, whose middle is forbidden: along the box.
  const Json json =
      run(plan(map, {"--height", "0.9,1.1", "--keep-out", "-0.5,-0.1,0,0.5,0.6,2"})).json();
  EXPECT_EQ(json["status"], "ok");
  for (const Json& p : json["waypoints"]) {
    EXPECT_GE(p[2].get<double>(), 0.9 - 1e-7);
    EXPECT_LE(p[2].get<double>(), 1.1 + 1e-7);
  }
  EXPECT_GT(json["length"], run(plan(map, {})).json()["length"]);
  const Outcome shut = run(plan(map, {"--keep-out", "-0.2,-2,0,0.2,2,2"}));
  EXPECT_EQ(shut.code, 2);
  EXPECT_EQ(shut.json()["status"], "no_route");
  EXPECT_EQ(shut.json()["blocked"]["by"], "limits");
  EXPECT_NE(shut.json()["reason"].get<std::string>().find("limits"), std::string::npos);
  EXPECT_EQ(run(plan(map, {"--height", "1.2,1.5"})).json()["status"], "start_outside_limits");
  EXPECT_EQ(run(plan(map, {"--keep-in", "-3,-2,0,0,2,2"})).json()["status"], "goal_outside_limits");
}

TEST_F(CliLimits, GoForEveryFormOfPlanTrajectoryAndCheck) {
  const std::string map = rooms();
  const std::string band = "0.9,1.1";
  for (const char* planner : {"graph", "diagram", "esdf", "theta", "rrtconnect"}) {
    const Json json = run(plan(map, {"--height", band, "--planner", planner})).json();
    ASSERT_EQ(json["status"], "ok") << planner;
    for (const Json& p : json["waypoints"]) EXPECT_NEAR(p[2].get<double>(), 1.0, 0.1 + 1e-7);
  }
  const Json routes = run(plan(map, {"--height", band, "--alternatives", "2"})).json();
  for (const Json& route : routes["routes"])
    for (const Json& p : route["waypoints"]) EXPECT_NEAR(p[2].get<double>(), 1.0, 0.1 + 1e-7);
  const Json flown =
      run({"trajectory", map, "--from", "-2,1,1", "--to", "2,1,1", "--json", "--height", band})
          .json();
  ASSERT_EQ(flown["status"], "ok");
  for (const Json& sample : flown["samples"])
    EXPECT_NEAR(sample["position"][2].get<double>(), 1.0, 0.1 + 1e-7);
  const Json checked =
      run({"check", map, "--queries", "40", "--json", "--height", "0.6,0.8"}).json();
  EXPECT_TRUE(checked["clean"].get<bool>());
  EXPECT_EQ(checked["graph_ok"], checked["esdf_ok"]);  // wider robots have less room
  EXPECT_GT(checked["graph_ok"], 25);
}

TEST_F(CliLimits, OfABuildAreKeptInItsFile) {
  ASSERT_EQ(build_rooms("band.ridge", {"--height", "0.9,1.1"}).code, 0);
  const Json info = run({"info", path("band.ridge"), "--json"}).json();
  EXPECT_EQ(info["config"]["limits"]["keep_in"],
            Json({nullptr, nullptr, 0.9, nullptr, nullptr, 1.1}));
  EXPECT_EQ(info["limits"]["keep_in"], Json({nullptr, nullptr, 0.9, nullptr, nullptr, 1.1}));
  EXPECT_GT(info["graph"]["edges"].get<int>(), 0);
  EXPECT_NE(run({"info", path("band.ridge")}).out.find("z from 0.9 to 1.1"), std::string::npos);
  const Json json = run(plan(path("band.ridge"), {})).json();
  EXPECT_EQ(json["answered_by"], "graph");
  for (const Json& p : json["waypoints"]) EXPECT_NEAR(p[2].get<double>(), 1.0, 0.1 + 1e-7);
  // Those of a query hold beside them.
  EXPECT_EQ(run(plan(path("band.ridge"), {"--height", "1,1.4"})).json()["status"], "ok");
  EXPECT_TRUE(run({"check", path("band.ridge"), "--queries", "40", "--json"}).json()["clean"]);
}

TEST_F(CliLimits, BadOnesAreRefused) {
  const std::string map = rooms();
  const auto expect = [&](const std::vector<std::string>& more,
                          const std::vector<std::string>& words) {
    std::vector<std::string> arguments = {"plan", map, "--from", "-2,1,1", "--to", "2,1,1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, words);
  };
  expect({"--height", "1.4,0.6"}, {"--height", "1.4,0.6"});
  expect({"--height", "1.4"}, {"--height"});
  expect({"--height", "nan,1"}, {"--height"});
  expect({"--height", "1.02,1.03"}, {"limits", "centre of no voxel along z"});
  expect({"--keep-in", "0,0,0,1,1"}, {"--keep-in"});
  expect({"--keep-out", "0,0,0,1,1,0"}, {"--keep-out", "volume"});
  expect({"--height", "0,1", "--keep-in", "-3,-2,1.5,3,2,2"}, {"--height", "--keep-in"});
  expect_refused({"build", two_rooms(), "-o", path("x.ridge"), "--voxel-size", "0.1", "--bounds",
                  "-3,-2,0,3,2,2", "--height", "7,8", "--quiet"},
                 {"traversable"});
}

TEST_F(CliLimits, SnapMovesAnEndAndSaysSo) {
  const std::string map = rooms();
  const std::vector<std::string> words = {"plan", map,       "--from", "-2,1.95,1",
                                          "--to", "2,1,2.5", "--snap", "1"};
  const Outcome text = run(words);
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("the start by"), std::string::npos) << text.out;
  std::vector<std::string> asked = words;
  asked.emplace_back("--json");
  const Json json = run(asked).json();
  EXPECT_NEAR(json["moved_start"]["distance"].get<double>(), 0.3, 0.15);
  EXPECT_EQ(json["waypoints"].front(), json["moved_start"]["place"]);
  EXPECT_EQ(json["waypoints"].back(), json["moved_goal"]["place"]);
  asked[7] = "0.1";
  EXPECT_EQ(run(asked).json()["status"], "start_in_collision");
  EXPECT_FALSE(run(plan(map, {"--snap", "1"})).json().contains("moved_start"));
  expect_refused(
      {"plan", map, "--from", "-2,1,1", "--to", "2,1,1", "--snap", "1", "--planner", "rrtconnect"},
      {"--snap"});
}

TEST_F(CliLimits, ThereIsAReasonForNoRouteFromWhereAnEndWasMovedTo) {
  std::vector<std::string> words = {"plan",     rooms(), "--from", "-2,1.5,1", "--to",  "2,0,1",
                                    "--radius", "0.8",   "--snap", "1",        "--json"};
  for (const bool several : {false, true}) {
    if (several) words.insert(words.end(), {"--alternatives", "2"});
    const Json json = run(words).json();
    EXPECT_EQ(json["status"], "no_route");
    EXPECT_NEAR(json["blocked"]["radius"].get<double>(), 0.6, 0.06) << json;
    EXPECT_NE(json["reason"].get<std::string>().find("but they are at 0."), std::string::npos);
  }
}

TEST_F(CliLimits, InfoTellsWhatIsAtAPlaceAndWhatIsInTheWay) {
  build_for("0.7", "tight.ridge");
  const Json json = run({"info", path("tight.ridge"), "--at", "-2,0,1", "--json"}).json();
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["voxel"], "free");
  EXPECT_NEAR(json["clearance"].get<double>(), 1.0, 1e-9);
  ASSERT_EQ(json["ways"].size(), 1u);
  EXPECT_NEAR(json["ways"][0]["radius"].get<double>(), 0.6, 0.06);
  EXPECT_EQ(json["ways"][0]["by"], "obstacle");
  EXPECT_NEAR(json["ways"][0]["place"][0].get<double>(), 0.0, 0.2);
  const Json all = run({"info", path("tight.ridge"), "--json"}).json();
  EXPECT_EQ(all["joins"][0]["by"], "obstacle");
  const Outcome text = run({"info", path("tight.ridge"), "--at", "-2,0,1"});
  EXPECT_NE(text.out.find("to component"), std::string::npos) << text.out;
  EXPECT_EQ(run({"info", path("tight.ridge"), "--at", "-2,0,9", "--json"}).json()["status"],
            "outside_map");
  EXPECT_EQ(run({"info", path("tight.ridge"), "--at", "0.05,-1.5,1", "--json"}).json()["voxel"],
            "occupied");
  expect_refused({"info", path("rooms.xyz"), "--at", "1,1,1"}, {"--at", "roadmaps"});
}

TEST_F(CliLimits, FreeUnknownSpaceIsPlannedThroughAndCounted) {
  // The scan of an office corridor: much of what is around it was never seen.
  ASSERT_EQ(run({"build", kScan, "-o", path("free.ridge"), "--voxel-size", "0.2", "--min-clearance",
                 "0.4", "--unknown", "free"})
                .code,
            0);
  EXPECT_EQ(run({"info", path("free.ridge"), "--json"}).json()["unknown_policy"], "free");
  const Json json = run({"plan", path("free.ridge"), "--from", "1.3,-2.8,1.2", "--to",
                         "1.3,-2.8,3.5", "--snap", "6", "--json"})
                        .json();
  EXPECT_EQ(json["unknown"]["policy"], "free");
  ASSERT_TRUE(json["unknown"].contains("inside"));
  EXPECT_TRUE(run({"check", path("free.ridge"), "--queries", "30", "--json"}).json()["clean"]);
}

TEST_F(CliLimits, PlanarMapsAreBuiltSavedAndChecked) {
  ASSERT_EQ(build_rooms("plane.ridge", {"--planar", "0.5,1.5"}).code, 0);
  const std::string map = path("plane.ridge");
  const Json info = run({"info", map, "--json"}).json();
  EXPECT_TRUE(info["planar"].get<bool>());
  EXPECT_EQ(info["config"]["planar"], Json({0.5, 1.5}));
  EXPECT_NEAR(info["bounds"]["min"][2].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(info["bounds"]["max"][2].get<double>(), 1.1, 1e-9);
  EXPECT_EQ(info["voxels"]["free"].get<int>() + info["voxels"]["occupied"].get<int>(), 60 * 40);
  const std::string told = run({"info", map}).out;
  for (const char* words : {"at a height of 1.05 m", " m2, "})
    EXPECT_NE(told.find(words), std::string::npos) << words << told;
  EXPECT_EQ(told.find("limits"), std::string::npos) << told;
  const Json json = run(plan(map, {})).json();
  EXPECT_EQ(json["answered_by"], "graph");
  for (const Json& p : json["waypoints"]) EXPECT_NEAR(p[2].get<double>(), 1.05, 1e-9);
  // Other heights are the same place.
  EXPECT_EQ(run({"plan", map, "--from", "-2,1,0", "--to", "2,1,7", "--json"}).json()["length"],
            json["length"]);
  const std::string near_wall = run({"plan", map, "--from", "-2.9,1,0", "--to", "2,1,7"}).out;
  EXPECT_NE(near_wall.find("0.1 m from what the map does not know"), std::string::npos)
      << near_wall;
  // Nor do those of limits, and of paths that are given.
  for (const char* box : {"-1.5,0,5,-1,2,6", "-1.5,0,-1,-1,2,0.2", "-1.5,0,0,-1,2,2"})
    EXPECT_GT(run(plan(map, {"--keep-out", box})).json()["length"], json["length"]) << box;
  EXPECT_EQ(run(plan(map, {"--height", "3,4"})).json()["length"], json["length"]);
  write_whole(path("low.csv"), "x,y,z\n-2,1,0\n-1.5,1,0\n");
  EXPECT_EQ(run({"trajectory", map, "--path", path("low.csv"), "--json"}).json()["status"], "ok");
  EXPECT_TRUE(run({"check", map, "--queries", "60", "--json"}).json()["clean"]);
  const Json flown = run({"trajectory", map, "--from", "-2,1,1", "--to", "2,1,1", "--json"}).json();
  ASSERT_EQ(flown["status"], "ok");
  EXPECT_NE(flown["step"], "stop_and_go");
  for (const Json& sample : flown["samples"])
    EXPECT_NEAR(sample["position"][2].get<double>(), 1.05, 2e-8);
  EXPECT_EQ(run({"export", map, "--picture", path("plane.png")}).code, 0);
  expect_refused({"build", two_rooms(), "-o", path("x.ridge"), "--voxel-size", "0.1", "--bounds",
                  "-3,-2,0,3,2,2", "--planar", "1.5,0.5", "--quiet"},
                 {"--planar", "the lower first"});
  expect_refused({"plan", map, "--from", "-2,1,1", "--to", "2,1,1", "--robot-height", "1"},
                 {"--robot-height", "plane"});
}

TEST_F(CliLimits, CylindersPassWhereTheyFit) {
  build_for("0.2", "r.ridge");
  const std::string map = path("r.ridge");
  const Json flat = run(plan(map, {"--radius", "0.55", "--robot-height", "0.4"})).json();
  EXPECT_EQ(flat["status"], "ok");
  EXPECT_EQ(run(plan(map, {"--radius", "0.65", "--robot-height", "0.4"})).json()["status"],
            "no_route");
  const Json tall = run(plan(map, {"--radius", "0.3", "--robot-height", "2.2"})).json();
  EXPECT_EQ(tall["status"], "start_in_collision");
  EXPECT_NE(tall["reason"].get<std::string>().find("smaller --radius or --robot-height"),
            std::string::npos);
  EXPECT_EQ(tall["reason"].get<std::string>().find("--escape"), std::string::npos);
  // Where a ball gets through, under a lintel, it is the height.
  ASSERT_EQ(build_rooms("lintel.ridge", {"--exclude", "-0.1,-0.6,1.2,0.2,0.6,2"}).code, 0);
  const std::string lintel = path("lintel.ridge");
  EXPECT_EQ(run(plan(lintel, {"--robot-height", "0.8"})).json()["status"], "ok");
  const Json high = run(plan(lintel, {"--robot-height", "1.6"})).json();
  EXPECT_EQ(high["status"], "no_route");
  EXPECT_NE(high["reason"].get<std::string>().find("give a smaller --robot-height"),
            std::string::npos);
  EXPECT_FALSE(high.contains("blocked"));
  EXPECT_TRUE(
      run({"check", map, "--queries", "15", "--robot-height", "0.8", "--json"}).json()["clean"]);
  const Json flown = run({"trajectory", map, "--from", "-2,1,1", "--to", "2,1,1", "--radius",
                          "0.55", "--robot-height", "0.4", "--json"})
                         .json();
  EXPECT_EQ(flown["status"], "ok");
}

TEST_F(CliLimits, AlternativesAreWrittenAndFlown) {
  const std::string map = rooms();
  // Two ways past a box in the left room.
  const Json routes = run(plan(map, {"--alternatives", "3", "--keep-out", "-2.2,-0.5,0,-1.2,0.5,2",
                                     "-o", path("way.json")}))
                          .json();
  ASSERT_GE(routes["routes"].size(), 1u);
  EXPECT_TRUE(exists("way-1.json"));
  EXPECT_FALSE(exists("way.json"));
  EXPECT_EQ(exists("way-2.json"), routes["routes"].size() > 1);
  const Json flown =
      run({"trajectory", map, "--path", path("way-1.json"), "--json", "-o", path("t.csv")}).json();
  EXPECT_EQ(flown["status"], "ok");
  EXPECT_EQ(flown["waypoints"], routes["routes"][0]["waypoints"]);
  EXPECT_EQ(run({"export", map, "--picture", path("p.png"), "--path", path("way-1.json")}).code, 0);
  const Outcome wide =
      run({"trajectory", map, "--path", path("way-1.json"), "--radius", "0.8", "--json"});
  EXPECT_EQ(wide.code, 2);
  EXPECT_EQ(wide.json()["status"], "path_not_free");
  expect_refused({"trajectory", map, "--path", path("way-1.json"), "--from", "1,1,1"}, {"--path"});
  expect_refused({"trajectory", map, "--path", path("way-1.json"), "--via", "1,1,1"}, {"--via"});
  expect_refused({"trajectory", map, "--from", "1,1,1"}, {"--to"});
}

TEST_F(CliLimits, TrajectoriesGoViaPlacesAndLeaveTightOnes) {
  const std::string map = rooms();
  const auto fly = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"trajectory", map, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Json via =
      fly({"--from", "-2,1,1", "--to", "2,1,1", "--via", "-1,-1.2,1", "--via", "1,-1,1.4"}).json();
  ASSERT_EQ(via["status"], "ok");
  EXPECT_NE(std::find(via["waypoints"].begin(), via["waypoints"].end(), Json({-1.0, -1.2, 1.0})),
            via["waypoints"].end());
  EXPECT_NE(std::find(via["waypoints"].begin(), via["waypoints"].end(), Json({1.0, -1.0, 1.4})),
            via["waypoints"].end());
  const Outcome shut = fly({"--from", "-2,1,1", "--to", "2,1,1", "--via", "0.05,-1.9,1"});
  EXPECT_EQ(shut.code, 2);
  const std::string reason = shut.json()["reason"];
  EXPECT_NE(reason.find("the place on the way 0.05,-1.9,1"), std::string::npos) << reason;
  EXPECT_EQ(reason.find("--snap"), std::string::npos) << reason;  // is of start and goal
  const std::string of_goal =
      fly({"--from", "-2,1,1", "--to", "0.05,-1.9,1", "--via", "1,-1,1.4"}).json()["reason"];
  EXPECT_NE(of_goal.find("the goal 0.05,-1.9,1"), std::string::npos) << of_goal;
  EXPECT_NE(of_goal.find("--snap"), std::string::npos) << of_goal;
  // A take-off from the floor.
  const Outcome down = fly({"--from", "-2,1,0.1", "--to", "2,1,1"});
  EXPECT_EQ(down.json()["status"], "start_in_collision");
  const Json up = fly({"--from", "-2,1,0.1", "--to", "2,1,0.15", "--escape"}).json();
  ASSERT_EQ(up["status"], "ok") << up.dump();
  EXPECT_NEAR(up["samples"].front()["position"][2].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(up["samples"].back()["position"][2].get<double>(), 0.15, 1e-6);
  EXPECT_GE(up["clearance"].get<double>(), 0.3 * (1 - 1e-9));  // without its escapes
  for (const char* name : {"up.json", "up.csv"})
    ASSERT_EQ(
        run({"plan", map, "--from", "-2,1,0.1", "--to", "2,1,0.15", "--escape", "-o", path(name)})
            .code,
        0);
  const Json again = fly({"--path", path("up.json")}).json();
  EXPECT_EQ(again["samples"], up["samples"]);
  const Json untold = fly({"--path", path("up.csv")}).json();  // which leg is an escape
  EXPECT_EQ(untold["status"], "path_not_free");
  EXPECT_NE(untold["reason"].get<std::string>().find(".json"), std::string::npos);
  double last = up["samples"].front()["t"].get<double>();
  for (std::size_t i = 1; i < up["samples"].size(); ++i) {
    const double dt = up["samples"][i]["t"].get<double>() - last;
    last = up["samples"][i]["t"].get<double>();
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(std::abs(up["samples"][i]["position"][axis].get<double>() -
                         up["samples"][i - 1]["position"][axis].get<double>()),
                2.0 * dt + 1e-6);
  }
  const Json wide =
      fly({"--from", "-2,1.5,1", "--to", "2,1.5,1", "--prefer-clearance", "5"}).json();
  const Json tight = fly({"--from", "-2,1.5,1", "--to", "2,1.5,1"}).json();
  EXPECT_GT(wide["length"], tight["length"]);
}

TEST_F(CliLimits, ChecksThatFindNoPlaceToBeginAreRefused) {
  const std::string map = rooms();
  expect_refused({"check", map, "--queries", "20", "--robot-height", "1000"},
                 {"no place", "give wider limits or a lower robot"});
  expect_refused({"check", map, "--queries", "20", "--height", "100,101"}, {"check"});
}

}  // namespace
}  // namespace ridgeway
