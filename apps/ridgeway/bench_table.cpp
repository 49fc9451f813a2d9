// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bench_table.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "arguments.hpp"
#include "console.hpp"
#include "files/atomic_file.hpp"
#include "interruption.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;
namespace fs = std::filesystem;

using Lines = std::vector<std::vector<std::string>>;

constexpr std::size_t kWidest = 200;  // characters of a line that a screen still holds

/// Nested keys joined by dots.
Json flat(const Json& row) {
  Json result = Json::object();
  for (const auto& [key, value] : row.items()) {
    if (!value.is_object()) {
      result[key] = value;
      continue;
    }
    const Json nested = flat(value);
    for (const auto& [inner, number] : nested.items())
      result[std::string(key).append(".").append(inner)] = number;
  }
  return result;
}

std::vector<std::size_t> widths_of(const Lines& lines) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  return widths;
}

std::size_t width_of(const Lines& lines) {
  std::size_t width = 0;
  for (const std::size_t column : widths_of(lines)) width += column + 2;
  return width;
}

Lines turned(const Lines& lines) {
  Lines result(lines.front().size());
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) result[i].push_back(line[i]);
  return result;
}

std::string cell_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "-";
  if (!value.is_number_float()) return value.dump();
  const double number = value.get<double>();
  const double size = std::abs(number);
  return text_of(number, size >= 0.1 ? 3 : size >= 1e-3 ? 5 : 7);  // seconds may be micro
}

}  // namespace

void BenchTable::print(const std::string& title) const {
  if (!title.empty()) std::printf("%s\n", title.c_str());
  Lines lines;
  for (const Json& row : rows_) {
    const Json cells = flat(row);
    if (lines.empty()) {
      lines.emplace_back();
      for (const auto& [key, value] : cells.items()) lines.back().push_back(key);
    }
    lines.emplace_back();
    for (const auto& [key, value] : cells.items()) lines.back().push_back(cell_text(value));
  }
  if (lines.empty()) return;
  if (width_of(lines) > kWidest && width_of(turned(lines)) < width_of(lines)) lines = turned(lines);
  const std::vector<std::size_t> widths = widths_of(lines);
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i)
      text.append(i == 0 ? 0 : 2, ' ').append(widths[i] - line[i].size(), ' ').append(line[i]);
    std::printf("%s\n", text.c_str());
  }
}

void require_distinct(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end())
    throw InputError("'" + *twice + "'", "is there twice", "name each map once");
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

std::string BenchTable::csv() const {
  std::string csv;
  for (const Json& row : rows_) {
    const Json cells = flat(row);
    const auto line = [&](const auto& text_of_cell) {
      const char* before = "";
      for (const auto& [key, value] : cells.items()) {
        csv.append(before).append(csv_cell(text_of_cell(key, value)));
        before = ",";
      }
      csv.append("\n");
    };
    if (csv.empty()) line([](const std::string& key, const Json&) { return key; });
    line([](const std::string&, const Json& value) {
      return value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
    });
  }
  return csv;
}

int BenchTable::report(const Globals& globals, const std::string& folder, const std::string& name,
                       Json facts, bool complete) const {
  facts["complete"] = complete;
  facts["rows"] = rows_;
  if (globals.json)
    print_json(facts);
  else
    print();
  if (complete && !folder.empty()) {  // what was measured is printed, whatever becomes of the files
    write_text_file(fs::path(folder) / (name + ".csv"), csv());
    write_text_file(fs::path(folder) / (name + ".json"), facts.dump(2) + "\n");
  }
  if (complete) return kExitDone;
  note(globals, "interrupted: these are the results so far");
  return interrupted_exit_code();
}

World ScanOptions::load() const { return world.empty() ? make_house() : load_world(world); }

PoseSampling ScanOptions::poses(std::uint64_t seed) const {
  return {.low = volume->min, .high = volume->max, .count = scans, .seed = seed};
}

void add_scan_options(Command& command, ScanOptions& options) {
  command.path("--world", options.world, "World, .yaml (default: the house)");
  command.box("--volume", options.volume, "Where the camera may be, x0,y0,z0,x1,y1,z1");
  command.whole("--scans", options.scans, {1, 100'000}, "Depth images to fuse");
}

void require_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder, "cannot be made: " + error.message(), "give another folder");
  if (!fs::is_directory(folder, error) || ::access(folder.c_str(), W_OK) != 0)
    throw InputError("'" + folder + "'", "is no folder that can be written to",
                     "give another folder");
}

}  // namespace ridgeway::cli
