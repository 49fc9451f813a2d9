// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "files/temporary.hpp"
#include "formats/build_record.hpp"
#include "growing_recording.hpp"
#include "json.hpp"
#include "recording.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "view/follow.hpp"

namespace ridgeway::cli {
namespace {

struct LiveOptions {
  std::string folder, output, csv;
  std::string unknown = "obstacle";
  int verify = 0;
  double follow = 0.0;  // seconds
  std::string until;
  LiveConfig live;
  FollowOptions follow_by_page;
};

struct Replay {
  std::vector<UpdateReport> updates;
  std::size_t unreadable = 0, without_pose = 0;
  std::size_t verified = 0;
  std::vector<double> batch_seconds;  // of the builds that verified
  Stopwatch watch;
};

/// Whether two roadmaps have the same file, made beside the output.
bool have_same_file(const Roadmap& a, const Roadmap& b, const std::string& output) {
  const Temporary folder(output, Temporary::Kind::kFolder);
  if (folder.error() != 0)
    throw InputError(output, "has no room for files beside it", "give another folder");
  save_roadmap(a, folder.path() / "live.ridge");
  save_roadmap(b, folder.path() / "batch.ridge");
  return read_file(folder.path() / "live.ridge") == read_file(folder.path() / "batch.ridge");
}

/// Builds the map in batch; throws where that gives another roadmap.
void verify_by_batch(LiveRoadmap& live, const LiveOptions& options, const std::string& frame,
                     Replay& replay) {
  const std::shared_ptr<const Roadmap> snapshot = live.settled();
  if (!snapshot) return;
  const Stopwatch watch;
  BuildResult batch = build_roadmap(live.map(), options.live.build);
  batch.roadmap.source = options.live.source;
  batch.roadmap.config = options.live.record;
  replay.batch_seconds.push_back(watch.seconds());
  ++replay.verified;
  if (!have_same_file(*snapshot, batch.roadmap, options.output))
    throw std::logic_error("after " + frame + " a batch build gives another roadmap");
}

/// Where a sensor is that looks along an axis of its own.
LiveScene scene_at(const Eigen::Isometry3d& T_world_sensor, const Eigen::Vector3d& looks_along) {
  const Eigen::Vector3d towards = T_world_sensor.linear() * looks_along;
  return {.position = T_world_sensor.translation(), .yaw = std::atan2(towards.y(), towards.x())};
}

/// Runs one update, and shows what it has made; complaints name the file.
template <typename Update>
void replay_frame(LiveRoadmap& live, const LiveOptions& options, const std::filesystem::path& frame,
                  Replay& replay, FollowedRun& followed, LiveScene scene, const Update& update) {
  try {
    replay.updates.push_back(update());
  } catch (const InputError& error) {
    throw error.within(frame.string());
  }
  scene.roadmap = live.snapshot();
  scene.scan = replay.updates.size();
  scene.seconds = replay.watch.seconds();
  followed.show(std::move(scene));
  if (options.verify > 0 && replay.updates.size() % static_cast<std::size_t>(options.verify) == 0)
    verify_by_batch(live, options, frame.string(), replay);
}

void replay_images(const LiveOptions& options, const Globals& globals, LiveRoadmap& live,
                   Replay& replay, FollowedRun& followed) {
  DepthSequence sequence;
  std::vector<DepthFrame> next;
  GrowingRecording frames(options.folder, options.follow, options.until);
  ProgressBar bar(globals);
  while (frames.find(sequence, next, bar)) {
    replay.without_pose = sequence.without_pose;
    for (const DepthFrame& frame : next) {
      frames.done(frame);
      bar.show("live", static_cast<double>(replay.updates.size()) /
                           static_cast<double>(sequence.frames.size()));
      const std::optional<DepthImage> image = read_when_whole(sequence, frame, options.follow);
      if (image) {
        LiveScene scene = scene_at(frame.T_world_camera, Eigen::Vector3d::UnitZ());
        if (options.follow == 0.0) scene.scans = sequence.frames.size();
        replay_frame(live, options, frame.image, replay, followed, std::move(scene),
                     [&] { return live.integrate(*image, sequence.camera, frame.T_world_camera); });
      }
      replay.unreadable += !image;
      if (frames.is_last(frame)) return;
    }
    if (options.follow == 0.0) return;
  }
}

void replay_scans(const LiveOptions& options, const Globals& globals, LiveRoadmap& live,
                  Replay& replay, FollowedRun& followed) {
  const ScanSequence sequence = open_scans(options.folder);
  replay.without_pose = sequence.without_pose;
  ProgressBar bar(globals);
  for (const Scan& scan : sequence.scans) {
    bar.show("live", static_cast<double>(replay.updates.size()) /
                         static_cast<double>(sequence.scans.size()));
    const PointCloud cloud = read_scan(scan);
    LiveScene scene = scene_at(scan.T_world_sensor, Eigen::Vector3d::UnitX());
    scene.scans = sequence.scans.size();
    replay_frame(live, options, scan.cloud, replay, followed, std::move(scene),
                 [&] { return live.integrate(cloud.points, scan.T_world_sensor); });
  }
}

struct Column {
  const char* name;
  double (*value)(const UpdateReport&);
};
constexpr Column kColumns[] = {
    {"changed_voxels", [](const UpdateReport& r) { return static_cast<double>(r.changed_voxels); }},
    {"changed_distances",
     [](const UpdateReport& r) { return static_cast<double>(r.changed_distances); }},
    {"in_batch", [](const UpdateReport& r) { return static_cast<double>(r.in_batch); }},
    {"fusion_ms", [](const UpdateReport& r) { return 1e3 * r.fusion_seconds; }},
    {"map_ms", [](const UpdateReport& r) { return 1e3 * r.map_seconds; }},
    {"field_ms", [](const UpdateReport& r) { return 1e3 * r.build.seconds.esdf; }},
    {"ridges_ms",
     [](const UpdateReport& r) {
       return 1e3 * (r.build.seconds.gvd + r.build.seconds.edges + r.build.seconds.thin);
     }},
    {"copy_ms", [](const UpdateReport& r) { return 1e3 * r.copy_seconds; }},
    {"kernel_ms", [](const UpdateReport& r) { return 1e3 * r.build.seconds.kernel; }},
    {"graph_ms", [](const UpdateReport& r) { return 1e3 * r.build.seconds.graph; }},
    {"attach_ms", [](const UpdateReport& r) { return 1e3 * r.build.seconds.attach; }},
    {"waiting_voxels", [](const UpdateReport& r) { return static_cast<double>(r.waiting_voxels); }},
    {"total_ms", [](const UpdateReport& r) { return 1e3 * r.seconds; }}};

std::string csv_of(const Replay& replay) {
  std::string text = "frame";
  for (const Column& column : kColumns) text.append(",").append(column.name);
  for (std::size_t i = 0; i < replay.updates.size(); ++i) {
    text.append("\n").append(std::to_string(i + 1));
    for (const Column& column : kColumns)
      text.append(",").append(nlohmann::json(column.value(replay.updates[i])).dump());
  }
  return text.append("\n");
}

Spread spread_of_column(const Replay& replay, const Column& column) {
  std::vector<double> values;
  for (const UpdateReport& update : replay.updates) values.push_back(column.value(update));
  return spread_of(std::move(values));
}

void print(const LiveOptions& options, const Replay& replay, const Roadmap& roadmap,
           const Globals& globals) {
  if (globals.json) {
    nlohmann::ordered_json json = {{"file", options.output},
                                   {"frames", replay.updates.size()},
                                   {"unreadable", replay.unreadable},
                                   {"without_pose", replay.without_pose},
                                   {"verified", replay.verified},
                                   {"vertices", roadmap.graph.vertices.size()},
                                   {"edges", roadmap.graph.edges.size()}};
    for (const Column& column : kColumns) {
      const Spread spread = spread_of_column(replay, column);
      json[column.name] = {{"median", spread.median}, {"p99", spread.p99}, {"max", spread.max}};
    }
    if (replay.verified > 0)
      json["batch_ms"] = {{"median", 1e3 * spread_of(replay.batch_seconds).median}};
    print_json(json);
    return;
  }
  const Spread total = spread_of_column(replay, kColumns[std::size(kColumns) - 1]);
  print_row("frames", count_text(replay.updates.size()));
  print_row("graph", count_text(roadmap.graph.vertices.size()) + " vertices, " +
                         count_text(roadmap.graph.edges.size()) + " edges");
  print_row("time", seconds_text(1e-3 * total.median) + " from scan to roadmap, at most " +
                        seconds_text(1e-3 * total.max));
  if (replay.verified > 0)
    print_row("verified", count_text(replay.verified) + " snapshots, a batch build of them takes " +
                              seconds_text(spread_of(replay.batch_seconds).median));
  print_row("file", options.output);
}

int run(const LiveOptions& options, const Globals& globals) {
  const RecordingKind kind =
      options.follow > 0.0 ? RecordingKind::kImages : kind_of_recording(options.folder);
  LiveConfig config = options.live;
  if (options.unknown == "ignore") config.build.unknown = UnknownPolicy::kIgnore;
  if (kind == RecordingKind::kScans) config.fusion.integrator = Integrator::kRayCasting;
  require_outside(options.output, options.folder);
  require_writable({options.output}, {});
  require_extension(options.output, "a roadmap", {".ridge"});
  config.source = (std::filesystem::path(options.folder) / "").parent_path().filename().string();
  config.record = build_record(config.build, config.fusion.voxel_size).dump();
  LiveOptions all = options;
  all.live = config;
  LiveRoadmap live(config);
  FollowedRun followed(options.follow_by_page, options.output, globals);
  Replay replay;
  if (kind == RecordingKind::kScans)
    replay_scans(all, globals, live, replay, followed);
  else
    replay_images(all, globals, live, replay, followed);
  if (std::isfinite(config.window)) live.catch_up();
  const std::shared_ptr<const Roadmap> snapshot = live.settled();
  if (!snapshot)
    throw InputError(options.folder, "shows no place that the robot fits",
                     "give a smaller --min-clearance, or --unknown ignore");
  if (replay.unreadable > 0)
    warn(globals, count_text(replay.unreadable) + " images could not be read and were passed over");
  save_roadmap(*snapshot, options.output);
  if (!options.csv.empty()) write_text_file(options.csv, csv_of(replay));
  print(options, replay, *snapshot, globals);
  followed.show_last(snapshot);
  followed.stay();
  return kExitDone;
}

}  // namespace

void add_live_command(Command& program) {
  const auto options = std::make_shared<LiveOptions>();
  FusionConfig& fusion = options->live.fusion;
  BuildConfig& build = options->live.build;
  Command command =
      program.add("live", "Replay a recording into a roadmap that follows it, scan by scan");
  command.path("folder", options->folder, "Recording, as `ridgeway fuse` takes it").required();
  command.path("-o,--output", options->output, "Last roadmap to write, .ridge").required();
  command.number("--voxel-size", fusion.voxel_size, kLengths, "Metres");
  command.number("--min-range", fusion.min_range, kLengthsFromZero,
                 "Nothing nearer is taken, metres");
  command.number("--max-range", fusion.max_range, kReaches, "Nothing farther is taken, metres");
  command.number("--clear-radius", fusion.clear_radius, kLengthsFromZero,
                 "Space this near to where the sensor was is free, metres");
  command.whole("--forget-after", fusion.forget_after, {0, 255},
                "Measurements in a row that contradict a voxel before it is forgotten; 0: never");
  command.number("--min-clearance", build.min_clearance, kLengths,
                 "Smallest robot radius that the roadmap is for, metres");
  command.number("--max-distance", build.max_distance, kReaches,
                 "Distances to obstacles are known up to here, metres");
  command.choice("--unknown", options->unknown, {"obstacle", "ignore"},
                 "Unknown space is an obstacle, or is kept out of without a distance to it (then "
                 "every scan builds anew)");
  command.number("--window", options->live.window, kReaches,
                 "What lies farther from the sensor along any axis follows when it comes nearer, "
                 "and in the end, metres");
  command.number("--follow", options->follow, {0.0, 1e6},
                 "The folder is still written to: wait so long for the next image, seconds");
  command.path("--until", options->until, "Stop after the image of this name");
  command.whole("--verify", options->verify, {0, 1'000'000},
                "Build in batch after every so many scans and compare the bytes; 0: never");
  command.path("--csv", options->csv, "Table to write, a row a scan");
  add_follow_options(command, options->follow_by_page);
  command.footer(
      "Examples:\n"
      "  ridgeway live data/house_depth -o house.ridge --min-clearance 0.3 --max-distance 4\n"
      "  ridgeway live data/house_depth -o house.ridge --view --open");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
