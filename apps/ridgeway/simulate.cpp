// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "json.hpp"
#include "recording.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "sensing/poses.hpp"

namespace ridgeway::cli {
namespace {

constexpr int kMostFrames = 1000000;

struct SimulateOptions {
  std::string world, output, camera = "pinhole";
  std::optional<Box> volume;
  int frames = 200, width = 320;
  double sigma = 0.0, clearance = 0.5, max_range = 10.0, rate = 10.0;
  std::uint64_t seed = 1;
};

DepthSensor sensor_of(const SimulateOptions& options) {
  DepthSensor sensor = options.camera == "stereo" ? stereo_sensor() : DepthSensor{};
  PinholeCamera& camera = sensor.camera;
  camera.width = options.width;
  camera.height = 3 * options.width / 4;
  camera.fx = camera.fy = 0.5 * options.width;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  sensor.range_sigma = options.sigma;
  sensor.max_range = options.max_range;
  sensor.validate();
  return sensor;
}

PoseSampling sampling_of(const SimulateOptions& options, const World& world) {
  PoseSampling sampling;
  if (options.volume) {
    sampling.low = options.volume->min;
    sampling.high = options.volume->max;
  } else {
    sampling = sampling_inside(world);
  }
  sampling.clearance = options.clearance;
  sampling.count = static_cast<std::size_t>(options.frames);
  sampling.seed = options.seed;
  return sampling;
}

int run(const SimulateOptions& options, const Globals& globals) {
  const DepthSensor sensor = sensor_of(options);
  require_recordable(sensor);
  const World world = load_world(options.world);
  const auto poses = sample_poses(world, sampling_of(options, world));
  SequenceWriter writer(options.output, sensor.camera, options.rate);
  ProgressBar bar(globals);
  const Stopwatch watch;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    bar.show("simulate", static_cast<double>(i) / static_cast<double>(poses.size()));
    // A frame's noise is its own, whatever the number of frames.
    const World now = world_at(world, static_cast<double>(i) / options.rate);
    writer.add(render_depth(now, sensor, poses[i], options.seed * kMostFrames + i), poses[i]);
  }
  writer.finish();
  bar.clear();
  const double seconds = watch.seconds();
  if (globals.json) {
    print_json({{"folder", options.output},
                {"frames", poses.size()},
                {"width", sensor.camera.width},
                {"height", sensor.camera.height},
                {"seconds", seconds}});
  } else {
    print_row("frames", count_text(poses.size()) + " of " + std::to_string(sensor.camera.width) +
                            " x " + std::to_string(sensor.camera.height) + " pixels");
    print_row("folder", options.output);
    print_row("time", seconds_text(seconds));
  }
  return kExitDone;
}

}  // namespace

void add_simulate_command(Command& program) {
  const auto options = std::make_shared<SimulateOptions>();
  Command command =
      program.add("simulate", "Record depth images in a simulated world, TUM RGB-D layout");
  command.path("world", options->world, "World, .yaml").required();
  command.path("-o,--output", options->output, "Folder to write, new or empty").required();
  command.whole("--frames", options->frames, {1, kMostFrames},
                "Images to record, from random level poses");
  command.choice("--camera", options->camera, {"pinhole", "stereo"},
                 "A perfect one, or a stereo pair");
  command.whole("--width", options->width, {4, 16384},
                "Pixels across, of 90 degrees; 3/4 as many down");
  command.number("--sigma", options->sigma, kLengthsFromZero,
                 "Gaussian noise on every range, metres");
  command.number("--max-range", options->max_range, kLengths,
                 "Nothing farther is measured, metres");
  command.box("--volume", options->volume,
              "Where the camera may be, x0,y0,z0,x1,y1,z1 (default: the whole world)");
  command.number("--clearance", options->clearance, kLengthsFromZero,
                 "Of the camera to all surfaces, metres");
  command.number("--rate", options->rate, {1e-3, 1e6},
                 "Images a second: their times, by which solids of the world come and go");
  command.seed(options->seed, "Of poses and noise");
  command.footer(
      "Example:\n"
      "  ridgeway simulate worlds/house.yaml -o house --volume 1,1,1,14,10,5 --sigma 0.1");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
