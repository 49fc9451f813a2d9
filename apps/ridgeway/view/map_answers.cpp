// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/map_answers.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "arguments.hpp"
#include "console.hpp"
#include "formats/build_record.hpp"
#include "limit_options.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "viewer/layers.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kBytes = "application/octet-stream";
constexpr const char* kJson = "application/json";
/// What software draws in a frame that still feels alive, and a page loads in a few seconds.
constexpr std::size_t kMostQuads = 800'000, kMostCoarseQuads = 80'000, kMostGvdPoints = 250'000;
constexpr int kMostSliceSamples = 1024, kMostSectionCells = 2048;
/// A page waits no longer for a planner that searches voxels.
constexpr double kLongestPlan = 10.0;

/// What is asked with parameters, and with which.
const std::map<std::string_view, std::set<std::string_view>> kParameters = {
    {"/api/components", {"of"}},
    {"/api/slice", {"z"}},
    {"/api/section", {"z"}},
    {"/api/plan",
     {"from", "to", "radius", "planner", "prefer_clearance", "snap", "escape", "alternatives",
      "explain"}},
    {"/api/trajectory",
     {"from", "to", "radius", "planner", "prefer_clearance", "snap", "escape", "explain", "path",
      "max_speed", "max_acceleration"}},
    {"/api/place", {"at"}}};

/// What is misspelt or given twice would be passed over.
void require_known_parameters(const Question& question) {
  const auto found = kParameters.find(question.path);
  const std::set<std::string_view> known =
      found == kParameters.end() ? std::set<std::string_view>{} : found->second;
  std::string list;
  for (const std::string_view name : known) list.append(list.empty() ? "" : ", ").append(name);
  for (const auto& [name, value] : question.parameters) {
    if (!known.contains(name))
      throw InputError("parameter " + in_quotes(name), "is none of " + question.path,
                       known.empty() ? "leave it out" : "known are " + list);
    if (question.parameters.count(name) > 1)
      throw InputError("parameter " + in_quotes(name), "is given twice", "give it once");
  }
}

/// What leads to a path has no say where it is given.
void require_path_alone(const Question& question) {
  const std::set<std::string_view> taken = {"path", "radius", "max_speed", "max_acceleration"};
  for (const auto& [name, value] : question.parameters)
    if (!taken.contains(name))
      throw InputError("parameter " + in_quotes(name), "plans nothing where a path is given",
                       "leave out this or path");
}

std::optional<std::string> find(const Question& question, const std::string& name) {
  const auto found = question.parameters.find(name);
  if (found == question.parameters.end()) return std::nullopt;
  return found->second;
}

/// 1 or 0.
bool is_set(const Question& question, const std::string& name, bool initial) {
  const std::string text = find(question, name).value_or(initial ? "1" : "0");
  if (text != "0" && text != "1")
    throw InputError(name, "is " + in_quotes(text), "give 1 for yes, 0 for no");
  return text == "1";
}

std::string get(const Question& question, const std::string& name) {
  const auto text = find(question, name);
  if (!text) throw InputError(name, "is missing", "give it in the query: ?" + name + "=..");
  return *text;
}

double number_of(const Question& question, const std::string& name, Range range, double initial) {
  const auto text = find(question, name);
  return text && !text->empty() ? parse_number(*text, range, name) : initial;
}

Query query_of(const Question& question, const Roadmap& roadmap) {
  return {parse_point(get(question, "from"), "from"), parse_point(get(question, "to"), "to"),
          number_of(question, "radius", kLengths, roadmap.min_clearance)};
}

/// Places one after another, with ; between them.
std::vector<Point> parse_path(std::string_view text) {
  std::vector<Point> path;
  while (true) {
    const std::size_t end = text.find(';');
    path.push_back(parse_point(text.substr(0, end), "path"));
    if (end == std::string_view::npos) return path;
    text.remove_prefix(end + 1);
  }
}

PlanConfig config_of(const Question& question, double radius) {
  PlanConfig config{.radius = radius, .time_limit = kLongestPlan};
  if (const auto name = find(question, "planner")) {
    const auto planner = planner_named(*name);
    if (!planner || is_sampling(*planner))
      throw InputError("planner " + in_quotes(*name), "is none of the page's",
                       "give graph, diagram, esdf or theta");
    config.planner = *planner;
  }
  config.prefer_clearance = number_of(question, "prefer_clearance", {0.0, 1e6}, 0.0);
  config.snap = number_of(question, "snap", kLengthsFromZero, 0.0);
  config.escape = is_set(question, "escape", false);
  config.validate();
  return config;
}

Json json_of(const Component& component) {
  return {{"volume", component.volume},
          {"voxels", component.voxels},
          {"clearance", component.clearance},
          {"widest", cli::json_of(component.widest)}};
}

}  // namespace

Reply json_reply(int status, const Json& json) {
  return {status, kJson, std::make_shared<const std::string>(json.dump())};
}

MapAnswers::MapAnswers(const Roadmap& roadmap, const std::string& name)
    : roadmap_(roadmap), name_(printable(name)), facts_(roadmap) {}

Reply MapAnswers::kept(Kept& kept, const char* type, const std::function<std::string()>& make) {
  std::call_once(kept.once, [&] { kept.body = std::make_shared<const std::string>(make()); });
  return {200, type, kept.body};
}

const ComponentReport& MapAnswers::components() {
  std::call_once(components_once_, [&] {
    const BlockLayout& layout = roadmap_.esdf.layout;
    std::vector<VoxelId> asked = roadmap_.diagram.voxels.members(layout);
    for (const Vertex& v : roadmap_.graph.vertices) asked.push_back(layout.find(v.voxel));
    components_ = SpaceParts(roadmap_.esdf).report(roadmap_.min_clearance, asked);
  });
  return components_;
}

Reply MapAnswers::components_of(const std::string& layer) {
  const bool of_graph = layer == "graph";
  if (!of_graph && layer != "diagram")
    throw InputError("of " + in_quotes(layer), "has no components", "give diagram or graph");
  return kept(of_graph ? graph_components_ : diagram_components_, kBytes,
              [&] { return components_of_places(of_graph); });
}

std::string MapAnswers::components_of_places(bool of_graph) {
  const std::span<const std::size_t> all(components().asked);
  const std::size_t first_vertex = all.size() - roadmap_.graph.vertices.size();
  return components_layer(of_graph ? all.subspan(first_vertex) : all.first(first_vertex));
}

std::string MapAnswers::info() {
  const EsdfMap& esdf = roadmap_.esdf;
  Json json = {{"name", name_},
               {"source", roadmap_.source},
               {"voxel_size", esdf.voxel_size},
               {"min_clearance", roadmap_.min_clearance},
               {"largest_radius", largest_radius(esdf)},
               {"unknown", std::string(name_of(esdf.unknown))},
               {"planar", esdf.planar},
               {"bounds", nullptr},
               {"limits", cli::json_of(limits_in_world(esdf))},
               {"vertices", roadmap_.graph.vertices.size()},
               {"edges", roadmap_.graph.edges.size()}};
  const OccupancyMap occupancy = occupancy_of(esdf);
  const VoxelCounts counts = count_voxels(occupancy);
  json["voxels"] = {{"free", counts.free}, {"occupied", counts.occupied}};
  if (const auto bounds = known_bounds(occupancy)) json["bounds"] = cli::json_of(*bounds);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // names may be any bytes
}

std::string MapAnswers::narrow_places() {
  const ComponentReport& report = components();
  Json json = {{"components", Json::array()}, {"joins", Json::array()}};
  for (const Component& component : report.components)
    json["components"].push_back(json_of(component));
  for (const ComponentJoin& join : report.joins)
    json["joins"].push_back({{"a", join.a},
                             {"b", join.b},
                             {"radius", join.radius},
                             {"place", cli::json_of(join.place)},
                             {"by", std::string(name_of(join.by))}});
  return json.dump();
}

void MapAnswers::explain(const Question& question, const PlanConfig& asked, const Query& query,
                         PlanStatus status, Json& json) {
  json["radius"] = query.radius;
  if (!is_set(question, "explain", true) || status == PlanStatus::kOk) return;
  const std::lock_guard<std::mutex> lock(facts_mutex_);
  facts_.set_asked(asked);
  json["reason"] = facts_.reason(query, status);
  if (const auto blocked = facts_.blocked(query, status)) json.update(cli::json_of(*blocked));
}

Json MapAnswers::plan(const Question& question) {
  const Query query = query_of(question, roadmap_);
  const PlanConfig config = config_of(question, query.radius);
  if (!find(question, "alternatives")) {
    const PlanResult result = ridgeway::plan(roadmap_, query.start, query.goal, config);
    Json json = Json::parse(plan_json(result));
    explain(question, config, as_planned(query, result), result.status, json);
    return json;
  }
  const auto count = parse_whole(get(question, "alternatives"), {1, 20}, "alternatives");
  const Alternatives found = plan_alternatives(roadmap_, query.start, query.goal, count, config);
  Json json = {{"status", std::string(name_of(found.status))},
               {"complete", found.complete},
               {"seconds", {{"total", found.seconds}}},
               {"routes", Json::array()}};
  for (const PlanResult& route : found.routes)
    json["routes"].push_back(Json::parse(plan_json(route)));
  const bool is_asked_why = !found.ok() && is_set(question, "explain", true);
  explain(question, config,
          is_asked_why  // planning once more tells where the ends were moved to
              ? as_planned(query, ridgeway::plan(roadmap_, query.start, query.goal, config))
              : query,
          found.status, json);
  return json;
}

Json MapAnswers::trajectory(const Question& question) {
  constexpr double kMostSamples = 20'000.0;
  const auto given = find(question, "path");
  if (given) require_path_alone(question);
  const double radius = number_of(question, "radius", kLengths, roadmap_.min_clearance);
  const Query query = given ? Query{{}, {}, radius} : query_of(question, roadmap_);
  const PlanConfig config = config_of(question, query.radius);
  TrajectoryConfig flight;
  flight.radius = query.radius;
  flight.motion.max_speed = number_of(question, "max_speed", kMotions, flight.motion.max_speed);
  flight.motion.max_acceleration =
      number_of(question, "max_acceleration", kMotions, flight.motion.max_acceleration);
#ifdef RIDGEWAY_STOP_AND_GO
  flight.stop_and_go = true;  // where there is no optimiser
#endif
  flight.validate();
  const PlanResult path = given ? given_path(roadmap_, parse_path(*given), "path")
                                : ridgeway::plan(roadmap_, query.start, query.goal, config);
  if (!path.ok()) {
    Json json = Json::parse(plan_json(path));
    explain(question, config, as_planned(query, path), path.status, json);
    return json;
  }
  const TrajectoryResult flown = fly_plan(roadmap_.esdf, path, flight);
  const double step = std::max(0.02, flown.duration / kMostSamples);
  Json json = Json::parse(trajectory_json(path, flown, step));
  if (!flown.ok()) json["reason"] = "the path is not free at the radius";
  json["radius"] = query.radius;
  return json;
}

Json MapAnswers::place(const Question& question) {
  constexpr const char* kStates[] = {"unknown", "free", "occupied"};
  const EsdfMap& esdf = roadmap_.esdf;
  const Point local = flight_place(esdf, parse_point(get(question, "at"), "at"));
  if (!has_voxel(local, esdf.voxel_size))
    throw InputError("at", "is too far outside the map", "give metres, in its frame");
  const VoxelId id = esdf.layout.find(voxel_at(local, esdf.voxel_size));
  return {{"clearance", FreeSpace(esdf).distance(local)},
          {"voxel", kStates[id == kNoVoxel ? 0 : static_cast<int>(esdf.state[id])]}};
}

Reply MapAnswers::answer(const Question& question) {
  const std::string& path = question.path;
  try {
    require_known_parameters(question);
    if (path == "/api/info") return kept(info_, kJson, [&] { return info(); });
    if (path == "/api/surface")
      return kept(surface_, kBytes, [&] { return surface_layer(roadmap_.esdf, kMostQuads); });
    if (path == "/api/surface/coarse")
      return kept(coarse_surface_, kBytes,
                  [&] { return surface_layer(roadmap_.esdf, kMostCoarseQuads); });
    if (path == "/api/diagram")
      return kept(diagram_, kBytes, [&] { return diagram_layer(roadmap_); });
    if (path == "/api/graph") return kept(graph_, kBytes, [&] { return graph_layer(roadmap_); });
    if (path == "/api/components") return components_of(get(question, "of"));
    if (path == "/api/gvd")
      return kept(gvd_, kBytes, [&] {
        return gvd_layer(roadmap_, gvd_of_record(roadmap_.config), kMostGvdPoints);
      });
    if (path == "/api/narrow") return kept(narrow_, kJson, [&] { return narrow_places(); });
    if (path == "/api/slice")
      return {200, kBytes,
              std::make_shared<const std::string>(
                  slice_layer(roadmap_.esdf, parse_number(get(question, "z"), {-1e9, 1e9}, "z"),
                              kMostSliceSamples))};
    if (path == "/api/section")
      return {200, kBytes,
              std::make_shared<const std::string>(
                  section_layer(roadmap_.esdf, parse_number(get(question, "z"), {-1e9, 1e9}, "z"),
                                kMostSectionCells))};
    if (path == "/api/plan") return json_reply(200, plan(question));
    if (path == "/api/trajectory") return json_reply(200, trajectory(question));
    if (path == "/api/place") return json_reply(200, place(question));
    return json_reply(404,
                      {{"error", "there is nothing here (docs/viewer.md lists what there is)"}});
  } catch (const InputError& error) {
    return json_reply(400, {{"error", printable(error.what())}});
  } catch (const std::bad_alloc&) {
    return json_reply(503, {{"error", "needs more memory than there is"}});
  } catch (const std::exception& error) {
    return json_reply(500, {{"error", printable(error.what())}});
  }
}

}  // namespace ridgeway::cli
