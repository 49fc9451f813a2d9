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
#include "recording_facts.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "roadmap_facts.hpp"
#include "roadmap_report.hpp"
#include "source_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::string file;
  std::optional<Point> at;
};

/// As plan has it, but of no start: "unknown", "in_collision", ...
std::string reason_of(const PlaceFacts& facts) {
  return std::string(name_of(facts.status)).substr(std::string("start_").size());
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
  Json json = roadmap_json(options.file, roadmap);
  const ComponentReport report = report_components(roadmap);
  if (const auto query = example_query(roadmap))
    json["example"] = {{"from", cli::json_of(query->first)}, {"to", cli::json_of(query->second)}};
  if (globals.json) {
    json.update(cli::json_of(report));
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
