// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "program.hpp"

namespace ridgeway {
namespace {

using CliPlan = Program;

TEST_F(CliPlan, JsonHasTheKeysThatScriptsRelyOn) {
  const Outcome planned = run({"--json", "plan", rooms(), "--from", "-2,1.5,1", "--to", "2,1.5,1"});
  ASSERT_EQ(planned.code, 0) << planned.err;
  const Json json = planned.json();
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["answered_by"], "graph");
  EXPECT_GT(json["length"].get<double>(), 4.0);
  EXPECT_GE(json["clearance"].get<double>(), 0.3 * (1 - 1e-9));
  EXPECT_EQ(json["unknown"]["policy"], "obstacle");
  EXPECT_GE(json["unknown"]["nearest"].get<double>(), 0.3 * (1 - 1e-9));
  EXPECT_EQ(json["unknown"]["share"], 0.0);
  EXPECT_GE(json["known"]["nearest"].get<double>(), 0.3 * (1 - 1e-9));
  EXPECT_EQ(json["waypoints"].front(), Json({-2.0, 1.5, 1.0}));
  EXPECT_EQ(json["waypoints"].back(), Json({2.0, 1.5, 1.0}));
  for (const char* key : {"attach", "search", "shorten", "total"})
    EXPECT_GE(json["seconds"][key].get<double>(), 0.0) << key;
}

TEST_F(CliPlan, EveryPlannerAnswers) {
  const std::string map = rooms();
  for (const char* planner : {"graph", "diagram", "esdf", "theta", "rrtstar", "rrtconnect",
                              "bitstar", "prmstar", "informedrrtstar"}) {
    const Json json = run({"plan", map, "--from", "-2,1.5,1", "--to", "2,1.5,1", "--planner",
                           planner, "--raw", "--json", "--time-limit", "0.2"})
                          .json();
    EXPECT_EQ(json["answered_by"], planner);
    EXPECT_EQ(json["status"], "ok");
    EXPECT_EQ(json.contains("first_solution"), json.contains("iterations"));
    EXPECT_EQ(json.contains("iterations"),
              std::string(planner).ends_with("star") || std::string(planner) == "rrtconnect");
  }
}

TEST_F(CliPlan, SeedsRepeatPlannersThatSampleAndAreRefusedByOthers) {
  const std::string map = rooms();
  const auto waypoints = [&](const std::string& seed) {
    return run({"plan", map, "--from", "-2,1.5,1", "--to", "2,1.5,1", "--planner", "rrtstar",
                "--seed", seed, "--iteration-limit", "500", "--raw", "--json"})
        .json()["waypoints"];
  };
  EXPECT_GT(waypoints("1").size(), 2u);
  EXPECT_EQ(waypoints("1"), waypoints("1"));
  EXPECT_NE(waypoints("1"), waypoints("2"));
  expect_refused({"plan", map, "--from", "0,0,1", "--to", "2,1.5,1", "--seed", "2"},
                 {"--seed", "sample"});
  expect_refused({"plan", map, "--from", "0,0,1", "--to", "2,1.5,1", "--planner", "dijkstra"},
                 {"dijkstra"});
}

TEST_F(CliPlan, WritesPathsThatExportDraws) {
  const std::string map = rooms();
  for (const char* name : {"path.csv", "path.json"}) {
    ASSERT_EQ(run({"plan", map, "--from=-2,1.5,1", "--to", "2,1.5,1", "-o", path(name)}).code, 0);
    EXPECT_EQ(run({"export", map, "--picture", path("map.png"), "--path", path(name)}).code, 0);
    EXPECT_TRUE(exists("map.png"));
  }
}

TEST_F(CliPlan, WritesMissionsWhereTheMapHasAPlaceOnTheEarth) {
  const std::vector<std::string> query = {"plan", rooms(), "--from=-2,1.5,1", "--to", "2,1.5,1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), query.begin(), query.end());
    return more;
  };
  const std::string mission = path("mission.plan");
  const Outcome planned = run(with({"-o", mission, "--datum=-33.9,151.2,40", "--json"}));
  ASSERT_EQ(planned.code, 0) << planned.err;
  const Json items = Json::parse(read_whole(mission))["mission"]["items"];
  ASSERT_EQ(items.size(), planned.json()["waypoints"].size());
  EXPECT_NEAR(items[0]["params"][4].get<double>(), -33.9 + 1.5 / 110900.0, 1e-7);
  EXPECT_NEAR(items[0]["params"][5].get<double>(), 151.2 - 2.0 / 92500.0, 1e-7);
  EXPECT_NEAR(items[0]["params"][6].get<double>(), 41.0, 1e-6);
  ASSERT_EQ(run(with({"-o", mission, "--datum=-33.9,151.2,40", "--x-heading", "0"})).code, 0);
  const Json turned = Json::parse(read_whole(mission))["mission"]["items"][0]["params"];
  EXPECT_LT(turned[4].get<double>(), -33.9);  // 2 m south
  EXPECT_LT(turned[5].get<double>(), 151.2);  // 1.5 m west
  std::filesystem::remove(mission);
  expect_refused(with({"-o", mission}), {"mission.plan", "--datum"});
  expect_refused(with({"-o", mission, "--datum", "95,0,0"}), {"--datum", "latitude"});
  expect_refused(with({"-o", path("a.csv"), "--datum", "5,0,0"}), {"--datum", "mission.plan"});
  expect_refused(with({"--x-heading", "5"}), {"--x-heading"});
  std::vector<std::string> flight = with({"-o", mission});
  flight[0] = "trajectory";
  expect_refused(flight, {"mission.plan", "ridgeway plan"});
}

TEST_F(CliPlan, SaysWhyThereIsNoPathAndWhatToDo) {
  struct Case {
    std::string from, to, radius, status, reason;
  };
  const std::vector<Case> cases = {
      {"-20,0,1", "2,1,1", "0.3", "start_outside_map", "-3,-2,0 and 3,2,2"},
      {"-2,1,1", "2,0,9", "0.3", "goal_outside_map", "the goal 2,0,9"},
      {"-2,1.9,1", "2,1,1", "0.3", "start_in_collision", "0.1 m from what the map does not know"},
      {"-2,1.9,1", "2,1,1", "0.3", "start_in_collision", "give --escape"},
      {"-2,1,1", "2,1.65,1", "0.4", "goal_in_collision", "--radius of at most 0.35 m"},
      {"-2,1,1", "2,1,1", "0.7", "no_route", "give that --radius"},
      {"-2,1,1", "2,1,1", "5", "start_in_collision",
       "no place of this map has room for a radius of 5 m"},
      {"-2,1,1", "2,1,1", "0.2", "radius_too_small", "--min-clearance"},
  };
  const std::string map = rooms();
  for (const Case& c : cases) {
    const std::vector<std::string> query = {"plan", map,  "--from",   c.from,
                                            "--to", c.to, "--radius", c.radius};
    const Outcome person = run(query);
    EXPECT_EQ(person.code, 2) << person.err;
    EXPECT_NE(person.out.find(c.status), std::string::npos) << person.out;
    EXPECT_NE(person.out.find(c.reason), std::string::npos) << person.out;

    std::vector<std::string> more = query;
    more.insert(more.end(), {"--json", "-o", path("none.json")});
    const Outcome script = run(more);
    EXPECT_EQ(script.code, 2);
    EXPECT_EQ(script.json()["status"], c.status);
    EXPECT_FALSE(exists("none.json"));
  }
}

TEST_F(CliPlan, SaysWhenAPlaceLiesInAWallAndWhichSnapHelps) {
  const std::string map = rooms();
  for (const bool is_start : {true, false}) {
    std::vector<std::string> query = {"plan", map, "--from", "-2,1,1", "--to", "0.05,-1,1"};
    if (is_start) std::swap(query[3], query[5]);
    const Outcome planned = run(query);
    EXPECT_EQ(planned.code, 2);
    const std::string& out = planned.out;
    EXPECT_NE(out.find(is_start ? "the start" : "the goal"), std::string::npos) << out;
    EXPECT_NE(out.find("it lies in an obstacle"), std::string::npos) << out;
    EXPECT_EQ(out.find("--min-clearance"), std::string::npos) << out;
    const std::size_t at = out.find("--snap ");
    ASSERT_NE(at, std::string::npos) << out;
    const double snap = std::stod(out.substr(at + 7));
    query.insert(query.end(), {"--snap", std::to_string(snap)});
    EXPECT_EQ(run(query).code, 0) << snap;
    query.back() = std::to_string(snap - 0.002);
    EXPECT_EQ(run(query).code, 2) << snap;
  }
}

TEST_F(CliPlan, NamesAWallAcrossTheMapNotTheSpaceBeyondWhereItEnds) {
  std::string points = "x y z\n";
  for (int y = -20; y < 20; ++y)
    for (int z = 0; z < 20; ++z)
      points +=
          "0.05 " + std::to_string(0.1 * y + 0.05) + " " + std::to_string(0.1 * z + 0.05) + "\n";
  write_whole(folder_ / "cut.xyz", points);
  std::vector<std::string> build = {"build", path("cut.xyz"), "-o", path("cut.ridge")};
  for (const std::string& option : room_options()) build.push_back(option);
  ASSERT_EQ(run(build).code, 0);
  const Json json =
      run({"plan", path("cut.ridge"), "--from", "-2,0,1", "--to", "2,0,1", "--json"}).json();
  EXPECT_EQ(json["status"], "no_route");
  EXPECT_EQ(json["blocked"]["by"], "obstacle");
  EXPECT_EQ(json["blocked"]["radius"], 0.0);
  EXPECT_TRUE(json["blocked"]["place"].is_null());
  EXPECT_EQ(json["blocked"]["map_end"].size(), 3u);
  const std::string reason = json["reason"];
  EXPECT_NE(reason.find("an obstacle lies between them"), std::string::npos) << reason;
  EXPECT_NE(reason.find("where the map ends"), std::string::npos) << reason;
  EXPECT_EQ(reason.find("unknown"), std::string::npos) << reason;
}

TEST_F(CliPlan, SaysWhenAPlaceIsUnknown) {
  // The flight volume leaves out a corner of the block that it ends in.
  const std::string map = rooms();
  const Outcome planned = run({"plan", map, "--from", "3.1,0,1", "--to", "2,1,1", "--json"});
  EXPECT_EQ(planned.code, 2);
  EXPECT_EQ(planned.json()["status"], "start_unknown");
  EXPECT_NE(planned.json()["reason"].get<std::string>().find("does not know"), std::string::npos);
}

TEST_F(CliPlan, TellsWhatBlocksARouteAndAtWhichRadiusItWouldNot) {
  const auto blocked_of = [&](const std::string& map, const std::string& radius) {
    const Outcome planned =
        run({"plan", map, "--from", "-2,0,1", "--to", "2,0,1", "--radius", radius, "--json"});
    EXPECT_EQ(planned.code, 2);
    EXPECT_EQ(planned.json()["status"], "no_route");
    EXPECT_NE(planned.json()["components"]["start"], planned.json()["components"]["goal"]);
    return planned.json()["blocked"];
  };
  const Json door = blocked_of(rooms(), "0.7");
  EXPECT_EQ(door["by"], "obstacle");
  EXPECT_NEAR(door["place"][0].get<double>(), 0.0, 0.3);  // in the wall between the rooms
  const std::string radius = std::to_string(door["radius"].get<double>() - 1e-6);
  const Outcome smaller =
      run({"plan", rooms(), "--from", "-2,0,1", "--to", "2,0,1", "--radius", radius});
  EXPECT_EQ(smaller.code, 0) << smaller.out;

  const Outcome built = build_rooms("shut.ridge", {"--exclude", "0,-2,0,0.1,2,2"});
  ASSERT_EQ(built.code, 0) << built.err;
  const Json shut = blocked_of(path("shut.ridge"), "0.3");
  EXPECT_EQ(shut["radius"], 0.0);
  EXPECT_TRUE(shut["by"] == "obstacle" ? shut["place"].is_null() : shut["place"].is_array());
}

TEST_F(CliPlan, AnswersAFileOfQueries) {
  const std::string map = rooms();
  write_whole(folder_ / "queries.csv",
              "x0,y0,z0,x1,y1,z1,radius\n-2,1.5,1,2,1.5,1\n# a comment\n\n-2,1,1,2,1,1,0.5\n");
  const Outcome batch = run({"plan", map, "--queries", path("queries.csv"), "--json"});
  EXPECT_EQ(batch.code, 0) << batch.err;
  EXPECT_EQ(batch.json()["solved"], 2);
  EXPECT_EQ(batch.json()["results"].size(), 2u);
  EXPECT_DOUBLE_EQ(batch.json()["results"][1]["radius"], 0.5);

  write_whole(folder_ / "queries.csv", "-2,1.5,1,2,1.5,1\n-2,1,1,2,1,9\n");
  EXPECT_EQ(run({"plan", map, "--queries", path("queries.csv")}).code, 2);
  write_whole(folder_ / "queries.csv", "-2,1.5,1,2,1.5,1\n-2,1,1,2\n");
  expect_refused({"plan", map, "--queries", path("queries.csv")}, {"line 2"});
}

TEST_F(CliPlan, FilesOfBeforeThatNothingIsWrittenToAreTold) {
  const std::string map = rooms();
  for (const char* name : {"path.csv", "way-2.csv", "way-3.csv"})
    write_whole(folder_ / name, "of before");
  const std::vector<std::string> into_wall = {"--from", "-2,1.5,1", "--to", "0.05,1.9,1"};
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"plan", map, "-o", path("path.csv")},
        {"plan", map, "--nearest", "-o", path("path.csv")},
        {"trajectory", map, "-o", path("path.csv")}}) {
    std::vector<std::string> words = command;
    words.insert(words.end(), into_wall.begin(), into_wall.end());
    const Outcome none = run(words);
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("path.csv is from before"), std::string::npos) << none.err;
    EXPECT_EQ(read_whole(folder_ / "path.csv"), "of before");
  }
  const Outcome one = run({"plan", map, "--from", "-2,1.5,1", "--to", "-1,1.5,1", "--alternatives",
                           "9", "-o", path("way.csv")});
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(one.err.find("way-1.csv"), std::string::npos) << one.err;
  for (const char* name : {"way-2.csv is from before", "way-3.csv is from before"})
    EXPECT_NE(one.err.find(name), std::string::npos) << one.err;
}

TEST_F(CliPlan, AlternativesAreRoutesWithTheKeysOfPlans) {
  // A pillar before the door.
  ASSERT_EQ(build_rooms("pillar.ridge", {"--exclude", "-1.6,-0.2,0,-1.2,0.2,2"}).code, 0);
  const std::string map = path("pillar.ridge");
  const std::vector<std::string> query = {"plan", map, "--from", "-2,0,1", "--to", "2,0,1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), query.begin(), query.end());
    return more;
  };
  const Json json = run(with({"--alternatives", "5", "--json"})).json();
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["complete"], true);
  ASSERT_EQ(json["routes"].size(), 2u);
  EXPECT_LE(json["routes"][0]["length"].get<double>(), json["routes"][1]["length"].get<double>());
  const Json single = run(with({"--json"})).json();
  for (const auto& [key, value] : single.items()) EXPECT_TRUE(json["routes"][1].contains(key));
  EXPECT_NE(run(with({"--alternatives", "5"})).out.find("no others"), std::string::npos);
  expect_refused(with({"--alternatives", "2", "--planner", "esdf"}), {"alternatives", "graph"});
  expect_refused(with({"--alternatives", "2", "--to", "1,0,1"}), {"--alternatives", "one --to"});
  expect_refused(with({"--to", "2,0,1", "-o", path("path.csv")}), {"--output"});
}

TEST_F(CliPlan, KeepsFromWallsWhenAskedTo) {
  const std::string map = rooms();
  const std::vector<std::string> query = {"plan", map, "--from", "-2.6,1.5,1", "--to", "2,1.5,1"};
  const auto with = [&](const std::string& weight) {
    std::vector<std::string> all = query;
    all.insert(all.end(), {"--prefer-clearance", weight});
    return all;
  };
  const auto planned = [&](std::vector<std::string> all) {
    all.emplace_back("--json");
    return run(all).json();
  };
  const Json wide = planned(with("10")), tight = planned(query);
  EXPECT_EQ(planned(with("0"))["waypoints"], tight["waypoints"]);
  EXPECT_GT(wide["length"].get<double>(), tight["length"].get<double>());
  EXPECT_GT(wide["clearance"].get<double>(), tight["clearance"].get<double>());
  expect_refused(with("-1"), {"--prefer-clearance", "-1"});
  std::vector<std::string> sampled = with("1");
  sampled.insert(sampled.end(), {"--planner", "rrtstar"});
  expect_refused(sampled, {"--prefer-clearance", "rrtstar"});
}

TEST_F(CliPlan, QualityIsOfShortenedPathsOfPlannersThatDoNotSample) {
  std::vector<std::string> query = {"plan", rooms(),   "--from",    "-2,1.5,1",
                                    "--to", "2,1.5,1", "--quality", "best"};
  EXPECT_EQ(run(query).code, 0);
  query.emplace_back("--raw");
  expect_refused(query, {"--quality", "--raw"});
  query.back() = "--planner=rrtstar";
  expect_refused(query, {"--quality", "leave it out", "rrtstar"});
}

TEST_F(CliPlan, EscapesFromPlacesTooCloseToAWall) {
  const std::string map = rooms();  // the wall is 0.1 m off, the radius 0.3 m
  const std::vector<std::string> query = {"plan", map, "--from", "-2,1.9,1", "--to", "2,1.5,1"};
  EXPECT_EQ(run(query).code, 2);
  std::vector<std::string> more = query;
  more.emplace_back("--escape");
  const Outcome person = run(more);
  EXPECT_EQ(person.code, 0) << person.err;
  EXPECT_NE(person.out.find("at the start, clearance 0.1 m"), std::string::npos) << person.out;
  more.emplace_back("--json");
  const Json json = run(more).json();
  EXPECT_EQ(json["waypoints"].front(), Json({-2.0, 1.9, 1.0}));
  EXPECT_NEAR(json["escape_start"]["clearance"].get<double>(), 0.1, 1e-9);
  EXPECT_GE(json["escape_start"]["length"].get<double>(), 0.2 - 1e-9);
  EXPECT_FALSE(json.contains("escape_goal"));
  EXPECT_GE(json["clearance"].get<double>(), 0.3 * (1 - 1e-9));
}

TEST_F(CliPlan, GoesToManyGoalsOrTheNearest) {
  const std::string map = rooms();
  const std::vector<std::string> query = {"plan", map,       "--from", "-2,1,1",   "--to",  "2,1,1",
                                          "--to", "-2,-1,1", "--to",   "-2,1.9,1", "--json"};
  const Outcome many = run(query);
  EXPECT_EQ(many.code, 2);
  EXPECT_EQ(many.json()["queries"], 3);
  EXPECT_EQ(many.json()["solved"], 2);
  EXPECT_GE(many.json()["results"][0]["distance"].get<double>(),
            many.json()["results"][0]["length"].get<double>());
  EXPECT_EQ(many.json()["results"][2]["status"], "goal_in_collision");

  std::vector<std::string> more = query;
  more.insert(more.end(), {"--nearest", "-o", path("nearest.csv")});
  const Outcome nearest = run(more);
  EXPECT_EQ(nearest.code, 0) << nearest.err;
  EXPECT_EQ(nearest.json()["goal"], 1);
  EXPECT_EQ(nearest.json()["goals"], Json({"farther", "ok", "goal_in_collision"}));
  EXPECT_EQ(nearest.json()["waypoints"].back(), Json({-2.0, -1.0, 1.0}));
  EXPECT_TRUE(exists("nearest.csv"));
  expect_refused(
      {"plan", map, "--from", "-2,1,1", "--to", "2,1,1", "--to", "1,1,1", "--planner", "rrtstar"},
      {"--planner rrtstar", "several goals"});
}

TEST_F(CliPlan, RefusesWhatItWouldPassOver) {
  const std::string map = rooms();
  write_whole(folder_ / "queries.txt", "-2,1,1,2,1,1\n");
  expect_refused({"plan", map, "--queries", path("queries.txt"), "--alternatives", "2"},
                 {"--alternatives", "--queries"});
  expect_refused(
      {"plan", map, "--from", "-2,1,1", "--to", "2,1,1", "--alternatives", "2", "--repeat", "3"},
      {"--repeat", "leave it out with --alternatives"});
}

}  // namespace
}  // namespace ridgeway
