// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "json.hpp"
#include "recording.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

namespace ridgeway::cli {
namespace {

struct FuseOptions {
  std::string folder, output, integrator;
  std::vector<double> intrinsics;
  std::optional<double> truncation;
  FusionConfig fusion;
};

struct Fused {
  std::string layout;
  TsdfMap map;
  std::size_t frames = 0, unreadable = 0, without_pose = 0;
  std::optional<PointCounts> points;  // of scans
  double seconds = 0.0;               // of fusing alone
  std::string upward_axis;            // what a person should be told of it
};

SequenceConfig sequence_config(const FuseOptions& options) {
  SequenceConfig config;
  if (options.intrinsics.empty()) return config;
  const std::vector<double>& v = options.intrinsics;
  config.intrinsics = Eigen::Vector4d(v[0], v[1], v[2], v[3]);
  return config;
}

/// Runs one step of the fusion; complaints name the frame.
template <typename Integrate>
void fuse_frame(const std::filesystem::path& frame, Fused& fused, const Integrate& integrate) {
  const Stopwatch watch;
  try {
    integrate();
  } catch (const InputError& error) {
    throw error.within(frame.string());
  }
  fused.seconds += watch.seconds();
  ++fused.frames;
}

/// Images that are missing or damaged are passed over, as real recordings have them; not all.
Fused fuse_images(const FuseOptions& options, const FusionConfig& config, const Globals& globals) {
  const DepthSequence sequence = open_sequence(options.folder, sequence_config(options));
  note_assumed_camera(globals, sequence);
  TsdfFusion fusion(config);
  Fused fused;
  fused.layout = sequence.layout;
  fused.without_pose = sequence.without_pose;
  ProgressBar bar(globals);
  std::string first_problem;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    bar.show("fuse", static_cast<double>(i) / static_cast<double>(sequence.frames.size()));
    const DepthFrame& frame = sequence.frames[i];
    std::optional<DepthImage> image;
    try {
      image = read_frame(sequence, frame);
    } catch (const InputError& error) {
      if (fused.unreadable++ == 0) first_problem = error.what();
      continue;
    }
    fuse_frame(frame.image, fused,
               [&] { fusion.integrate(*image, sequence.camera, frame.T_world_camera); });
  }
  bar.clear();
  warn_of_unreadable(globals, fused.unreadable, first_problem);
  fused.upward_axis = told_of_upward_axis(sequence);
  fused.map = fusion.map();
  return fused;
}

/// Scans are few and large: one that cannot be read is a mistake.
Fused fuse_scans(const FuseOptions& options, const FusionConfig& config, const Globals& globals) {
  const ScanSequence sequence = open_scans(options.folder);
  TsdfFusion fusion(config);
  Fused fused;
  fused.layout = sequence.layout;
  fused.without_pose = sequence.without_pose;
  PointCounts& points = fused.points.emplace();
  ProgressBar bar(globals);
  for (std::size_t i = 0; i < sequence.scans.size(); ++i) {
    bar.show("fuse", static_cast<double>(i) / static_cast<double>(sequence.scans.size()));
    const Scan& scan = sequence.scans[i];
    const PointCloud cloud = read_scan(scan);
    fuse_frame(scan.cloud, fused, [&] { fusion.integrate(cloud.points, scan.T_world_sensor); });
    points.add(cloud, config);
  }
  bar.clear();
  note_points_without_surface(globals, points);
  fused.map = fusion.map();
  return fused;
}

FusionConfig fusion_config(const FuseOptions& options, RecordingKind kind) {
  FusionConfig config = options.fusion;
  if (options.truncation) config.truncation = *options.truncation;
  if (kind == RecordingKind::kScans) {
    if (options.integrator == "projective")
      throw InputError("--integrator projective", "is for depth images", "leave it out for scans");
    if (!options.intrinsics.empty())
      throw InputError("--intrinsics", "are those of depth images", "leave them out for scans");
  }
  if (kind == RecordingKind::kScans || options.integrator == "rays")
    config.integrator = Integrator::kRayCasting;
  config.validate();
  return config;
}

void print(const FuseOptions& options, const Fused& fused, const VoxelCounts& voxels,
           const Globals& globals) {
  const double milliseconds = 1e3 * fused.seconds / static_cast<double>(fused.frames);
  if (globals.json) {
    nlohmann::ordered_json json = {
        {"file", options.output},
        {"layout", fused.layout},
        {"frames", fused.frames},
        {"unreadable", fused.unreadable},
        {"without_pose", fused.without_pose},
        {"voxel_size", fused.map.voxel_size},
        {"truncation", fused.map.truncation},
        {"voxels", {{"free", voxels.free}, {"occupied", voxels.occupied}}},
        {"frame_milliseconds", milliseconds},
        {"peak_memory_bytes", peak_memory_bytes()}};
    if (fused.points)
      json["points"] = {{"fused", fused.points->fused},
                        {"out_of_range", fused.points->out_of_range},
                        {"beyond", fused.points->beyond},
                        {"not_finite", fused.points->not_finite}};
    print_json(json);
    return;
  }
  print_row("frames", count_text(fused.frames) + " (" + fused.layout + ")");
  if (fused.points) print_row("points", count_text(fused.points->fused));
  print_row("voxels",
            count_text(voxels.free) + " free, " + count_text(voxels.occupied) + " occupied");
  print_row("time", seconds_text(1e-3 * milliseconds) + " a frame");
  print_row("file", options.output);
}

int run(const FuseOptions& options, const Globals& globals) {
  const RecordingKind kind = kind_of_recording(options.folder);
  const FusionConfig config = fusion_config(options, kind);
  require_outside(options.output, options.folder);
  require_writable({options.output}, {});
  require_extension(options.output, "a map", {".ridge"});
  const Fused fused = kind == RecordingKind::kScans ? fuse_scans(options, config, globals)
                                                    : fuse_images(options, config, globals);
  note_without_pose(globals, fused.without_pose, fused.layout);
  const VoxelCounts voxels = count_voxels(occupancy_of(fused.map));
  if (voxels.free == 0)
    throw InputError(options.folder, "shows no free space",
                     "check --min-range, --max-range and the scale of the recording");
  save_tsdf(fused.map, options.folder, options.output);
  if (!fused.upward_axis.empty()) note(globals, fused.upward_axis);
  print(options, fused, voxels, globals);
  return kExitDone;
}

}  // namespace

void add_fuse_command(Command& program) {
  const auto options = std::make_shared<FuseOptions>();
  FusionConfig& fusion = options->fusion;
  Command command = program.add("fuse", "Fuse depth images or scans with poses to a map");
  command
      .path("folder", options->folder,
            "Recording: depth images in the layout of TUM RGB-D, 7-Scenes, 3DMatch or Open3D, or "
            "point "
            "clouds with poses.txt")
      .required();
  command.path("-o,--output", options->output, "Map to write, .ridge").required();
  command.number("--voxel-size", fusion.voxel_size, kLengths, "Metres");
  command.number("--truncation", options->truncation, kLengthsFromZero,
                 "Distances to surfaces are kept up to here, metres (default: four voxels)");
  command.number("--min-range", fusion.min_range, kLengthsFromZero,
                 "Nothing nearer is taken, metres");
  command.number("--max-range", fusion.max_range, kLengths,
                 "What is farther only frees the way up to here, metres");
  command.number("--clear-radius", fusion.clear_radius, kLengthsFromZero,
                 "What was not measured this near to where the sensor was is free, metres");
  command.choice("--integrator", options->integrator, {"projective", "rays"},
                 "By voxels or by rays (default: projective; scans go by rays alone)");
  command.tuple("--intrinsics", options->intrinsics, 4, "fx,fy,cx,cy",
                "In pixels (default: the recording's, or its layout's)");
  command.footer(
      "Folders:\n"
      "  TUM RGB-D          depth.txt, groundtruth.txt, images of 1/5000 m\n"
      "  7-Scenes, 3DMatch  frame-*.depth.png in millimetres, frame-*.pose.txt\n"
      "  Open3D, Redwood    depth/*.png in millimetres, trajectory.log\n"
      "  scans              .xyz, .ply or .pcd clouds in the sensor's frame, and poses.txt with\n"
      "                     a line for each: cloud tx ty tz qx qy qz qw (sensor to world)\n"
      "  registered scans   S_raw.xyz and registration_metrics.json, which moves each to one\n"
      "Example:\n"
      "  ridgeway simulate worlds/house.yaml -o house && ridgeway fuse house -o house.ridge\n"
      "  ridgeway build house.ridge -o roadmap.ridge --unknown ignore");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
