// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Limits of flights, and what else people mean by where a robot may be.
#include "program.hpp"

namespace ridgeway {
namespace {

class CliLimits : public Program {
 protected:
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
  const Json flown = run({"trajectory", map, "--from", "-2,1,1", "--to", "2,1,1", "--json",
                          "--height", band})
                         .json();
  ASSERT_EQ(flown["status"], "ok");
  for (const Json& sample : flown["samples"])
    EXPECT_NEAR(sample["position"][2].get<double>(), 1.0, 0.1 + 1e-7);
  const Json checked =
      run({"check", map, "--queries", "40", "--json", "--height", "0.6,0.8"}).json();
  EXPECT_TRUE(checked["clean"].get<bool>());
  EXPECT_EQ(checked["graph_ok"], 40);
}

TEST_F(CliLimits, OfABuildAreKeptInItsFile) {
  ASSERT_EQ(build_rooms("band.ridge", {"--height", "0.9,1.1"}).code, 0);
  const Json info = run({"info", path("band.ridge"), "--json"}).json();
  EXPECT_EQ(info["config"]["limits"]["keep_in"], Json({nullptr, nullptr, 0.9, nullptr, nullptr, 1.1}));
  EXPECT_EQ(info["limits"]["keep_in"], Json({nullptr, nullptr, 0.9, nullptr, nullptr, 1.1}));
  EXPECT_GT(info["graph"]["edges"].get<int>(), 0);
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
                  "-3,-2,0,3,2,2", "--height", "7,8"},
                 {"traversable"});
}

}  // namespace
}  // namespace ridgeway
