// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// A scan in UTM coordinates, with the real program: all that goes in and comes out is in them.
#include <cmath>

#include "program.hpp"

namespace ridgeway {
namespace {

constexpr double kEast = 465000.0, kNorth = 5300000.0, kUp = -0.5;

class CliFarMap : public Program {
 protected:
  void build_both() {
    build("near.ridge", {});
    build("far.ridge", {"--transform", "465000,5300000,-0.5,0,0,0"});
  }

  void build(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "build", kScan, "-o", path(name), "--voxel-size", "0.1", "--min-clearance", "0.3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome built = run(arguments);
    ASSERT_EQ(built.code, 0) << built.err;
  }

  /// [x, y, z] lists that differ by the shift alone.
  static void expect_shifted(const Json& near, const Json& far) {
    ASSERT_EQ(near.size(), 3u);
    ASSERT_EQ(far.size(), 3u);
    EXPECT_NEAR(far[0].get<double>() - kEast, near[0].get<double>(), 2e-9);
    EXPECT_NEAR(far[1].get<double>() - kNorth, near[1].get<double>(), 2e-9);
    EXPECT_NEAR(far[2].get<double>() - kUp, near[2].get<double>(), 2e-9);
  }
  static void expect_shifted_lists(const Json& near, const Json& far) {
    ASSERT_EQ(near.size(), far.size());
    for (std::size_t i = 0; i < near.size(); ++i) expect_shifted(near[i], far[i]);
  }

  static std::vector<std::string> ends(bool far) {
    if (far) return {"--from", "465000,5300000,0.1", "--to", "465010,5300000,0.1"};
    return {"--from", "0,0,0.6", "--to", "10,0,0.6"};
  }
  Json answer(std::vector<std::string> arguments, bool far) {
    arguments.insert(arguments.begin() + 1, path(far ? "far.ridge" : "near.ridge"));
    for (const std::string& argument : ends(far)) arguments.push_back(argument);
    arguments.push_back("--json");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    return outcome.json();
  }
};

TEST_F(CliFarMap, PlansAreTheSameButForTheShift) {
  build_both();
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"plan"},
           {"plan", "--planner", "esdf"},
           {"plan", "--planner", "rrtconnect", "--iteration-limit", "20000"},
           {"plan", "--prefer-clearance", "1"}}) {
    const Json near = answer(arguments, false), far = answer(arguments, true);
    EXPECT_EQ(near["length"], far["length"]);
    EXPECT_EQ(near["clearance"], far["clearance"]);
    expect_shifted_lists(near["waypoints"], far["waypoints"]);
  }
  const Json near = answer({"plan", "--alternatives", "2"}, false),
             far = answer({"plan", "--alternatives", "2"}, true);
  ASSERT_EQ(near["routes"].size(), far["routes"].size());
  for (std::size_t i = 0; i < near["routes"].size(); ++i)
    expect_shifted_lists(near["routes"][i]["waypoints"], far["routes"][i]["waypoints"]);
}

TEST_F(CliFarMap, TrajectoriesFlyThere) {
  build_both();
  const Json far = answer({"trajectory"}, true);
  EXPECT_EQ(far["status"], "ok");
  const Json& first = far["samples"].front()["position"];
  EXPECT_NEAR(first[0].get<double>(), 465000.0, 1e-6);
  EXPECT_NEAR(first[1].get<double>(), 5300000.0, 1e-6);
  EXPECT_NEAR(far["samples"].back()["position"][0].get<double>(), 465010.0, 1e-6);
  EXPECT_NEAR(far["duration"].get<double>(),
              answer({"trajectory"}, false)["duration"].get<double>(), 1e-3);
}

TEST_F(CliFarMap, ChecksAndFactsAreInItsCoordinates) {
  build_both();
  const Outcome check = run({"check", path("far.ridge"), "--queries", "30", "--json"});
  EXPECT_EQ(check.code, 0) << check.out << check.err;
  const Json near = run({"info", path("near.ridge"), "--json"}).json(),
             far = run({"info", path("far.ridge"), "--json"}).json();
  expect_shifted(near["bounds"]["min"], far["bounds"]["min"]);
  expect_shifted(near["bounds"]["max"], far["bounds"]["max"]);
  EXPECT_EQ(near["components"].size(), far["components"].size());
  for (std::size_t i = 0; i < near["components"].size(); ++i)
    expect_shifted(near["components"][i]["widest"], far["components"][i]["widest"]);
  const Outcome outside =
      run({"plan", path("far.ridge"), "--from", "0,0,0.6", "--to", "465010,5300000,0.1"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.out.find("is outside the map: give one between 46"), std::string::npos)
      << outside.out;
}

TEST_F(CliFarMap, ExportsAreInItsCoordinates) {
  build_both();
  for (const char* name : {"near", "far"}) {
    const std::string file = path(std::string(name) + ".ridge");
    ASSERT_EQ(run({"export", file, "-o", path(std::string(name) + ".json"), "-o",
                   path(std::string(name) + ".graphml"), "-o", path(std::string(name) + ".ply"),
                   "--picture", path(std::string(name) + ".png")})
                  .code,
              0);
  }
  const Json near = Json::parse(read_whole(folder_ / "near.json")),
             far = Json::parse(read_whole(folder_ / "far.json"));
  ASSERT_EQ(near["nodes"].size(), far["nodes"].size());
  const auto place = [](const Json& node) { return Json{node["x"], node["y"], node["z"]}; };
  for (std::size_t i = 0; i < near["nodes"].size(); ++i)
    expect_shifted(place(near["nodes"][i]), place(far["nodes"][i]));
  EXPECT_TRUE(near["links"] == far["links"]);
}

TEST_F(CliFarMap, BeyondTheLimitTheTransformIsRefused) {
  expect_refused({"build", kScan, "-o", path("no.ridge"), "--transform", "1e9,0,0,0,0,0"},
                 {"1e9 voxels"});
}

}  // namespace
}  // namespace ridgeway
