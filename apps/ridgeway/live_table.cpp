// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "files/atomic_file.hpp"
#include "pictures/scatter.hpp"
#include "ridgeway/planning/check.hpp"

namespace ridgeway::cli {
namespace {

constexpr std::size_t kFirst = 9;  // scans before this one

/// A row of the table: what a number of each scan is over the flight.
template <typename Value>
void add_row(BenchTable& table, const std::vector<LiveScan>& scans, const std::string& what,
             const Value& value, bool of_judged = false) {
  std::vector<double> values;
  for (const LiveScan& scan : later_scans(scans))
    if (scan.is_judged || !of_judged) values.push_back(static_cast<double>(value(scan)));
  if (values.empty()) return;
  const Spread spread = spread_of(std::move(values));
  table.add({{"what", what},
             {"median", spread.median},
             {"p95", spread.p95},
             {"p99", spread.p99},
             {"max", spread.max}});
}

void add_counts(BenchTable& table, const std::vector<LiveScan>& scans) {
  const auto add = [&](const std::string& what, const auto& value) {
    add_row(table, scans, what, value);
  };
  const auto add_judged = [&](const std::string& what, const auto& value) {
    add_row(table, scans, what, value, true);
  };
  add_judged("known voxels", [](const LiveScan& s) { return s.known_voxels; });
  add_judged("blocks", [](const LiveScan& s) { return s.map_blocks; });
  add("changed states", [](const LiveScan& s) { return s.update.changed_voxels; });
  add("flipped obstacles", [](const LiveScan& s) { return s.update.flipped_voxels; });
  add("added blocks", [](const LiveScan& s) { return s.update.added_blocks; });
  add("changed distances", [](const LiveScan& s) { return s.update.changed_distances; });
  add("in blocks", [](const LiveScan& s) { return s.update.changed_blocks; });
  const auto add_stage = [&](const std::string& what, StageChange LiveScan::*stage) {
    add_judged(what, [stage](const LiveScan& s) { return (s.*stage).voxels; });
    add_judged(what + ", changed", [stage](const LiveScan& s) { return (s.*stage).changed; });
    add_judged(what + ", in blocks", [stage](const LiveScan& s) { return (s.*stage).blocks; });
  };
  add_stage("traversable", &LiveScan::traversable);
  add_stage("gvd", &LiveScan::gvd);
  add_stage("thick edges", &LiveScan::thick_edges);
  add_stage("thinned edges", &LiveScan::edges);
  add_stage("kernel", &LiveScan::kernel);
  add_stage("diagram", &LiveScan::diagram);
}

void add_times(BenchTable& table, const std::vector<LiveScan>& scans) {
  const auto add = [&](const std::string& what, const auto& seconds, bool of_judged = false) {
    add_row(
        table, scans, "ms " + what, [&](const LiveScan& s) { return 1e3 * seconds(s); }, of_judged);
  };
  add("fusion", [](const LiveScan& s) { return s.update.fusion_seconds; });
  add("map", [](const LiveScan& s) { return s.update.map_seconds; });
  add("copy", [](const LiveScan& s) { return s.update.copy_seconds; });
  const auto add_stage = [&](const std::string& what, double BuildSeconds::*stage) {
    add(what, [stage](const LiveScan& s) { return s.update.build.seconds.*stage; });
    add(
        what + ", batch", [stage](const LiveScan& s) { return s.batch.*stage; }, true);
  };
  add_stage("field", &BuildSeconds::esdf);
  add("ridges", [](const LiveScan& s) {
    const BuildSeconds& t = s.update.build.seconds;
    return t.gvd + t.edges + t.thin;
  });
  add(
      "ridges, batch", [](const LiveScan& s) { return s.batch.gvd + s.batch.edges + s.batch.thin; },
      true);
  add_stage("kernel", &BuildSeconds::kernel);
  add_stage("graph", &BuildSeconds::graph);
  add_stage("attach", &BuildSeconds::attach);
  add(
      "tangents, batch", [](const LiveScan& s) { return s.batch.tangents; }, true);
  add_stage("all stages", &BuildSeconds::total);
  add("from scan to snapshot", [](const LiveScan& s) { return s.update.seconds; });
}

/// A stage of an update, or of the batch build that it was held against.
struct Time {
  const char* name;
  double (*seconds)(const LiveScan&);
  bool of_judged = false;
  bool is_drawn = true;
};
constexpr Time kTimes[] = {
    {"fusion", [](const LiveScan& s) { return s.update.fusion_seconds; }},
    {"map", [](const LiveScan& s) { return s.update.map_seconds; }, false, false},
    {"field", [](const LiveScan& s) { return s.update.build.seconds.esdf; }},
    {"ridges",
     [](const LiveScan& s) {
       const BuildSeconds& t = s.update.build.seconds;
       return t.gvd + t.edges + t.thin;
     }},
    {"copy", [](const LiveScan& s) { return s.update.copy_seconds; }, false, false},
    {"kernel", [](const LiveScan& s) { return s.update.build.seconds.kernel; }},
    {"graph", [](const LiveScan& s) { return s.update.build.seconds.graph; }},
    {"attach", [](const LiveScan& s) { return s.update.build.seconds.attach; }},
    {"scan to snapshot", [](const LiveScan& s) { return s.update.seconds; }},
    {"batch", [](const LiveScan& s) { return s.batch.total; }, true}};

std::string csv_of(const std::vector<LiveScan>& scans) {
  std::string text = "scan,changed_voxels,changed_distances,is_judged,is_same";
  for (const Time& time : kTimes) {
    std::string name = time.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    text.append(",").append(name).append("_ms");
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const LiveScan& scan = scans[i];
    text.append("\n").append(std::to_string(i + 1));
    for (const std::size_t count :
         {scan.update.changed_voxels, scan.update.changed_distances, std::size_t{scan.is_judged},
          std::size_t{scan.is_judged && scan.is_same}})
      text.append(",").append(std::to_string(count));
    for (const Time& time : kTimes)
      text.append(",").append(nlohmann::json(1e3 * time.seconds(scan)).dump());
  }
  return text.append("\n");
}

}  // namespace

std::span<const LiveScan> later_scans(const std::vector<LiveScan>& scans) {
  return std::span(scans).subspan(scans.size() > kFirst ? kFirst : 0);
}

BenchTable live_table(const std::vector<LiveScan>& scans) {
  BenchTable table;
  if (scans.empty()) return table;
  add_counts(table, scans);
  add_times(table, scans);
  return table;
}

void write_scans(const std::vector<LiveScan>& scans, const std::string& folder,
                 const std::string& name) {
  if (folder.empty() || scans.empty()) return;
  const std::filesystem::path path = folder;
  write_text_file(path / (name + ".csv"), csv_of(scans));
  constexpr std::size_t kMostPoints = 50;
  const std::size_t together = (scans.size() + kMostPoints - 1) / kMostPoints;
  ScatterChart chart;
  chart.title = "From scan to snapshot, by stage";
  if (together > 1)
    chart.title += ": medians of " + std::to_string(together) + " scans, of those where it ran";
  chart.x_label = "scan";
  chart.y_label = "milliseconds";
  chart.log_y = true;
  for (const Time& time : kTimes) {
    ScatterSeries series{time.name, {}, SeriesStyle::kLine};
    for (std::size_t first = 0; first < scans.size(); first += together) {
      std::vector<double> values;
      for (std::size_t i = first; i < std::min(first + together, scans.size()); ++i)
        if (const double seconds = time.seconds(scans[i]);
            seconds > 0.0 && (scans[i].is_judged || !time.of_judged))
          values.push_back(1e3 * seconds);
      // Batch builds are some scans apart; stages that nothing was to be done in leave a gap.
      if (values.empty() && time.of_judged) continue;
      series.points.emplace_back(static_cast<double>(first) + 0.5 * static_cast<double>(together),
                                 values.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                : spread_of(std::move(values)).median);
    }
    const bool is_empty = std::all_of(series.points.begin(), series.points.end(),
                                      [](const auto& point) { return std::isnan(point.second); });
    if (time.is_drawn && !is_empty) chart.series.push_back(series);
  }
  for (const char* extension : {".png", ".svg"}) draw_scatter(chart, path / (name + extension));
}

}  // namespace ridgeway::cli
