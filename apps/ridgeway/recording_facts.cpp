// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "recording_facts.hpp"

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "console.hpp"
#include "json.hpp"
#include "recording.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "source_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

Json topic(const char* name, const char* type, std::size_t count) {
  return {{"name", name}, {"type", type}, {"count", count}};
}

/// Where the sensor was, in the order of the recording.
void add_places(Json& json, const std::vector<Point>& places) {
  if (places.empty()) return;
  Box bounds{places.front(), places.front()};
  double length = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    bounds.min = bounds.min.cwiseMin(places[i]);
    bounds.max = bounds.max.cwiseMax(places[i]);
    if (i > 0) length += (places[i] - places[i - 1]).norm();
  }
  json["sensor"] = {{"bounds", cli::json_of(bounds)}, {"length", length}};
}

struct Images {
  DepthSequence sequence;
  std::string camera_problem;  ///< why nothing is known of the camera; empty: it is known
};

Images open_images(const std::string& folder) {
  try {
    return {open_sequence(folder), {}};
  } catch (const InputError& error) {
    // All but the camera may be told of: of a recording that is wrong elsewhere this throws too.
    SequenceConfig any_camera;
    any_camera.intrinsics = Eigen::Vector4d(1.0, 1.0, 0.0, 0.0);
    return {open_sequence(folder, any_camera), error.what()};
  }
}

void add_images(Json& json, const Images& images, const Globals& globals) {
  const DepthSequence& sequence = images.sequence;
  json["layout"] = sequence.layout;
  json["topics"] = {topic("depth", "depth_image", sequence.frames.size()),
                    topic("poses", "pose", sequence.frames.size())};
  json["without_pose"] = sequence.without_pose;
  const PinholeCamera& camera = sequence.camera;
  if (images.camera_problem.empty())
    json["camera"] = {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
                      {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
  else
    json["camera"] = nullptr;
  json["units_per_metre"] = sequence.units_per_metre;
  std::vector<Point> places;
  for (const DepthFrame& frame : sequence.frames)
    places.emplace_back(frame.T_world_camera.translation());
  add_places(json, places);
  if (!sequence.frames.empty() && sequence.frames.front().time && sequence.frames.back().time)
    json["seconds"] = *sequence.frames.back().time - *sequence.frames.front().time;
  if (!images.camera_problem.empty()) note(globals, images.camera_problem);
  note_assumed_camera(globals, sequence);
  if (const std::string told = told_of_upward_axis(sequence); !told.empty()) note(globals, told);
}

void add_scans(Json& json, const ScanSequence& sequence) {
  json["layout"] = sequence.layout;
  json["topics"] = {topic("scans", "point_cloud", sequence.scans.size()),
                    topic("poses", "pose", sequence.scans.size())};
  json["without_pose"] = sequence.without_pose;
  std::vector<Point> places;
  for (const Scan& scan : sequence.scans) places.emplace_back(scan.T_world_sensor.translation());
  add_places(json, places);
}

}  // namespace

Json describe_recording(const std::string& folder, const Globals& globals) {
  Json json = {{"file", folder}, {"format", "recording"}};
  if (kind_of_recording(folder) == RecordingKind::kImages)
    add_images(json, open_images(folder), globals);
  else
    add_scans(json, open_scans(folder));
  return json;
}

void print_recording(const Json& facts) {
  const auto number = [](const Json& value) { return text_of(value.get<double>(), 6); };
  print_row("recording",
            facts["file"].get<std::string>() + ", layout " + facts["layout"].get<std::string>());
  const Json& first = facts["topics"][0];
  print_row(first["name"].get<std::string>(),
            count_text(first["count"].get<std::uint64_t>()) + " with a pose, " +
                count_text(facts["without_pose"].get<std::uint64_t>()) + " without");
  if (facts.contains("camera")) {
    const Json& camera = facts["camera"];
    print_row("camera", camera.is_null()
                            ? "not said: fuse asks for --intrinsics"
                            : number(camera["width"]) + " x " + number(camera["height"]) +
                                  " pixels, fx " + number(camera["fx"]) + ", fy " +
                                  number(camera["fy"]) + ", cx " + number(camera["cx"]) + ", cy " +
                                  number(camera["cy"]));
    print_row("depth", "1/" + number(facts["units_per_metre"]) + " m a unit");
  }
  if (facts.contains("seconds")) print_row("duration", number(facts["seconds"]) + " s");
  if (!facts.contains("sensor")) return;
  print_row("sensor", "along " + text_of(facts["sensor"]["length"].get<double>()) + " m, within " +
                          bounds_text(facts["sensor"]["bounds"]));
}

}  // namespace ridgeway::cli
