// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "example_query.hpp"
#include "json.hpp"
#include "limit_options.hpp"
#include "recording_facts.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "roadmap_facts.hpp"
#include "source_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShownComponents = 10;

struct InfoOptions {
  std::string file;
  std::optional<Point> at;
};

/// As plan has it, but of no start: "unknown", "in_collision", ...
std::string reason_of(const PlaceFacts& facts) {
  return std::string(name_of(facts.status)).substr(std::string("start_").size());
}

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

Json roadmap_json(const InfoOptions& options, const Roadmap& roadmap, const RidgeInfo& file) {
  const OccupancyMap occupancy = occupancy_of(roadmap.esdf);
  const VoxelCounts counts = count_voxels(occupancy);
  Json json = {{"file", options.file},
               {"format", "ridge"},
               {"version", file.version},
               {"file_bytes", std::filesystem::file_size(options.file)},
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

/// Of a part of space: in the plane its area.
std::string size_text(double volume, const EsdfMap& esdf) {
  return esdf.planar ? text_of(volume / esdf.voxel_size) + " m2" : text_of(volume) + " m3";
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

Json json_of(const PlaceFacts& facts, const Point& at) {
  constexpr const char* kStates[] = {"unknown", "free", "occupied"};
  Json json = {{"at", cli::json_of(at)},
               {"status", std::string(facts.status == PlanStatus::kOk ? "ok" : reason_of(facts))},
               {"voxel", kStates[static_cast<int>(facts.state)]},
               {"clearance", facts.clearance}};
  if (facts.status != PlanStatus::kOk) return json;
  json["component"] = facts.component;
  json["component_volume"] = facts.report.components[facts.component].volume;
  json["ways"] = Json::array();
  for (const ComponentJoin& way : facts.ways)
    json["ways"].push_back({{"component", way.b},
                            {"volume", facts.report.components[way.b].volume},
                            {"radius", way.radius},
                            {"place", cli::json_of(way.place)},
                            {"by", std::string(name_of(way.by))}});
  return json;
}

void print_place(const EsdfMap& esdf, const PlaceFacts& facts, const Point& at) {
  constexpr const char* kStates[] = {"unknown", "free", "occupied"};
  print_row("place", point_text(at) + ", in a voxel that is " +
                         kStates[static_cast<int>(facts.state)] + ", clearance " +
                         text_of(rounded_down(facts.clearance)) + " m");
  if (facts.status != PlanStatus::kOk) return print_row("not usable", reason_of(facts));
  const std::vector<Component>& all = facts.report.components;
  print_row("component", std::to_string(facts.component + 1) + " of " + count_text(all.size()) +
                             ", " + size_text(all[facts.component].volume, esdf));
  std::size_t shown = 0;
  for (const ComponentJoin& way : facts.ways) {
    if (++shown > kShownComponents) break;
    print_row("to component " + std::to_string(way.b + 1),
              size_text(all[way.b].volume, esdf) + ", at a radius of " +
                  text_of(rounded_down(way.radius)) + " m, narrowest at " + point_text(way.place) +
                  ", between " + blocker_text(way.by));
  }
  if (facts.ways.size() > kShownComponents)
    print_row("", "and " + count_text(facts.ways.size() - kShownComponents) + " more (see --json)");
  const std::size_t shut = all.size() - 1 - facts.ways.size();
  if (shut > 0) print_row("", count_text(shut) + " components that no robot reaches from here");
}

int run_place(const InfoOptions& options, const Globals& globals) {
  const Roadmap roadmap = load_roadmap(options.file);
  const PlaceFacts facts = describe_place(roadmap, *options.at);
  if (globals.json)
    print_json(json_of(facts, *options.at));
  else
    print_place(roadmap.esdf, facts, *options.at);
  return kExitDone;
}

/// With all digits that a coordinate needs.
std::string exact_text(const Json& place) {
  std::string text;
  for (const Json& coordinate : place) text += (text.empty() ? "" : ",") + coordinate.dump();
  return text;
}

/// As a shell takes it.
std::string word_text(const std::string& word) {
  const bool is_plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/._-+").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

int run_roadmap(const InfoOptions& options, const Globals& globals) {
  const Roadmap roadmap = load_roadmap(options.file);
  Json json = roadmap_json(options, roadmap, read_ridge_info(options.file));
  const ComponentReport report = report_components(roadmap);
  if (const auto query = example_query(roadmap))
    json["example"] = {{"from", cli::json_of(query->first)}, {"to", cli::json_of(query->second)}};
  if (globals.json) {
    json.update(json_of(report));
    print_json(json);
  } else {
    print_roadmap(roadmap.esdf, json);
    print_components(roadmap.esdf, report);
    if (json.contains("example"))
      print_row("for example", "ridgeway plan " + word_text(options.file) + " --from " +
                                   exact_text(json["example"]["from"]) + " --to " +
                                   exact_text(json["example"]["to"]));
  }
  return kExitDone;
}

int run(const InfoOptions& options, const Globals& globals) {
  if (options.at && !is_roadmap_file(options.file))
    throw InputError("--at", "is of roadmaps", "build one of " + options.file + " first");
  if (options.at) return run_place(options, globals);
  if (is_roadmap_file(options.file)) return run_roadmap(options, globals);
  std::error_code error;
  const bool is_recording = std::filesystem::is_directory(options.file, error);
  const Json json = is_recording ? describe_recording(options.file, globals)
                                 : describe_source(options.file, globals);
  if (globals.json)
    print_json(json);
  else if (is_recording)
    print_recording(json);
  else
    print_source(json);
  return kExitDone;
}

}  // namespace

void add_info_command(Command& program) {
  const auto options = std::make_shared<InfoOptions>();
  Command command = program.add("info", "Tell what a roadmap, a map or a recording holds");
  command
      .path("file", options->file,
            "Roadmap .ridge, a map that build reads, or the folder of a recording")
      .required();
  command.point("--at", options->at,
                "A place X,Y,Z of a roadmap, metres: the component that it is in, its clearance, "
                "and what is in the way to the other components");
  command.footer(
      "For a roadmap also its components: how large, how wide, and where a smaller robot would\n"
      "find them joined; and a start and a goal to try.\n"
      "Example:\n"
      "  ridgeway info office.ridge");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
