// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_report.hpp"

#include <utility>

#include "json.hpp"
#include "ridgeway/planning/check.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Column {
  const char* name;
  double (*value)(const UpdateReport&);
};
constexpr Column kCounts[] = {
    {"changed_voxels", [](const UpdateReport& r) { return static_cast<double>(r.changed_voxels); }},
    {"changed_distances",
     [](const UpdateReport& r) { return static_cast<double>(r.changed_distances); }},
    {"in_batch", [](const UpdateReport& r) { return static_cast<double>(r.in_batch); }},
    {"waiting_voxels",
     [](const UpdateReport& r) { return static_cast<double>(r.waiting_voxels); }}};

double ridges(const UpdateReport& r) {
  const BuildSeconds& s = r.build.seconds;
  return 1e3 * (s.gvd + s.edges + s.thin);
}
double kernel(const UpdateReport& r) { return 1e3 * r.build.seconds.kernel; }
double total(const UpdateReport& r) { return 1e3 * r.seconds; }

constexpr Column kStages[] = {
    {"fusion", [](const UpdateReport& r) { return 1e3 * r.fusion_seconds; }},
    {"map", [](const UpdateReport& r) { return 1e3 * r.map_seconds; }},
    {"esdf", [](const UpdateReport& r) { return 1e3 * r.build.seconds.esdf; }},
    {"ridges", ridges},
    {"copy", [](const UpdateReport& r) { return 1e3 * r.copy_seconds; }},
    {"kernel", kernel},
    {"skeleton", [](const UpdateReport& r) { return ridges(r) + kernel(r); }},
    {"graph", [](const UpdateReport& r) { return 1e3 * r.build.seconds.graph; }},
    {"attach", [](const UpdateReport& r) { return 1e3 * r.build.seconds.attach; }}};

Spread spread_of_scans(const LiveReplay& replay, double (*value)(const UpdateReport&)) {
  std::vector<double> values;
  for (const UpdateReport& update : replay.updates) values.push_back(value(update));
  return spread_of(std::move(values));
}

Json json_of(const Spread& spread, double scale = 1.0) {
  return {{"median", scale * spread.median},
          {"p95", scale * spread.p95},
          {"p99", scale * spread.p99},
          {"max", scale * spread.max}};
}

Json json_of(const LiveReplay& replay, const Roadmap& roadmap, const std::string& file) {
  Json json = {{"file", file},
               {"scans", replay.updates.size()},
               {"unreadable", replay.unreadable},
               {"without_pose", replay.without_pose},
               {"verified", replay.verified},
               {"identical", replay.identical},
               {"queries", replay.queries.asked},
               {"query_violations", replay.queries.wrong},
               {"vertices", roadmap.graph.vertices.size()},
               {"edges", roadmap.graph.edges.size()},
               {"milliseconds", json_of(spread_of_scans(replay, total))}};
  for (const Column& stage : kStages)
    json["stage_milliseconds"][stage.name] = json_of(spread_of_scans(replay, stage.value));
  for (const Column& count : kCounts)
    json[count.name] = json_of(spread_of_scans(replay, count.value));
  if (!replay.batch_seconds.empty())
    json["batch_milliseconds"] = json_of(spread_of(replay.batch_seconds), 1e3);
  if (!replay.queries.meanwhile.empty()) {
    json["queries_solved"] = replay.queries.solved;
    json["query_microseconds"] = json_of(spread_of(replay.queries.meanwhile), 1e6);
  }
  json["behind_seconds"] = replay.behind;
  return json;
}

}  // namespace

std::string csv_of(const LiveReplay& replay) {
  std::string text = "frame";
  for (const Column& count : kCounts) text.append(",").append(count.name);
  for (const Column& stage : kStages) text.append(",").append(stage.name).append("_ms");
  text.append(",total_ms");
  const auto add = [&](const Json& value) { text.append(",").append(value.dump()); };
  for (std::size_t i = 0; i < replay.updates.size(); ++i) {
    const UpdateReport& update = replay.updates[i];
    text.append("\n").append(std::to_string(i + 1));
    for (const Column& count : kCounts) add(static_cast<std::uint64_t>(count.value(update)));
    for (const Column& stage : kStages) add(stage.value(update));
    add(total(update));
  }
  return text.append("\n");
}

void print(const LiveReplay& replay, const Roadmap& roadmap, const std::string& file,
           const Globals& globals) {
  if (globals.json) {
    print_json(json_of(replay, roadmap, file));
    return;
  }
  const Spread all = spread_of_scans(replay, total);
  print_row("frames", count_text(replay.updates.size()));
  print_row("graph", count_text(roadmap.graph.vertices.size()) + " vertices, " +
                         count_text(roadmap.graph.edges.size()) + " edges");
  print_row("time", seconds_text(1e-3 * all.median) + " from scan to roadmap, at most " +
                        seconds_text(1e-3 * all.max));
  if (replay.behind > 0.0)
    print_row("behind", seconds_text(replay.behind) + " behind the recording at most");
  if (replay.verified > 0)
    print_row("verified", count_text(replay.identical) + " of " + count_text(replay.verified) +
                              " snapshots are what a batch build gives, which takes " +
                              seconds_text(spread_of(replay.batch_seconds).median));
  if (replay.queries.asked > 0)
    print_row("queries", count_text(replay.queries.asked) + " asked meanwhile, " +
                             count_text(replay.queries.solved) + " with a path, " +
                             count_text(replay.queries.wrong) + " of them not free; " +
                             seconds_text(spread_of(replay.queries.meanwhile).median) + " each");
  print_row("file", file);
}

}  // namespace ridgeway::cli
