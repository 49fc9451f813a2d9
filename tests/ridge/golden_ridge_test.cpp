// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <utility>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/synthetic_roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

// golden/rooms.ridge is a file of the current version of the format, and golden/rooms.txt what was
// planned with it. A change that reads the file differently is found here. Where the format is
// changed on purpose, both are written anew, and looked at before they are committed:
//   RIDGEWAY_WRITE_GOLDEN=1 build/bin/ridge_tests --gtest_filter='GoldenRidge.*'
// Where planning is changed on purpose, the text alone becomes what is planned on the kept file:
//   RIDGEWAY_WRITE_GOLDEN=text, the same

const std::string kFolder = std::string(RIDGEWAY_SOURCE_DIR) + "/tests/ridge/golden/";

/// Plans between vertices of the graph, by every planner of our own, as text.
std::string plans_on(const Roadmap& roadmap) {
  std::ostringstream text;
  text.precision(17);
  const std::vector<Vertex>& vertices = roadmap.graph.vertices;
  text << vertices.size() << " vertices, " << roadmap.graph.edges.size() << " edges, "
       << roadmap.tangents.graph.vertices.size() << " corners\n";
  // The vertices farthest apart, in different rooms.
  std::pair<Point, Point> ends(vertices[0].position, vertices[0].position);
  for (const Vertex& a : vertices)
    for (const Vertex& b : vertices)
      if ((a.position - b.position).norm() > (ends.first - ends.second).norm())
        ends = {a.position, b.position};
  const Point start = to_world(roadmap.esdf, ends.first),
              goal = to_world(roadmap.esdf, ends.second);
  for (const Planner planner : {Planner::kGraph, Planner::kDiagram, Planner::kEsdf}) {
    const PlanResult result = plan(roadmap, start, goal, {.planner = planner});
    text << name_of(planner) << ": " << name_of(result.status) << ", length " << result.length
         << ", clearance " << result.clearance << "\n";
    for (const Point& p : result.waypoints)
      text << "  " << p.x() << " " << p.y() << " " << p.z() << "\n";
  }
  return text.str();
}

/// Both, or the text of the kept file alone.
void write_golden(const std::string& what) {
  if (what == "text") {
    write_whole(kFolder + "rooms.txt", plans_on(load_roadmap(kFolder + "rooms.ridge")));
    return;
  }
  const OccupancyMap map = synthetic_map({.rooms_x = 2, .rooms_y = 1, .room = 16, .height = 14});
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.2}).roadmap;
  save_roadmap(roadmap, kFolder + "rooms.ridge");
  write_whole(kFolder + "rooms.txt", plans_on(roadmap));
}

TEST(GoldenRidge, OfTheCurrentVersionLoadsAndPlansAsItDid) {
  if (const char* what = std::getenv("RIDGEWAY_WRITE_GOLDEN")) write_golden(what);
  const Roadmap roadmap = load_roadmap(kFolder + "rooms.ridge");
  EXPECT_EQ(plans_on(roadmap), read_whole(kFolder + "rooms.txt"));
}

/// What is loaded and saved again is the file itself.
TEST(GoldenRidge, IsSavedAgainAsTheSameBytes) {
  const TemporaryFolder folder;
  save_roadmap(load_roadmap(kFolder + "rooms.ridge"), folder / "again.ridge");
  EXPECT_EQ(read_whole(folder / "again.ridge"), read_whole(kFolder + "rooms.ridge"));
}

}  // namespace
}  // namespace ridgeway
