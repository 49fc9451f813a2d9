// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap_report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "console.hpp"
#include "json.hpp"
#include "limit_options.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "source_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Memory {
  const char* part;
  std::size_t bytes;
};

template <typename Value>
std::size_t bytes_of(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}

std::vector<Memory> memory_of(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  const SparseGraph& graph = roadmap.graph;
  const ClearanceTree& tree = roadmap.tree;
  const TangentGraph& tangents = roadmap.tangents;
  return {{"esdf", esdf.layout.memory_bytes() + esdf.state.memory_bytes() +
                       esdf.squared.memory_bytes() + esdf.site.memory_bytes() +
                       esdf.obstacle.memory_bytes()},
          {"diagram", roadmap.diagram.voxels.memory_bytes()},
          {"graph", bytes_of(graph.vertices) + bytes_of(graph.edges) + bytes_of(graph.first_link) +
                        bytes_of(graph.links)},
          {"attach", roadmap.attach.next.memory_bytes()},
          {"tangents", bytes_of(tangents.graph.vertices) + bytes_of(tangents.graph.edges) +
                           bytes_of(tangents.graph.first_link) + bytes_of(tangents.graph.links) +
                           bytes_of(tangents.hubs.first) + bytes_of(tangents.hubs.labels) +
                           bytes_of(tangents.hubs.next) + bytes_of(tangents.region_of_block) +
                           bytes_of(tangents.first_seen) + bytes_of(tangents.seen)},
          {"tree", bytes_of(tree.parent) + bytes_of(tree.clearance) + bytes_of(tree.place)}};
}

Json json_of(const ComponentJoin& join) {
  return {{"a", join.a},
          {"b", join.b},
          {"radius", join.radius},
          {"place", cli::json_of(join.place)},
          {"by", std::string(name_of(join.by))}};
}

std::string limits_text(const EsdfMap& esdf) {
  const FlightLimits limits = limits_in_world(esdf);
  std::string text;
  for (int axis = 0; axis < (esdf.planar ? 2 : 3); ++axis) {
    const double low = limits.keep_in.min[axis], high = limits.keep_in.max[axis];
    if (std::isinf(low) && std::isinf(high)) continue;
    text += std::string(text.empty() ? "" : ", ") + "xyz"[axis] +
            (std::isfinite(low) ? " from " + text_of(low) : "") +
            (std::isfinite(high) ? " to " + text_of(high) : "");
  }
  for (const Box& box : limits.keep_out)
    text += (text.empty() ? "out of " : ", out of ") + box_text(box);
  return text;
}

double rest_volume(const ComponentReport& report, std::size_t shown) {
  double volume = 0.0;
  for (std::size_t i = shown; i < report.components.size(); ++i)
    volume += report.components[i].volume;
  return volume;
}

}  // namespace

Json json_of(const ComponentReport& report) {
  Json components = Json::array(), joins = Json::array();
  for (const Component& c : report.components)
    components.push_back({{"voxels", c.voxels},
                          {"volume", c.volume},
                          {"widest", cli::json_of(c.widest)},
                          {"clearance", c.clearance}});
  for (const ComponentJoin& j : report.joins) joins.push_back(json_of(j));
  return {{"components", std::move(components)}, {"joins", std::move(joins)}};
}

Json roadmap_json(const std::string& name, const Roadmap& roadmap) {
  const RidgeInfo file = read_ridge_info(name);
  const OccupancyMap occupancy = occupancy_of(roadmap.esdf);
  const VoxelCounts counts = count_voxels(occupancy);
  Json json = {{"file", name},
               {"format", "ridge"},
               {"version", file.version},
               {"file_bytes", std::filesystem::file_size(name)},
               {"source", roadmap.source},
               {"voxel_size", roadmap.esdf.voxel_size},
               {"origin", {roadmap.esdf.origin.x, roadmap.esdf.origin.y, roadmap.esdf.origin.z}},
               {"unknown_policy", name_of(roadmap.esdf.unknown)},
               {"max_distance", roadmap.esdf.max_distance},
               {"min_clearance", roadmap.min_clearance}};
  if (roadmap.esdf.planar) json["planar"] = true;
  if (roadmap.esdf.limits.any()) json["limits"] = cli::json_of(limits_in_world(roadmap.esdf));
  if (const auto bounds = known_bounds(occupancy)) json["bounds"] = cli::json_of(*bounds);
  json["voxels"] = {
      {"free", counts.free}, {"occupied", counts.occupied}, {"unknown", counts.unknown}};
  json["allocated_voxels"] = roadmap.esdf.layout.voxel_count();
  json["diagram_voxels"] = roadmap.diagram.voxels.count();
  json["graph"] = {{"vertices", roadmap.graph.vertices.size()},
                   {"edges", roadmap.graph.edges.size()},
                   {"components", connected_components(roadmap.graph).count},
                   {"min_clearance", roadmap.graph.min_clearance}};
  json["config"] = Json::parse(roadmap.config, nullptr, false);
  if (json["config"].is_discarded()) json["config"] = roadmap.config;
  std::size_t total = 0;
  for (const Memory& memory : memory_of(roadmap)) {
    json["memory_bytes"][memory.part] = memory.bytes;
    total += memory.bytes;
  }
  json["memory_bytes"]["total"] = total;
  for (const RidgeSection& section : file.sections)
    json["sections"].push_back({{"name", section.name},
                                {"raw_bytes", section.raw_bytes},
                                {"compressed_bytes", section.compressed_bytes}});
  return json;
}

std::string size_text(double volume, const EsdfMap& esdf) {
  return esdf.planar ? text_of(volume / esdf.voxel_size) + " m2" : text_of(volume) + " m3";
}

std::string blocker_text(Blocker by) {
  return by == Blocker::kUnknown ? "unknown space" : "obstacles";
}

void print_components(const EsdfMap& esdf, const ComponentReport& report) {
  const std::size_t shown = std::min(report.components.size(), kShownComponents);
  for (std::size_t i = 0; i < shown; ++i) {
    const Component& c = report.components[i];
    print_row("component " + std::to_string(i + 1),
              size_text(c.volume, esdf) + ", " + count_text(c.voxels) + " voxels, widest " +
                  text_of(rounded_down(c.clearance)) + " m at " + point_text(c.widest));
  }
  if (shown < report.components.size())
    print_row("", "and " + count_text(report.components.size() - shown) + " smaller ones, " +
                      size_text(rest_volume(report, shown), esdf) + " in all");
  std::size_t left_out = 0;
  for (const ComponentJoin& j : report.joins) {
    if (j.a >= shown || j.b >= shown) {
      ++left_out;
      continue;
    }
    print_row("would join", "components " + std::to_string(std::min(j.a, j.b) + 1) + " and " +
                                std::to_string(std::max(j.a, j.b) + 1) + " at a radius of " +
                                text_of(rounded_down(j.radius)) + " m, narrowest at " +
                                point_text(j.place) + ", between " + blocker_text(j.by));
  }
  if (left_out > 0)
    print_row("", "and " + count_text(left_out) + " joins of smaller components (see --json)");
}

void print_roadmap(const EsdfMap& esdf, const Json& json) {
  print_row("roadmap", json["file"].get<std::string>() + ", version " +
                           std::to_string(json["version"].get<unsigned>()) + ", " +
                           bytes_text(json["file_bytes"].get<std::uint64_t>()));
  print_row("source", json["source"].get<std::string>());
  print_row("voxel size", text_of(json["voxel_size"].get<double>(), 6) + " m");
  print_row("built for",
            "a radius of " + text_of(json["min_clearance"].get<double>(), 6) +
                " m and more; unknown space: " + json["unknown_policy"].get<std::string>());
  if (esdf.planar)
    print_row("planar", "one layer, in which robots stay at a height of " +
                            text_of(to_world(esdf, flight_place(esdf, Point::Zero())).z()) + " m");
  if (const std::string limits = limits_text(esdf); !limits.empty()) print_row("limits", limits);
  if (json.contains("bounds")) print_row("bounds", bounds_text(json["bounds"]));
  print_row("voxels", count_text(json["voxels"]["free"].get<std::uint64_t>()) + " free, " +
                          count_text(json["voxels"]["occupied"].get<std::uint64_t>()) +
                          " occupied");
  print_row("diagram", count_text(json["diagram_voxels"].get<std::uint64_t>()) + " voxels");
  print_row("graph", count_text(json["graph"]["vertices"].get<std::uint64_t>()) + " vertices, " +
                         count_text(json["graph"]["edges"].get<std::uint64_t>()) + " edges, " +
                         count_text(json["graph"]["components"].get<std::uint64_t>()) +
                         " components");
  print_row("memory", bytes_text(json["memory_bytes"]["total"].get<std::uint64_t>()));
  print_row("config", json["config"].dump());
}

}  // namespace ridgeway::cli
