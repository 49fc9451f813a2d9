// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/path_io.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "ridgeway/common/error.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

PlanResult sample_plan() {
  PlanResult result;
  result.status = PlanStatus::kOk;
  result.answered_by = Planner::kDiagram;
  result.waypoints = {{0.1, -0.2, 1.0 / 3.0}, {1e-17, 12345678.9, -0.0}, {2.0, 3.0, 4.5}};
  result.length = 10.0 / 3.0;
  result.clearance = 0.4;
  result.seconds = {1e-5, 2e-5, 3e-5, 6e-5};
  return result;
}

TEST(PathIo, WaypointsComeBackFromBothFormats) {
  const TemporaryFolder folder;
  const PlanResult plan = sample_plan();
  for (const char* name : {"path.csv", "path.json", "PATH.CSV", "Path.Json"}) {
    write_plan(plan, folder / name);
    const std::vector<Point> points = read_path(folder / name);
    ASSERT_EQ(points.size(), plan.waypoints.size()) << name;
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i], plan.waypoints[i]);
  }
  EXPECT_EQ(read_whole(folder / "path.csv").substr(0, 6), "x,y,z\n");
}

TEST(PathIo, EscapesComeBackFromJson) {
  const TemporaryFolder folder;
  PlanResult plan = sample_plan();
  plan.escape_start = {.length = 0.7, .clearance = 0.1};
  for (const char* name : {"path.csv", "path.json"}) write_plan(plan, folder / name);
  const PathEscapes read = read_escapes(folder / "path.json");
  EXPECT_EQ(read.start.length, 0.7);
  EXPECT_EQ(read.start.clearance, 0.1);
  EXPECT_EQ(read.goal.length, 0.0);
  EXPECT_EQ(read_escapes(folder / "path.csv").start.length, 0.0);
  for (const char* bad : {R"({"escape_goal":{"length":-1,"clearance":1}})", R"({"escape_goal":7})",
                          R"({"escape_goal":{"length":1,"clearance":0}})",
                          R"({"escape_goal":{"length":1,"clearance":null}})", "{"}) {
    std::ofstream(folder / "bad.json") << bad;
    EXPECT_THROW(read_escapes(folder / "bad.json"), InputError) << bad;
  }
}

TEST(PathIo, JsonHasThePlansKeys) {
  const auto json = nlohmann::json::parse(plan_json(sample_plan()));
  EXPECT_EQ(json.at("answered_by"), "diagram");
  EXPECT_EQ(json.at("status"), "ok");
  EXPECT_EQ(json.at("length").get<double>(), 10.0 / 3.0);
  EXPECT_EQ(json.at("clearance").get<double>(), 0.4);
  EXPECT_EQ(json.at("seconds").at("shorten").get<double>(), 3e-5);
  EXPECT_EQ(json.at("waypoints").size(), 3u);
  PlanResult none;
  none.clearance = std::numeric_limits<double>::infinity();
  const auto without = nlohmann::json::parse(plan_json(none));
  EXPECT_EQ(without.at("status"), "no_route");
  EXPECT_TRUE(without.at("waypoints").is_array());
  EXPECT_TRUE(without.at("clearance").is_null());
}

TEST(PathIo, NoPathIsNoTable) {
  const TemporaryFolder folder;
  write_plan({}, folder / "none.json");
  EXPECT_EQ(nlohmann::json::parse(read_whole(folder / "none.json")).at("status"), "no_route");
  EXPECT_THROW(read_path(folder / "none.json"), InputError);
  EXPECT_THROW(write_plan({}, folder / "none.csv"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "none.csv"));
}

TEST(PathIo, ColumnsAreFoundByName) {
  const TemporaryFolder folder;
  write_whole(folder / "a.csv", "t, z, y, x\r\n# comment\r\n0, 3, 2, 1\r\n\r\n1, 6, 5, 4\r\n");
  EXPECT_EQ(read_path(folder / "a.csv"), (std::vector<Point>{{1, 2, 3}, {4, 5, 6}}));
  write_whole(folder / "b.csv", "1,2,3\n4,5,6");
  EXPECT_EQ(read_path(folder / "b.csv"), (std::vector<Point>{{1, 2, 3}, {4, 5, 6}}));
  write_whole(folder / "d.csv", "\xEF\xBB\xBFx,y,z\n1,2,3\n4,5,6\n");
  EXPECT_EQ(read_path(folder / "d.csv"), (std::vector<Point>{{1, 2, 3}, {4, 5, 6}}));
  write_whole(folder / "c.json", "[[1, 2, 3], [4, 5, 6]]");
  EXPECT_EQ(read_path(folder / "c.json"), (std::vector<Point>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(PathIo, BadFilesAreRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& text) {
    write_whole(folder / name, text);
    EXPECT_THROW(read_path(folder / name), InputError) << name << ": " << text;
  };
  refused("a.csv", "x,y,z\n1,2\n");
  refused("a.csv", "x,y\n1,2\n");
  refused("a.csv", "x,y,z\n1,2,nan\n");
  refused("a.csv", "x,y,z\n1,2,3m\n");
  refused("a.json", "[[1, 2], [3, 4]]");
  refused("a.json", "{\"points\": []}");
  refused("a.json", "[1, 2, 3]");
  refused("a.json", "\"text\"");
  refused("a.json", "[[1, 2, \"3\"]]");
  refused("a.json", "{\"waypoints\": 5}");
  refused("a.json", "");
  refused("a.txt", "1,2,3");
  EXPECT_THROW(read_path(folder / "none.csv"), InputError);
  EXPECT_THROW(read_path(folder / "none.json"), InputError);
  EXPECT_THROW(write_plan(sample_plan(), folder / "path.txt"), InputError);
  EXPECT_THROW(write_plan(sample_plan(), folder / "none/path.csv"), InputError);
}

}  // namespace
}  // namespace ridgeway
