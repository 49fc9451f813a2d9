// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// example_plan_once MAP.bt: from a map to a path, from its widest place to the farthest one that it
// is connected with.
#include <cstdio>
#include <exception>

#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: example_plan_once MAP.bt\n");
    return 1;
  }
  const auto built =
      ridgeway::build_roadmap(ridgeway::load_map(argv[1], {}), {.min_clearance = 0.3});
  const ridgeway::EsdfMap& esdf = built.roadmap.esdf;
  const ridgeway::SparseGraph& graph = built.roadmap.graph;
  const ridgeway::GraphComponents parts = ridgeway::connected_components(graph);
  std::size_t widest = 0;
  for (std::size_t v = 0; v < graph.vertices.size(); ++v)
    if (graph.vertices[v].clearance > graph.vertices[widest].clearance) widest = v;
  const ridgeway::Point start = graph.vertices[widest].position;
  std::size_t farthest = widest;
  for (std::size_t v = 0; v < graph.vertices.size(); ++v)
    if (parts.label[v] == parts.label[widest] &&
        (graph.vertices[v].position - start).norm() >
            (graph.vertices[farthest].position - start).norm())
      farthest = v;
  const ridgeway::PlanResult path =
      ridgeway::plan(built.roadmap, ridgeway::to_world(esdf, start),
                     ridgeway::to_world(esdf, graph.vertices[farthest].position));
  if (!path.ok()) {
    std::printf("no path: %s\n", ridgeway::name_of(path.status).data());
    return 2;
  }
  std::printf("%.2f m, never closer than %.2f m to an obstacle:\n", path.length, path.clearance);
  for (const ridgeway::Point& p : path.waypoints)
    std::printf("  %.2f %.2f %.2f\n", p.x(), p.y(), p.z());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
