// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "experiments/exploration_flight.hpp"
#include "explore_options.hpp"
#include "files/atomic_file.hpp"
#include "json.hpp"
#include "recording.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/pictures/picture.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "view/follow.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ExploreOptions {
  std::string world, output, flight, volume, picture, record;
  std::optional<Point> start;
  std::optional<double> budget;
  double yaw = 0.0;  // degrees
  ExploreSettings settings;
  FollowOptions follow;
};

std::string number(double value) { return Json(value).dump(); }

std::string flight_csv(const ExplorationFlight& flight) {
  std::string text = "t,x,y,z,vx,vy,vz,yaw\n";
  for (const ExplorationSample& sample : flight.samples) {
    const FlightState& s = sample.state;
    text += number(s.time);
    for (const double value : {s.position.x(), s.position.y(), s.position.z(), s.velocity.x(),
                               s.velocity.y(), s.velocity.z(), s.yaw})
      text.append(",").append(number(value));
    text += "\n";
  }
  return text;
}

std::string volume_csv(const ExplorationFlight& flight) {
  std::string text = "t,mapped_volume,mapped_share,frontiers\n";
  for (const ExplorationSample& sample : flight.samples)
    text.append(number(sample.state.time))
        .append(",")
        .append(number(sample.mapped * flight.viewable_volume))
        .append(",")
        .append(number(sample.mapped))
        .append(",")
        .append(std::to_string(sample.frontiers))
        .append("\n");
  return text;
}

void draw(const ExplorationFlight& flight, const std::string& title, const std::string& out) {
  PictureConfig picture;
  picture.title = title;
  picture.diagram = false;
  picture.path_label = "flight";
  Chart mapped{"mapped (m\u00b3)", {}, {}, flight.viewable_volume, "all that can be seen"};
  Chart frontiers{"frontiers", {}, {}, std::nullopt, {}};
  for (const ExplorationSample& sample : flight.samples) {
    mapped.times.push_back(sample.state.time);
    mapped.values.push_back(sample.mapped * flight.viewable_volume);
    frontiers.times.push_back(sample.state.time);
    frontiers.values.push_back(static_cast<double>(sample.frontiers));
  }
  if (flight.samples.size() > 1) picture.charts = {mapped, frontiers};
  draw_floor_plan(*flight.roadmap, flight.path, out, picture);
}

Json json_of_unseen(const ExplorationFlight& flight) {
  Json list = Json::array();
  for (const UnseenFrontier& frontier : flight.unseen) {
    Json entry = {{"place", json_of(frontier.centroid)},
                  {"voxels", frontier.voxels},
                  {"reason", name_of(frontier.reason)}};
    if (frontier.door) {
      entry["door"] = json_of(*frontier.door);
      entry["door_radius"] = frontier.door_radius;
    }
    list.push_back(entry);
  }
  return list;
}

Spread milliseconds_of(const ExplorationFlight& flight) {
  std::vector<double> milliseconds;
  for (const ExplorationSample& sample : flight.samples)
    milliseconds.push_back(1e3 * sample.seconds.total);
  return spread_of(std::move(milliseconds));
}

std::string end_text(const ExplorationFlight& flight) {
  if (flight.is_complete) return "complete: no viewpoint sees a frontier";
  std::string text(flight.end_name());
  if (flight.end == ExplorationStatus::kStuck)
    text += ": no way that is known to be free leads on, or home";
  return text;
}

/// What a reader of the figures alone could miss.
void warn_of(const ExplorationFlight& flight, const Globals& globals) {
  constexpr double kLittle = 0.5;
  if (flight.collisions > 0)
    warn(globals, "the drone came nearer than its radius to the exact world at " +
                      count_text(flight.collisions) + " places of its flight");
  if (flight.is_complete && flight.coverage < kLittle)
    warn(globals, "only " + text_of(100.0 * flight.coverage, 2) +
                      " % of what could be seen is mapped: the drone sees no more from where its "
                      "map lets it go (a longer --max-range, a smaller --margin or --spacing?)");
}

void print(const ExplorationFlight& flight, const std::string& output, const Globals& globals) {
  const Spread decisions = milliseconds_of(flight);
  if (globals.json) {
    print_json({{"file", output},
                {"end", std::string(flight.end_name())},
                {"complete", flight.is_complete},
                {"coverage", flight.coverage},
                {"viewable_volume", flight.viewable_volume},
                {"collisions", flight.collisions},
                {"nearest", flight.nearest},
                {"flight_seconds", flight.seconds},
                {"flight_length", flight.length},
                {"scans", flight.samples.size()},
                {"trajectories", flight.trajectories},
                {"stops", flight.stops},
                {"decision_milliseconds", {{"median", decisions.median}, {"p95", decisions.p95}}},
                {"unseen", json_of_unseen(flight)}});
    return;
  }
  print_row("end", end_text(flight));
  print_row("mapped", text_of(100.0 * flight.coverage, 2) + " % of " +
                          text_of(flight.viewable_volume, 1) + " cubic metres that can be seen");
  print_row("flight", text_of(flight.seconds, 1) + " s, " + text_of(flight.length, 1) + " m, " +
                          count_text(flight.samples.size()) + " scans");
  print_row("nearest", text_of(rounded_down(flight.nearest)) +
                           " m beyond its radius, collisions: " + count_text(flight.collisions));
  print_row("decision", seconds_text(1e-3 * decisions.median) + ", 95% within " +
                            seconds_text(1e-3 * decisions.p95));
  for (const UnseenFrontier& frontier : flight.unseen)
    print_row("unseen", count_text(frontier.voxels) + " voxels at " +
                            point_text(frontier.centroid) + ": " +
                            std::string(name_of(frontier.reason)) +
                            (frontier.door ? ", the way there has room for a radius of " +
                                                 text_of(frontier.door_radius) + " m, not for " +
                                                 text_of(flight.roadmap->min_clearance) +
                                                 " m, at " + point_text(*frontier.door)
                                           : ""));
  print_row("file", output);
}

LiveScene scene_of(const ExplorationMoment& moment) {
  const FlightState& state = moment.sample.state;
  return {.roadmap = moment.roadmap,
          .position = state.position,
          .yaw = state.yaw,
          .ahead = moment.ahead,
          .scan = moment.scan,
          .seconds = state.time};
}

int run(const ExploreOptions& options, const Globals& globals) {
  ExplorationFlightConfig config = options.settings.flight();
  config.start = *options.start;
  config.start_yaw = options.yaw * std::numbers::pi / 180.0;
  if (options.budget) config.budget = *options.budget;
  std::vector<std::filesystem::path> outputs = {options.output};
  for (const std::string& file : {options.flight, options.volume, options.picture})
    if (!file.empty()) outputs.emplace_back(file);
  require_writable(outputs, {options.world});
  if (!options.record.empty()) require_outside(options.record, outputs);
  require_extension(options.output, "a roadmap", {".ridge"});
  if (!options.picture.empty()) require_extension(options.picture, "a picture", {".png", ".svg"});
  for (const std::string& file : {options.flight, options.volume})
    if (!file.empty()) require_extension(file, "a table", {".csv"});
  if (!options.record.empty() && !config.lidar) require_recordable(config.sensor);
  const World world = load_world(options.world);
  config.validate();
  FollowedRun followed(options.follow, options.output, globals);
  std::optional<SequenceWriter> images;
  std::optional<ScanWriter> scans;
  if (!options.record.empty() && config.lidar) scans.emplace(options.record);
  if (!options.record.empty() && !config.lidar)
    images.emplace(options.record, config.sensor.camera, config.scan_rate);
  ProgressBar bar(globals);
  const ExplorationFlight flight = explore(
      world, config, bar.callback(),
      [&](const DepthImage& image, const Eigen::Isometry3d& T_world_camera) {
        if (images) images->add(image, T_world_camera);
      },
      followed.is_followed()
          ? [&](const ExplorationMoment& moment) { followed.show(scene_of(moment)); }
          : OnMoment{},
      [&](std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor) {
        if (scans) scans->add(points, T_world_sensor);
      });
  bar.clear();
  if (!flight.roadmap)
    throw InputError(options.world, "shows no place that the drone fits",
                     "give a smaller --radius or --voxel-size");
  save_roadmap(*flight.roadmap, options.output);
  if (images) images->finish();
  if (scans) scans->finish();
  if (!options.flight.empty()) write_text_file(options.flight, flight_csv(flight));
  if (!options.volume.empty()) write_text_file(options.volume, volume_csv(flight));
  if (!options.picture.empty()) draw(flight, world.name, options.picture);
  print(flight, options.output, globals);
  warn_of(flight, globals);
  followed.show_last(flight.roadmap);
  followed.stay();
  return kExitDone;
}

}  // namespace

void add_explore_command(Command& program) {
  const auto options = std::make_shared<ExploreOptions>();
  Command command = program.add(
      "explore", "Let a simulated drone map a world by itself, into a roadmap that follows");
  command.path("world", options->world, "World, .yaml").required();
  command.path("-o,--output", options->output, "Roadmap to write, .ridge").required();
  command.point("--start", options->start, "Where the drone is at first, x,y,z").required();
  command.number("--yaw", options->yaw, kDegrees, "Where it looks at first, degrees");
  command.number("--budget", options->budget, kTimeLimits,
                 "Seconds after which it has to be back; else it flies until all is seen");
  add_explore_settings(command, options->settings);
  command.seed(options->settings.config.seed, "Of the sensor's noise");
  command.path("--flight", options->flight, "Where the drone was at each scan, .csv");
  command.path("--volume", options->volume, "Mapped volume over time, .csv");
  command.path("--picture", options->picture,
               "Map, flight and graph from above, and mapped volume over time, .png or .svg");
  command.path(
      "--record", options->record,
      "Folder, new or empty, for images or scans and their poses, as `ridgeway live` takes it");
  add_follow_options(command, options->follow);
  command.footer(
      "Example:\n"
      "  ridgeway explore worlds/house.yaml -o house.ridge --start 1.2,1.2,1.5 --picture "
      "house.png");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
