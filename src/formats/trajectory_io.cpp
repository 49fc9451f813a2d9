// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/number_text.hpp"
#include "files/atomic_file.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"

namespace ridgeway {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Point& p) { return Json::array({p.x(), p.y(), p.z()}); }

/// Coefficients that a trajectory uses: 10, or 8 where the last two are 0 throughout.
int used_coefficients(const Trajectory& trajectory) {
  const bool short_ones = std::all_of(
      trajectory.segments.begin(), trajectory.segments.end(),
      [](const auto& segment) { return segment.coefficients.template rightCols<2>().isZero(0.0); });
  return short_ones ? kCoefficients - 2 : kCoefficients;
}

}  // namespace

void require_trajectory_format(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension != ".csv" && extension != ".json" && extension != ".yaml")
    throw InputError(path.string(), "names no format of trajectories", "use .csv, .json or .yaml");
}

std::string trajectory_json(const PlanResult& path, const TrajectoryResult& result, double step) {
  Json json = Json::parse(plan_json(path));
  json["status"] = std::string(name_of(result.status));
  json["path_clearance"] = path.clearance;
  json["clearance"] = result.clearance;
  json["step"] = std::string(name_of(result.step));
  json["duration"] = result.duration;
  json["stop_and_go_duration"] = result.stop_and_go_duration;
  json["max_speed"] = result.peaks.speed;
  json["max_acceleration"] = result.peaks.acceleration;
  json["max_jerk"] = result.peaks.jerk;
  json["max_yaw_rate"] = result.peaks.yaw_rate;
  json["stops"] = result.stops;
  json["optimisations"] = result.optimisations;
  json["converged"] = result.converged;
  json["evaluations"] = result.evaluations;
  json["cost"] = {{"time", result.cost.time},
                  {"smoothness", result.cost.smoothness},
                  {"collision", result.cost.collision},
                  {"limits", result.cost.limits}};
  Json& seconds = json["seconds"];
  seconds["optimise"] = result.seconds.optimise;
  seconds["verify"] = result.seconds.verify;
  seconds["total"] = path.seconds.total + result.seconds.total;
  json["samples"] = Json::array();
  for (const TrajectoryState& state : result.trajectory.sample(step))
    json["samples"].push_back({{"t", state.time},
                               {"position", json_of(state.position)},
                               {"velocity", json_of(state.velocity)},
                               {"acceleration", json_of(state.acceleration)},
                               {"yaw", state.yaw}});
  return json.dump();
}

std::string trajectory_csv(const Trajectory& trajectory, double step) {
  std::string text = "t,x,y,z,vx,vy,vz,ax,ay,az,yaw\n";
  for (const TrajectoryState& state : trajectory.sample(step)) {
    text += number_text(state.time);
    for (const Point* vector : {&state.position, &state.velocity, &state.acceleration})
      for (const double value : *vector) text += ',' + number_text(value);
    text += ',' + number_text(state.yaw) + '\n';
  }
  return text;
}

namespace {

/// Of a piece, as mav_trajectory_generation counts them.
long long nanoseconds_of(const TrajectorySegment& segment) {
  const double nanoseconds = segment.duration * 1e9;
  constexpr double kLeast = 0.5, kMost = 9e18;
  const bool is_stand = segment.duration == 0.0;
  if (!is_stand && !(nanoseconds >= kLeast && nanoseconds <= kMost))
    throw InputError("trajectory",
                     "has a piece of " + number_text(segment.duration) +
                         " s, which is no whole number of nanoseconds that .yaml can tell",
                     "write .json or .csv, or change the limits of motion");
  return std::llround(nanoseconds);
}

}  // namespace

std::string trajectory_yaml(const Trajectory& trajectory) {
  const int count = used_coefficients(trajectory);
  std::string text = "segments:\n";
  for (const TrajectorySegment& segment : trajectory.segments) {
    text += "  - N: " + std::to_string(count) + "\n    D: " + std::to_string(kFlatOutputs);
    text += "\n    time: " + std::to_string(nanoseconds_of(segment)) + "  # [ns]\n";
    text += "    coefficients:\n";
    for (int output = 0; output < kFlatOutputs; ++output) {
      text += "      - [";
      for (int k = 0; k < count; ++k)
        text += (k > 0 ? ", " : "") + number_text(segment.coefficients(output, k));
      text += "]\n";
    }
  }
  return text;
}

void write_trajectory(const PlanResult& path, const TrajectoryResult& result,
                      const std::filesystem::path& file, double step) {
  require_trajectory_format(file);
  const std::string extension = extension_of(file);
  if (extension == ".json")
    write_text_file(file, trajectory_json(path, result, step) + "\n");
  else if (extension == ".csv")
    write_text_file(file, trajectory_csv(result.trajectory, step));
  else
    write_text_file(file, trajectory_yaml(result.trajectory));
}

}  // namespace ridgeway
