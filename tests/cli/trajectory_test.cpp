// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>

#include "program.hpp"

namespace ridgeway {
namespace {

using CliTrajectory = Program;

TEST_F(CliTrajectory, JsonHasTheKeysThatScriptsRelyOn) {
  const Outcome flown = run({"--json", "trajectory", rooms(), "--from", "-2,1.5,1", "--to",
                             "2,1.5,1", "--max-speed", "1.5", "--max-acceleration", "3"});
  ASSERT_EQ(flown.code, 0) << flown.err;
  const Json json = flown.json();
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["answered_by"], "graph");
  EXPECT_GT(json["length"].get<double>(), 4.0);
  EXPECT_GE(json["waypoints"].size(), 3u);
  EXPECT_GT(json["duration"].get<double>(), 4.0 / 1.5);
  EXPECT_LE(json["duration"].get<double>(), json["stop_and_go_duration"].get<double>());
  EXPECT_LE(json["max_speed"].get<double>(), 1.5);
  EXPECT_LE(json["max_acceleration"].get<double>(), 3.0);
  EXPECT_GE(json["clearance"].get<double>(), 0.3 * (1 - 1e-9));
  for (const char* key : {"attach", "search", "shorten", "optimise", "verify", "total"})
    EXPECT_GE(json["seconds"][key].get<double>(), 0.0) << key;
  const Json& samples = json["samples"];
  ASSERT_GT(samples.size(), 100u);
  EXPECT_EQ(samples.front()["position"], Json({-2.0, 1.5, 1.0}));
  EXPECT_NEAR(samples.back()["position"][0].get<double>(), 2.0, 1e-6);
  EXPECT_DOUBLE_EQ(samples.back()["t"].get<double>(), json["duration"].get<double>());
  for (const char* key : {"velocity", "acceleration", "yaw"})
    EXPECT_TRUE(samples.front().contains(key)) << key;
}

TEST_F(CliTrajectory, WritesEveryFormatAndAPicture) {
  const std::string map = rooms();
  for (const char* name : {"t.csv", "t.json", "t.yaml"}) {
    const Outcome flown = run({"trajectory", map, "--from=-2,1.5,1", "--to", "2,1.5,1", "-o",
                               path(name), "--picture", path("t.png")});
    ASSERT_EQ(flown.code, 0) << flown.err;
    EXPECT_TRUE(exists(name));
    EXPECT_TRUE(exists("t.png"));
  }
  EXPECT_EQ(run({"export", map, "--picture", path("map.png"), "--path", path("t.csv")}).code, 0);
}

TEST_F(CliTrajectory, OptionsReachThePlanner) {
  const std::string map = rooms();
  const auto flown = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"--json",   "trajectory", map,      "--from",
                                      "-2,1.5,1", "--to",       "2,1.5,1"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).json();
  };
  EXPECT_EQ(flown({"--stop-and-go"})["step"], "stop_and_go");
  EXPECT_LE(flown({"--max-yaw-rate", "10"})["max_yaw_rate"].get<double>(), 0.1746);
  EXPECT_LE(flown({"--max-jerk", "3"})["max_jerk"].get<double>(), 3.0);
  EXPECT_EQ(flown({"--derivative", "jerk"})["status"], "ok");
  const Json turned = flown({"--yaw", "90"});
  EXPECT_NEAR(turned["samples"][7]["yaw"].get<double>(), 1.5707963, 1e-6);
  const Json moving = flown({"--from-velocity", "0.5,-0.5,0"});
  EXPECT_EQ(moving["samples"][0]["velocity"], Json({0.5, -0.5, 0.0}));
}

TEST_F(CliTrajectory, SaysWhyThereIsNone) {
  const std::string map = rooms();
  const Outcome blocked = run(
      {"--json", "trajectory", map, "--from", "-2,1.5,1", "--to", "2,9,1", "-o", path("t.csv")});
  EXPECT_EQ(blocked.code, 2);
  EXPECT_EQ(blocked.json()["status"], "goal_outside_map");
  EXPECT_FALSE(blocked.json()["reason"].get<std::string>().empty());
  EXPECT_FALSE(exists("t.csv"));
  // Two metres a second, 0.6 m from the wall.
  const Outcome late = run({"--json", "trajectory", map, "--from", "2,1.4,1", "--to", "-2,1.4,1",
                            "--from-velocity", "0,2,0"});
  EXPECT_EQ(late.code, 2);
  EXPECT_EQ(late.json()["status"], "cannot_stop_in_time");
}

TEST_F(CliTrajectory, RefusesBadInput) {
  const std::string map = rooms();
  const auto refused = [&](const std::vector<std::string>& more,
                           const std::vector<std::string>& words) {
    std::vector<std::string> all = {"trajectory", map, "--from", "-2,1.5,1", "--to", "2,1.5,1"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, words);
  };
  refused({"--max-speed", "0"}, {"--max-speed"});
  refused({"--max-speed", "nan"}, {"--max-speed"});
  refused({"--max-acceleration=-1"}, {"--max-acceleration"});
  refused({"--max-jerk", "0"}, {"--max-jerk"});
  refused({"--max-yaw-rate", "0"}, {"--max-yaw-rate"});
  refused({"--radius", "0"}, {"radius"});
  refused({"--derivative", "crackle"}, {"crackle"});
  refused({"--from-velocity", "1,2"}, {"--from-velocity"});
  refused({"--from-velocity", "3,0,0"}, {"--from-velocity"});
  refused({"-o", path("t.txt")}, {"t.txt"});
  refused({"--max-speed", "1e-6", "-o", path("t.csv")}, {"--step"});
  EXPECT_FALSE(exists("t.csv"));
}

TEST_F(CliTrajectory, SaysWhichPartOfACourseHasNoPath) {
  const Outcome refused =
      run({"trajectory", rooms(), "--from", "-2,1.5,1", "--to", "2,1.5,1", "--via", "0.5,1.5,100"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.out.find("on leg 1 of 2"), std::string::npos) << refused.out;
}

TEST_F(CliTrajectory, SaysWhereAGivenPathIsNotFree) {
  const std::string map = rooms();
  write_whole(folder_ / "through.csv", "x,y,z\n-2,1.5,1\n2,1.5,1\n");
  write_whole(folder_ / "round.csv", "x,y,z\n-2,1.5,1\n-2,-1,1\n-2,1.5,1\n-2,1,1\n");
  const Outcome through = run({"trajectory", map, "--path", path("through.csv")});
  EXPECT_EQ(through.code, 2);
  EXPECT_NE(through.out.find("between -2,1.5,1 and 2,1.5,1"), std::string::npos) << through.out;
  EXPECT_NE(through.out.find("of an obstacle"), std::string::npos) << through.out;
  const Outcome low = run({"trajectory", map, "--path", path("round.csv"), "--height", "0.3,0.6"});
  EXPECT_EQ(low.code, 2);
  EXPECT_NE(low.out.find("leaves the limits of the flight"), std::string::npos) << low.out;
  const Outcome round = run({"trajectory", map, "--path", path("round.csv"), "--json"});
  ASSERT_EQ(round.code, 0) << round.out;
  EXPECT_NEAR(round.json()["within"].get<double>(), 5.5 / 0.5, 1e-9);
  EXPECT_EQ(round.json()["answered_by"], "given");
}

TEST_F(CliTrajectory, StopsAndGoesFromAMotion) {
  const Outcome flown = run({"trajectory", rooms(), "--from", "-2,1.5,1", "--to", "-2,-1,1",
                             "--stop-and-go", "--from-velocity", "0.5,0,0", "--json"});
  ASSERT_EQ(flown.code, 0) << flown.out;
  EXPECT_EQ(flown.json()["optimisations"], 0);
  EXPECT_EQ(flown.json()["step"], "stop_and_go");
}

TEST_F(CliTrajectory, SlowFlightsNeedNoSamples) {
  const std::vector<std::string> slow = {"trajectory", rooms(),   "--from",      "-2,1.5,1",
                                         "--to",       "2,1.5,1", "--max-speed", "1e-5"};
  const Outcome flown = run(slow);
  EXPECT_EQ(flown.code, 0) << flown.err;
  std::vector<std::string> pieces = slow;
  pieces.insert(pieces.end(), {"-o", path("t.yaml")});
  EXPECT_EQ(run(pieces).code, 0);
}

}  // namespace
}  // namespace ridgeway
