// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "formats/build_record.hpp"
#include "json.hpp"
#include "limit_options.hpp"
#include "option_names.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "source_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct BuildOptions {
  std::string map, output;
  std::optional<double> voxel_size;
  std::string unknown = "obstacle", edges = "neighbours", diagram = "full", graph = "simple";
  std::optional<Box> bounds;
  std::vector<Box> exclude;
  std::optional<Transform> transform;
  std::string units, up;
  std::optional<double> metres_a_unit;
  std::vector<Point> inside;
  std::vector<double> planar;
  int isolated = 0;
  int repeat = 1;
  LimitOptions limits;
  BuildConfig build;
};

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

LoadConfig load_config(const BuildOptions& options) {
  LoadConfig config;
  config.voxel_size = options.voxel_size;
  config.bounds = options.bounds;
  config.exclude = options.exclude;
  if (options.transform) config.transform = options.transform->value;
  config.units = options.metres_a_unit;
  for (const Unit& unit : kUnits)
    if (options.units == unit.name) config.units = unit.metres;
  if (!options.up.empty())
    config.up = options.up == "x" ? UpAxis::kX : options.up == "y" ? UpAxis::kY : UpAxis::kZ;
  config.inside = options.inside;
  config.isolated_below = options.isolated;
  config.validate();
  return config;
}

BuildConfig build_config(const BuildOptions& options) {
  BuildConfig config = options.build;
  if (options.unknown == "ignore") config.unknown = UnknownPolicy::kIgnore;
  if (options.unknown == "free") config.unknown = UnknownPolicy::kFree;
  config.limits = limits_of(options.limits);
  // Unknown space that is free goes on to the ends of the blocks, beyond what was cut off.
  if (options.bounds && config.unknown == UnknownPolicy::kFree)
    config.limits = both_of(config.limits, {.keep_in = *options.bounds, .keep_out = {}});
  config.basis_point_edges = options.edges == "basis-points";
  config.paper_diagram = options.diagram == "paper";
  config.simplify = options.graph == "simple";
  config.validate();
  return config;
}

/// Everything that shapes the roadmap, as it is kept in the file.
std::string config_text(const BuildOptions& options, const BuildConfig& build, double voxel_size) {
  Json json = build_record(build, voxel_size);
  if (options.bounds) json["bounds"] = box_text(*options.bounds);
  for (const Box& box : options.exclude) json["exclude"].push_back(box_text(box));
  if (!options.planar.empty()) json["planar"] = options.planar;
  if (const auto units = load_config(options).units) json["units"] = *units;
  if (!options.up.empty()) json["up"] = options.up;
  for (const Point& place : options.inside) json["inside"].push_back(cli::json_of(place));
  if (options.transform) json["transform"] = options.transform->text;
  if (options.isolated > 0) json["isolated"] = options.isolated;
  return json.dump();
}

struct Stage {
  const char* name;
  double BuildSeconds::*seconds;
};
constexpr Stage kStages[] = {
    {"esdf", &BuildSeconds::esdf},     {"gvd", &BuildSeconds::gvd},
    {"edges", &BuildSeconds::edges},   {"thin", &BuildSeconds::thin},
    {"kernel", &BuildSeconds::kernel}, {"graph", &BuildSeconds::graph},
    {"attach", &BuildSeconds::attach}, {"tangents", &BuildSeconds::tangents},
    {"total", &BuildSeconds::total}};

/// Builds `repeat` times; the times of the stages are then medians.
BuildResult build_repeatedly(OccupancyMap map, const BuildConfig& config, int repeat,
                             const Progress& progress) {
  std::vector<BuildSeconds> runs;
  for (int i = 1; i < repeat; ++i)
    runs.push_back(build_roadmap(map, config, progress).report.seconds);
  BuildResult result = build_roadmap(std::move(map), config, progress);
  if (runs.empty()) return result;
  runs.push_back(result.report.seconds);
  for (const Stage& stage : kStages) {
    const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
    std::nth_element(runs.begin(), middle, runs.end(), [&](const auto& a, const auto& b) {
      return a.*stage.seconds < b.*stage.seconds;
    });
    result.report.seconds.*stage.seconds = (*middle).*stage.seconds;
  }
  return result;
}

struct Outcome {
  BuildResult built;
  double load_seconds = 0.0, save_seconds = 0.0;
  std::uint64_t file_bytes = 0;
  double total_seconds() const { return load_seconds + built.report.seconds.total + save_seconds; }
};

Json json_of(const BuildOptions& options, const Outcome& outcome) {
  const Roadmap& roadmap = outcome.built.roadmap;
  const BuildReport& report = outcome.built.report;
  Json seconds = {{"load", outcome.load_seconds}};
  for (const Stage& stage : kStages) seconds[stage.name] = report.seconds.*stage.seconds;
  seconds.erase("total");
  seconds["save"] = outcome.save_seconds;
  seconds["total"] = outcome.total_seconds();
  return {{"map", options.map},
          {"output", options.output},
          {"voxel_size", roadmap.esdf.voxel_size},
          {"unknown_policy", options.unknown},
          {"voxels",
           {{"free", report.voxels.free},
            {"occupied", report.voxels.occupied},
            {"unknown", report.voxels.unknown}}},
          {"allocated_voxels", report.allocated_voxels},
          {"traversable",
           {{"voxels", report.traversable_voxels}, {"components", report.traversable_components}}},
          {"gvd_voxels", report.gvd_voxels},
          {"edge_voxels", report.edge_voxels},
          {"kernel_voxels", report.kernel_voxels},
          {"diagram_voxels", report.diagram_voxels},
          {"graph",
           {{"vertices", roadmap.graph.vertices.size()},
            {"edges", roadmap.graph.edges.size()},
            {"components", report.graph_components},
            {"min_clearance", roadmap.graph.min_clearance}}},
          {"seconds", seconds},
          {"repeat", options.repeat},
          {"file_bytes", outcome.file_bytes},
          {"peak_memory_bytes", peak_memory_bytes()}};
}

void print_summary(const BuildOptions& options, const Outcome& outcome) {
  const Roadmap& roadmap = outcome.built.roadmap;
  const BuildReport& report = outcome.built.report;
  print_row("voxel size", text_of(roadmap.esdf.voxel_size, 6) + " m");
  print_row("voxels", count_text(report.voxels.free) + " free, " +
                          count_text(report.voxels.occupied) + " occupied");
  print_row("traversable", count_text(report.traversable_voxels) + " voxels at a radius of " +
                               text_of(roadmap.min_clearance) + " m, in " +
                               count_text(report.traversable_components) + " components");
  print_row("diagram", count_text(report.diagram_voxels) + " voxels");
  print_row("graph", count_text(roadmap.graph.vertices.size()) + " vertices, " +
                         count_text(roadmap.graph.edges.size()) + " edges, " +
                         count_text(report.graph_components) + " components");
  std::string stages = "load " + seconds_text(outcome.load_seconds);
  for (const Stage& stage : kStages)
    if (stage.seconds != &BuildSeconds::total)
      stages += std::string(", ") + stage.name + " " + seconds_text(report.seconds.*stage.seconds);
  stages += ", save " + seconds_text(outcome.save_seconds);
  print_row("time", seconds_text(outcome.total_seconds()));
  print_row("", stages);
  print_row("memory", bytes_text(peak_memory_bytes()) + " at the peak");
  print_row("file", options.output + ", " + bytes_text(outcome.file_bytes));
}

int run(const BuildOptions& options, const Globals& globals) {
  const LoadConfig loading = load_config(options);
  const BuildConfig building = build_config(options);
  if (std::error_code error;
      is_roadmap_file(options.map) && std::filesystem::exists(options.map, error))
    throw InputError(options.map, "is a roadmap already",
                     "give the map that it was built from, or plan on it");
  require_writable({options.output}, {options.map});
  require_extension(options.output, "a roadmap", {".ridge"});

  Outcome outcome;
  ProgressBar bar(globals);
  bar.show("load", 0.0);
  LoadNotes notes;
  const Stopwatch load_watch;
  OccupancyMap map = load_map(options.map, loading, &notes);
  outcome.load_seconds = load_watch.seconds();
  bar.clear();
  for (const std::string& text : notes.notes) note(globals, with_option_names(text));
  if (!options.planar.empty() && map.planar)
    throw InputError("--planar",
                     "is of maps in three dimensions, and " + options.map + " is planar",
                     "leave it out");
  if (!options.planar.empty()) map = flatten(map, options.planar[0], options.planar[1]);
  if (building.min_clearance < 2.0 * map.voxel_size)
    warn(globals,
         "--min-clearance " + text_of(building.min_clearance) + " m is less than two voxels of " +
             text_of(map.voxel_size, 6) +
             " m: whether narrow passages are open depends on how the walls fall on the voxels");
  const std::string config = config_text(options, building, map.voxel_size);

  outcome.built = build_repeatedly(std::move(map), building, options.repeat, bar.callback());
  Roadmap& roadmap = outcome.built.roadmap;
  roadmap.source = std::filesystem::path(options.map).filename().string();
  roadmap.config = config;
  bar.show("save", 1.0);
  const Stopwatch save_watch;
  save_roadmap(roadmap, options.output);
  outcome.save_seconds = save_watch.seconds();
  outcome.file_bytes = std::filesystem::file_size(options.output);
  bar.clear();

  if (globals.json)
    print_json(json_of(options, outcome));
  else
    print_summary(options, outcome);
  return kExitDone;
}

}  // namespace

void add_build_command(Command& program) {
  const auto options = std::make_shared<BuildOptions>();
  BuildConfig& build = options->build;
  Command command = program.add("build", "Build a roadmap from a map");
  command
      .path("map", options->map,
            "Map: OctoMap .bt, .ot; mesh .dae, .glb, .obj, .stl, .ply; point cloud .pcd, .ply, "
            ".xyz; voxblox .vxblx; ROS map or world .yaml; .3dmap; fused .ridge")
      .required();
  command.path("-o,--output", options->output, "Roadmap to write, .ridge").required();
  command.number("--voxel-size", options->voxel_size, kLengths,
                 "Metres; required for point clouds; 0.1 for meshes and worlds unless given; of "
                 ".3dmap the size of a cell; otherwise not finer than the map's own");
  command.number("--min-clearance", build.min_clearance, kLengths,
                 "Smallest robot radius that the roadmap is for, metres");
  command.number("--max-distance", build.max_distance, kReaches,
                 "Distances to obstacles are known up to here, metres; halls wider than twice that "
                 "get a dense graph");
  command.choice("--unknown", options->unknown, {"obstacle", "ignore", "free"},
                 "Unknown space is an obstacle, or is kept out of without a distance to it, or is "
                 "taken for free around what is known");
  command.number("--theta", build.theta, {0.0, std::numbers::pi},
                 "Least angle between the directions to two obstacles, radians");
  command.number(
      "--prune-radius", build.prune_radius, kLengthsFromZero,
      "Vertices nearer than this along the diagram become one, metres; at least two voxels");
  command.number("--split-deviation", build.split_deviation, kLengthsFromZero,
                 "Greatest distance of an edge from its diagram, metres; 0 for two voxels");
  command.number("--significance", build.significance, kLengthsFromZero,
                 "Dead ends of the graph whose ball reaches less far beyond others go, metres");
  command.choice("--edges", options->edges, {"neighbours", "basis-points"},
                 "What makes a ridge voxel an edge: 18 neighbours on the ridges, or three "
                 "obstacles in directions theta apart");
  command.choice("--diagram", options->diagram, {"full", "paper"},
                 "The full diagram, or the paper's thinned edges alone for comparison");
  command.choice("--graph", options->graph, {"simple", "fitted"},
                 "Without what noise and voxels put into it, or as fitted to the diagram");
  command.box("--bounds", options->bounds,
              "Flight volume x0,y0,z0,x1,y1,z1, metres; required for point clouds; the box around "
              "a mesh unless given");
  command.choice_or_number("--units", options->units, {"m", "cm", "mm", "in", "ft"},
                           options->metres_a_unit, kLengths,
                           "Unit of a mesh, or how many metres it is; unless given the file's own, "
                           "or metres");
  command.choice("--up", options->up, {"x", "y", "z"},
                 "Axis of a mesh that points up; unless given the file's own, or z");
  command.points("--inside", options->inside,
                 "Place X,Y,Z in the open space of a mesh, metres: what is reached from there is "
                 "free; may be repeated; unless given what is reached from the bounds is, or the "
                 "inside of a mesh that encloses more than that");
  command.boxes("--exclude", options->exclude,
                "No-fly box x0,y0,z0,x1,y1,z1, metres; may be repeated");
  add_limit_options(command, options->limits);
  command.tuple("--planar", options->planar, 2, "Z0,Z1",
                "For a robot in the plane: whatever is occupied between these heights, metres, is "
                "in its way; distances, ridges and paths are those of this one layer");
  command.transform("--transform", options->transform,
                    "From the file's frame to the map's (z up): x,y,z,roll,pitch,yaw in metres "
                    "and degrees, 16 numbers of a matrix row by row, camera (x right, y down, "
                    "z forward) or y-up");
  command.whole("--isolated", options->isolated, {0, 1'000'000'000},
                "Take clusters of fewer occupied voxels as free; removes thin obstacles too");
  command.whole("--repeat", options->repeat, {1, 10'000},
                "Build this many times and report the medians of the times");
  command.footer(
      "Examples:\n"
      "  ridgeway build data/fr_079.bt -o office.ridge --min-clearance 0.3\n"
      "  ridgeway build mine.pcd -o mine.ridge --voxel-size 0.2 --bounds -50,-20,0,80,40,12");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
