// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// shift_oracle CLEARANCE MAP...: builds each map where it is and moved by whole voxels, near and up
// to the limit of coordinates: the roadmaps' files have to be the same but for their origin, and
// paths between the same places. A line for each map; exit code 1 where any differs.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/shifted_map.hpp"

namespace ridgeway {
namespace {

/// How many of the plans between vertices of the graph are other ones on the moved map.
int count_other_plans(const Roadmap& near, const Roadmap& far) {
  const std::vector<Vertex>& vertices = near.graph.vertices;
  int others = 0;
  for (std::size_t i = 0; i + 1 < vertices.size(); i += 1 + vertices.size() / 40) {
    const Point &start = vertices[i].position, &goal = vertices[vertices.size() - 1 - i].position;
    const PlanResult a = plan(near, to_world(near.esdf, start), to_world(near.esdf, goal));
    const PlanResult b = plan(far, to_world(far.esdf, start), to_world(far.esdf, goal));
    others += a.status != b.status || a.length != b.length || a.clearance != b.clearance ||
              a.waypoints.size() != b.waypoints.size();
  }
  return others;
}

bool is_the_same_everywhere(const std::filesystem::path& file, double clearance) {
  const TemporaryFolder folder;
  const BuildConfig config{.min_clearance = clearance};
  const OccupancyMap map = load_map(file, {});
  const Roadmap near = build_roadmap(testing::moved_map(map, {}), config).roadmap;
  const std::string bytes = testing::bytes_but_for_the_origin(near, folder);
  const std::vector<VoxelIndex> shifts = testing::shifts_of(map);
  int other_files = 0, other_plans = 0;
  for (const VoxelIndex& shift : shifts) {
    const Roadmap far = build_roadmap(testing::moved_map(map, shift), config).roadmap;
    other_files += far.esdf.origin != near.esdf.origin + shift ||
                   testing::bytes_but_for_the_origin(far, folder) != bytes;
    other_plans += count_other_plans(near, far);
  }
  std::printf("%-28s %zu shifts, %zu bytes, %d other files, %d other plans\n",
              file.filename().c_str(), shifts.size(), bytes.size(), other_files, other_plans);
  std::fflush(stdout);
  return other_files == 0 && other_plans == 0;
}

}  // namespace
}  // namespace ridgeway

int main(int argc, char** argv) {
  bool same = argc > 2;
  for (int i = 2; i < argc; ++i) try {
      same &= ridgeway::is_the_same_everywhere(argv[i], std::atof(argv[1]));
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", argv[i], error.what());
      same = false;
    }
  return same ? 0 : 1;
}
