// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/live_stream.hpp"

#include <utility>
#include <vector>

#include "console.hpp"
#include "json.hpp"
#include "view/base64.hpp"
#include "viewer/live_layers.hpp"

namespace ridgeway::cli {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds kMoment = 200ms;
// A connection that has gone is noticed by writing to it.
constexpr std::chrono::milliseconds kSignEvery = 2s;

Json json_of_points(const std::vector<Point>& points) {
  Json list = Json::array();
  for (const Point& p : points) list.push_back(cli::json_of(p));
  return list;
}

/// Of the map as a whole.
void add_facts(const Roadmap& roadmap, Json& json) {
  const EsdfMap& esdf = roadmap.esdf;
  const double size = esdf.voxel_size;
  // In the same memory: it is only looked at.
  const OccupancyMap occupancy = {size, esdf.origin, esdf.layout, esdf.state.shared(), esdf.planar};
  json["voxel_size"] = size;
  json["mapped"] = static_cast<double>(count_voxels(occupancy).known()) * size * size * size;
  json["vertices"] = roadmap.graph.vertices.size();
  json["edges"] = roadmap.graph.edges.size();
  if (const auto bounds = known_bounds(occupancy)) json["bounds"] = cli::json_of(*bounds);
}

}  // namespace

std::string LiveStream::event_of(const LiveView::Update& update) {
  const LiveScene& scene = update.scene;
  Json json = {{"begins", !std::exchange(has_begun_, true)},
               {"is_last", scene.is_last},
               {"scan", scene.scan},
               {"scans", nullptr},
               {"seconds", scene.seconds},
               {"position", cli::json_of(scene.position)},
               {"yaw", scene.yaw},
               {"positions", json_of_points(update.positions)},
               {"ahead", json_of_points(scene.ahead)}};
  if (scene.scans) json["scans"] = *scene.scans;
  if (const std::shared_ptr<const Roadmap>& now = scene.roadmap) {
    const Roadmap nothing = sent_ ? Roadmap{} : nothing_like(*now);
    const Roadmap& before = sent_ ? *sent_ : nothing;
    add_facts(*now, json);
    json["surface"] = base64(surface_delta_layer(before.esdf, now->esdf));
    json["graph"] = base64(graph_delta_layer(before, *now));
    sent_ = now;
  }
  return "data: " + json.dump() + "\n\n";
}

std::string LiveStream::next() {
  const std::optional<LiveView::Update> update = view_.next(seen_, kMoment);
  if (!update && Clock::now() - last_sign_ < kSignEvery) return {};
  last_sign_ = Clock::now();
  return update ? event_of(*update) : ":\n\n";
}

}  // namespace ridgeway::cli
