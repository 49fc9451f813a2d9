// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "experiments/live_queries.hpp"
#include "files/atomic_file.hpp"
#include "formats/build_record.hpp"
#include "growing_recording.hpp"
#include "json.hpp"
#include "limit_options.hpp"
#include "live_report.hpp"
#include "recording.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "view/follow.hpp"

namespace ridgeway::cli {
namespace {

struct LiveOptions {
  std::string folder, output, csv;
  std::string unknown = "obstacle";
  LimitOptions limits;
  int verify = 0;
  std::size_t queries = 0;
  bool realtime = false;
  double follow = 0.0;  // seconds
  std::string until;
  LiveConfig live;
  FollowOptions follow_by_page;
};

/// Keeps a replay to the recording's own clock.
class Pace {
 public:
  explicit Pace(bool keeps) : keeps_(keeps) {}

  /// Waits until a time of the recording's clock, seconds. `bar`: asked meanwhile whether the user
  /// still does.
  void wait_until(double time, ProgressBar& bar, LiveReplay& replay) {
    if (!keeps_) return;
    if (!first_) first_ = time;
    const double due = time - *first_;
    for (double left = 0.0; (left = due - replay.watch.seconds()) > 0.0;) {
      bar.show("wait", 0.0);
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, 0.05)));
    }
    replay.behind = std::max(replay.behind, replay.watch.seconds() - due);
  }

 private:
  const bool keeps_;
  std::optional<double> first_;
};

constexpr double kImagesASecond = 30.0, kScansASecond = 10.0;  // of recordings without times

/// What every frame needs.
struct Run {
  const LiveOptions& options;
  LiveRoadmap live;
  FollowedRun followed;
  LiveReplay replay;
  LiveQueryLoad load;
  Pace pace;

  Run(const LiveOptions& given, const Globals& globals)
      : options(given),
        live(given.live),
        followed(given.follow_by_page, given.output, globals),
        load(live, 0, 1, replay.queries),
        pace(given.realtime) {}
};

/// Where a sensor is that looks along an axis of its own.
LiveScene scene_at(const Eigen::Isometry3d& T_world_sensor, const Eigen::Vector3d& looks_along) {
  const Eigen::Vector3d towards = T_world_sensor.linear() * looks_along;
  return {.position = T_world_sensor.translation(), .yaw = std::atan2(towards.y(), towards.x())};
}

/// Runs one update, and shows what it has made; complaints name the file. `scans`: of the whole
/// recording; 0 where that is not known.
template <typename Update>
void replay_frame(Run& run, const std::filesystem::path& frame, std::size_t scans, LiveScene scene,
                  const Update& update) {
  LiveReplay& replay = run.replay;
  try {
    replay.updates.push_back(update());
  } catch (const InputError& error) {
    throw error.within(frame.string());
  }
  const std::size_t done = replay.updates.size();
  // As many of all as of the scans.
  run.load.allow(scans == 0 ? run.options.queries : run.options.queries * done / scans);
  scene.roadmap = run.live.snapshot();
  if (scans > 0) scene.scans = scans;
  scene.scan = done;
  scene.seconds = replay.watch.seconds();
  run.followed.show(std::move(scene));
  if (run.options.verify > 0 && done % static_cast<std::size_t>(run.options.verify) == 0)
    verify_by_batch(run.live, run.options.live, run.options.output, frame.string(), run.replay);
}

double share_of(std::size_t done, std::size_t all) {
  return static_cast<double>(done) / static_cast<double>(all);
}

void replay_images(Run& run, const Globals& globals) {
  const LiveOptions& options = run.options;
  DepthSequence sequence;
  std::vector<DepthFrame> next;
  GrowingRecording frames(options.folder, options.follow, options.until);
  ProgressBar bar(globals);
  std::size_t place = 0;
  bool is_last = false;
  while (!is_last && frames.find(sequence, next, bar)) {
    run.replay.layout = sequence.layout;
    run.replay.without_pose = sequence.without_pose;
    for (const DepthFrame& frame : next) {
      frames.done(frame);
      run.pace.wait_until(frame.time.value_or(static_cast<double>(place++) / kImagesASecond), bar,
                          run.replay);
      bar.show("live", share_of(run.replay.updates.size(), sequence.frames.size()));
      std::string problem;
      const std::optional<DepthImage> image =
          read_when_whole(sequence, frame, options.follow, bar, problem);
      if (image)
        replay_frame(run, frame.image, options.follow == 0.0 ? sequence.frames.size() : 0,
                     scene_at(frame.T_world_camera, Eigen::Vector3d::UnitZ()), [&] {
                       return run.live.integrate(*image, sequence.camera, frame.T_world_camera);
                     });
      if (!image && run.replay.unreadable++ == 0) run.replay.first_unreadable = problem;
      is_last = frames.is_last(frame);
      if (is_last) break;
    }
    if (options.follow == 0.0) break;
  }
  bar.clear();
  if (!is_last && !frames.ending().empty())
    warn(globals, "what follows the last image was not taken: " + frames.ending());
  if (const std::size_t moved = frames.moved(sequence); moved > 0)
    warn(globals, std::to_string(moved) +
                      " images were taken before the last poses were there, "
                      "which are others: replay the recording without --follow");
  run.replay.upward_axis = told_of_upward_axis(sequence);
  note_assumed_camera(globals, sequence);
  if (!options.until.empty() && !is_last)
    warn(globals, "no image " + options.until + " has come, so all of them were taken");
}

void replay_scans(Run& run, const Globals& globals) {
  const ScanSequence sequence = open_scans(run.options.folder);
  run.replay.layout = sequence.layout;
  run.replay.without_pose = sequence.without_pose;
  PointCounts points;
  ProgressBar bar(globals);
  std::size_t place = 0;
  for (const Scan& scan : sequence.scans) {
    run.pace.wait_until(static_cast<double>(place++) / kScansASecond, bar, run.replay);
    bar.show("live", share_of(run.replay.updates.size(), sequence.scans.size()));
    const PointCloud cloud = read_scan(scan);
    replay_frame(run, scan.cloud, sequence.scans.size(),
                 scene_at(scan.T_world_sensor, Eigen::Vector3d::UnitX()),
                 [&] { return run.live.integrate(cloud.points, scan.T_world_sensor); });
    points.add(cloud, run.options.live.fusion);
  }
  bar.clear();
  note_points_without_surface(globals, points);
}

/// What was asked for, with what follows from the recording.
LiveOptions completed(const LiveOptions& options, RecordingKind kind) {
  LiveOptions all = options;
  LiveConfig& config = all.live;
  if (options.unknown == "ignore") config.build.unknown = UnknownPolicy::kIgnore;
  if (options.unknown == "free") config.build.unknown = UnknownPolicy::kFree;
  config.build.limits = limits_of(options.limits);
  if (kind == RecordingKind::kScans) config.fusion.integrator = Integrator::kRayCasting;
  config.source = (std::filesystem::path(options.folder) / "").parent_path().filename().string();
  config.record = build_record(config.build, config.fusion.voxel_size).dump();
  return all;
}

/// A folder that is followed need not be a recording yet.
RecordingKind kind_of(const LiveOptions& options) {
  const bool is_followed = options.follow > 0.0;
  if ((is_followed || !options.until.empty()) && holds_scans(options.folder) &&
      !holds_depth_images(options.folder))
    throw InputError(is_followed ? "--follow" : "--until",
                     "is for depth images, and " + options.folder + " holds scans", "leave it out");
  return is_followed ? RecordingKind::kImages : kind_of_recording(options.folder);
}

int run(const LiveOptions& given, const Globals& globals) {
  const RecordingKind kind = kind_of(given);
  std::vector<std::filesystem::path> outputs = {given.output};
  if (!given.csv.empty()) outputs.emplace_back(given.csv);
  for (const std::filesystem::path& output : outputs) require_outside(output, given.folder);
  require_writable(outputs, {});
  require_extension(given.output, "a roadmap", {".ridge"});
  if (!given.csv.empty()) require_extension(given.csv, "a table", {".csv"});
  const LiveOptions options = completed(given, kind);
  Run run(options, globals);
  if (kind == RecordingKind::kScans)
    replay_scans(run, globals);
  else
    replay_images(run, globals);
  if (std::isfinite(options.live.window)) run.live.catch_up();
  run.load.allow(options.queries);
  run.load.finish();
  const std::shared_ptr<const Roadmap> snapshot = run.live.settled();
  if (!snapshot)
    throw InputError(options.folder, "shows no place that the robot fits",
                     options.limits.any()
                         ? "give wider limits of the flight, or a smaller --min-clearance"
                         : "give a smaller --min-clearance, or --unknown ignore");
  const LiveReplay& replay = run.replay;
  warn_of_unreadable(globals, replay.unreadable, replay.first_unreadable);
  note_without_pose(globals, replay.without_pose, replay.layout);
  save_roadmap(*snapshot, options.output);
  if (!replay.upward_axis.empty()) note(globals, replay.upward_axis);
  if (!options.csv.empty()) write_text_file(options.csv, csv_of(replay));
  if (options.verify > 0 && replay.verified == 0)
    warn(globals,
         "nothing was verified (--verify), as " +
             (replay.updates.size() < static_cast<std::size_t>(options.verify)
                  ? "the recording has less than " + std::to_string(options.verify) + " frames"
                  : "there was no roadmap at any scan that was to be verified"));
  print(replay, *snapshot, options.output, globals);
  if (replay.identical != replay.verified)
    throw std::logic_error("after " + replay.first_other + " a batch build gives another roadmap");
  if (replay.queries.wrong > 0)
    throw std::logic_error("a path that was planned meanwhile is not free");
  run.followed.show_last(snapshot);
  run.followed.stay();
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
  command.number("--max-range", fusion.max_range, kLengths,
                 "What is farther only frees the way up to here, metres");
  command.number("--clear-radius", fusion.clear_radius, kLengthsFromZero,
                 "What was not measured this near to where the sensor was is free, metres");
  command.whole("--forget-after", fusion.forget_after, {0, 255},
                "Measurements in a row that contradict a voxel before it is forgotten; 0: never");
  command.number("--min-clearance", build.min_clearance, kLengths,
                 "Smallest robot radius that the roadmap is for, metres");
  command.number("--max-distance", build.max_distance, kReaches,
                 "Distances to obstacles are known up to here, metres");
  command.choice(
      "--unknown", options->unknown, {"obstacle", "ignore", "free"},
      "Unknown space is an obstacle, is kept out of without a distance to it, or is free "
      "(with the last two every scan builds anew)");
  add_limit_options(command, options->limits);
  command.number("--window", options->live.window, kReaches,
                 "What lies farther from the sensor along any axis follows when it comes nearer, "
                 "and in the end, metres");
  command.number("--follow", options->follow, {0.0, 1e6},
                 "The folder is still written to: wait so long for the next depth image, seconds");
  command.path("--until", options->until, "Stop after the depth image of this name");
  command.whole("--verify", options->verify, {0, 1'000'000},
                "Build in batch after every so many scans and compare the bytes; 0: never");
  command.whole(
      "--queries", options->queries, {0, 100'000'000},
      "So many plans between random places, in another thread while the map changes, each "
      "path held against the map that it was asked of");
  command.flag("--realtime", options->realtime,
               "No frame comes earlier than the recording's times say (30 images or 10 scans a "
               "second where it has none)");
  command.path("--csv", options->csv, "Table to write, a row a scan");
  add_follow_options(command, options->follow_by_page);
  command.footer(
      "Examples:\n"
      "  ridgeway live data/house_depth -o house.ridge --min-clearance 0.3 --max-distance 4\n"
      "  ridgeway live data/house_depth -o house.ridge --view --open");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
