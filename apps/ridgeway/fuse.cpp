// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/io/depth_sequence.hpp"
#include "ridgeway/io/tsdf_file.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"

namespace ridgeway::cli {
namespace {

struct Options {
  std::string folder, output, intrinsics, integrator = "projective";
  FusionConfig fusion;
};

struct Fused {
  TsdfMap map;
  std::size_t frames = 0, unreadable = 0;
  double seconds = 0.0;  // of fusing alone
};

SequenceConfig sequence_config(const Options& options) {
  SequenceConfig config;
  if (options.intrinsics.empty()) return config;
  const std::vector<double> v = parse_numbers(options.intrinsics, "--intrinsics");
  if (v.size() != 4)
    throw InputError("--intrinsics '" + options.intrinsics + "'", "are not four numbers",
                     "give fx,fy,cx,cy in pixels");
  config.intrinsics = Eigen::Vector4d(v[0], v[1], v[2], v[3]);
  return config;
}

/// Images that are missing or damaged are passed over, as real recordings have them; not all.
Fused fuse(const DepthSequence& sequence, const FusionConfig& config, const Globals& globals) {
  TsdfFusion fusion(config);
  Fused fused;
  ProgressBar bar(globals);
  std::string first_problem;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    bar.show("fuse", static_cast<double>(i) / static_cast<double>(sequence.frames.size()));
    std::optional<DepthImage> image;
    try {
      image = read_frame(sequence, sequence.frames[i]);
    } catch (const InputError& error) {
      if (fused.unreadable++ == 0) first_problem = error.what();
      continue;
    }
    const Stopwatch watch;
    fusion.integrate(*image, sequence.camera, sequence.frames[i].T_world_camera);
    fused.seconds += watch.seconds();
    ++fused.frames;
  }
  bar.clear();
  if (fused.unreadable > 0)
    warn(globals,
         count_text(fused.unreadable) + " images were passed over, the first: " + first_problem);
  if (sequence.without_pose > 0)
    note(globals, count_text(sequence.without_pose) + " images have no pose and were passed over");
  fused.map = fusion.map();
  return fused;
}

int run(const Options& options, const Globals& globals) {
  FusionConfig config = options.fusion;
  if (options.integrator == "rays") config.integrator = Integrator::kRayCasting;
  config.validate();
  const DepthSequence sequence = open_sequence(options.folder, sequence_config(options));
  require_writable({options.output}, {});
  const Fused fused = fuse(sequence, config, globals);
  const VoxelCounts voxels = count_voxels(occupancy_of(fused.map));
  if (voxels.free == 0)
    throw InputError(options.folder, "shows no free space",
                     "check --min-range, --max-range and the scale of the images");
  save_tsdf(fused.map, options.folder, options.output);
  const double milliseconds = 1e3 * fused.seconds / static_cast<double>(fused.frames);
  if (globals.json) {
    print_json({{"file", options.output},
                {"frames", fused.frames},
                {"unreadable", fused.unreadable},
                {"without_pose", sequence.without_pose},
                {"voxel_size", fused.map.voxel_size},
                {"truncation", fused.map.truncation},
                {"voxels", {{"free", voxels.free}, {"occupied", voxels.occupied}}},
                {"frame_milliseconds", milliseconds},
                {"peak_memory_bytes", peak_memory_bytes()}});
  } else {
    print_row("frames", count_text(fused.frames) + " (" + sequence.layout + ")");
    print_row("voxels",
              count_text(voxels.free) + " free, " + count_text(voxels.occupied) + " occupied");
    print_row("time", seconds_text(1e-3 * milliseconds) + " a frame");
    print_row("file", options.output);
  }
  return kExitDone;
}

}  // namespace

void add_fuse_command(CLI::App& app, const Globals& globals, Command& chosen) {
  const auto options = std::make_shared<Options>();
  FusionConfig& fusion = options->fusion;
  CLI::App* command = app.add_subcommand("fuse", "Fuse depth images with poses to a map");
  command
      ->add_option("folder", options->folder,
                   "Recording in the layout of TUM RGB-D, 7-Scenes or 3DMatch")
      ->required();
  command->add_option("-o,--output", options->output, "Map to write, .ridge")->required();
  command->add_option("--voxel-size", fusion.voxel_size, "Metres")->capture_default_str();
  command->add_option("--truncation", fusion.truncation,
                      "Distances to surfaces are kept up to here, metres (default: four voxels)");
  command->add_option("--min-range", fusion.min_range, "Nothing nearer is taken, metres")
      ->capture_default_str();
  command->add_option("--max-range", fusion.max_range, "Nothing farther is taken, metres")
      ->capture_default_str();
  command->add_option("--clear-radius", fusion.clear_radius,
                      "Space this near to where the camera was is free, metres");
  command->add_option("--integrator", options->integrator, "By voxels or by rays")
      ->check(CLI::IsMember({"projective", "rays"}))
      ->capture_default_str();
  command->add_option("--intrinsics", options->intrinsics,
                      "fx,fy,cx,cy in pixels (default: the recording's, or its layout's)");
  command->footer(
      "Example:\n"
      "  ridgeway simulate worlds/house.yaml -o house && ridgeway fuse house -o house.ridge\n"
      "  ridgeway build house.ridge -o roadmap.ridge --unknown ignore");
  run_when_given(*command, options, globals, chosen, run);
}

}  // namespace ridgeway::cli
