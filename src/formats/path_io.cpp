// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/path_io.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>

#include "common/number_text.hpp"
#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Json = nlohmann::ordered_json;
using Columns = std::array<std::size_t, 3>;  ///< where x, y and z stand in a line

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string(), what,
                   "give a CSV file with columns x, y, z or a JSON list of [x, y, z]");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

/// Where a header line names x, y and z; nothing where it does not.
std::optional<Columns> find_columns(const std::vector<std::string_view>& fields) {
  Columns columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view name = std::string_view("xyz").substr(axis, 1);
    const auto found = std::find(fields.begin(), fields.end(), name);
    if (found == fields.end()) return {};
    columns[axis] = static_cast<std::size_t>(found - fields.begin());
  }
  return columns;
}

std::vector<Point> read_csv(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  std::vector<Point> points;
  Columns columns = {0, 1, 2};
  std::size_t line_number = 0, used_lines = 0;
  for (std::string line; std::getline(text, line);) {
    // Spreadsheets begin files of UTF-8 with this mark.
    if (++line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const std::vector<std::string_view> fields = split(line);
    if (used_lines++ == 0) {
      if (const auto named = find_columns(fields)) {
        columns = *named;
        continue;
      }
    }
    Point point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value =
          columns[axis] < fields.size() ? parse_number(fields[columns[axis]]) : std::nullopt;
      if (!value) refuse(path, "line " + std::to_string(line_number) + " is no point");
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    points.push_back(point);
  }
  return points;
}

std::vector<Point> read_json(const std::filesystem::path& path) {
  try {
    const Json json = Json::parse(read_file(path));
    std::vector<Point> points;
    for (const Json& item : json.is_object() ? json.at("waypoints") : json) {
      const auto p = item.get<std::vector<double>>();
      if (p.size() != 3 || !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
        refuse(path, "waypoint " + std::to_string(points.size()) + " is no point");
      }
      points.emplace_back(p[0], p[1], p[2]);
    }
    if (points.empty() && json.is_object() && json.contains("status"))
      throw InputError(path.string(), "holds no path: " + json.at("status").get<std::string>(),
                       "plan again, with what that says changed");
    return points;
  } catch (const Json::parse_error& error) {
    refuse(path, "is no JSON: byte " + std::to_string(error.byte) + " does not fit");
  } catch (const Json::exception&) {
    refuse(path, "has no list of waypoints, each three numbers");
  }
}

Escape escape_of(const Json& json, const char* key, const std::filesystem::path& path) {
  if (!json.contains(key)) return {};
  const Escape escape{json.at(key).at("length").get<double>(),
                      json.at(key).at("clearance").get<double>()};
  if (!(escape.length >= 0.0 && std::isfinite(escape.length) && escape.clearance > 0.0 &&
        std::isfinite(escape.clearance)))
    refuse(path, "has an " + std::string(key) + " that is none");
  return escape;
}

std::string plan_csv(const PlanResult& result) {
  std::string text = "x,y,z\n";
  for (const Point& p : result.waypoints) {
    text += number_text(p.x()) + ',' + number_text(p.y()) + ',' + number_text(p.z()) + '\n';
  }
  return text;
}

}  // namespace

std::string plan_json(const PlanResult& result) {
  Json json;
  json["answered_by"] = std::string(name_of(result.answered_by));
  json["status"] = std::string(name_of(result.status));
  json["length"] = result.length;
  if (result.ok()) json["within"] = result.within;
  json["clearance"] = result.clearance;
  json["unknown"] = {{"policy", std::string(name_of(result.unknown))}};
  const auto add_escape = [&](const char* key, const Escape& escape) {
    if (escape.length > 0.0)
      json[key] = {{"length", escape.length}, {"clearance", escape.clearance}};
  };
  add_escape("escape_start", result.escape_start);
  add_escape("escape_goal", result.escape_goal);
  const auto add_moved = [&](const char* key, const Moved& moved) {
    if (moved.distance > 0.0)
      json[key] = {{"distance", moved.distance},
                   {"place", {moved.place.x(), moved.place.y(), moved.place.z()}}};
  };
  add_moved("moved_start", result.moved_start);
  add_moved("moved_goal", result.moved_goal);
  json["waypoints"] = Json::array();
  for (const Point& p : result.waypoints) json["waypoints"].push_back({p.x(), p.y(), p.z()});
  json["seconds"] = {{"attach", result.seconds.attach},
                     {"search", result.seconds.search},
                     {"shorten", result.seconds.shorten},
                     {"total", result.seconds.total}};
  return json.dump();
}

void require_path_format(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension != ".csv" && extension != ".json")
    throw InputError(path.string(), "names no format of paths", "use .csv or .json");
}

void write_plan(const PlanResult& result, const std::filesystem::path& path) {
  require_path_format(path);
  const bool is_json = extension_of(path) == ".json";
  if (!is_json && !result.ok())
    throw InputError(
        path.string(),
        "is for waypoints, and the plan has none: " + std::string(name_of(result.status)),
        "use .json to write why");
  write_text_file(path, is_json ? plan_json(result) + "\n" : plan_csv(result));
}

std::vector<Point> read_path(const std::filesystem::path& path) {
  require_path_format(path);
  return extension_of(path) == ".json" ? read_json(path) : read_csv(path);
}

PathEscapes read_escapes(const std::filesystem::path& path) {
  require_path_format(path);
  if (extension_of(path) != ".json") return {};
  try {
    const Json json = Json::parse(read_file(path));
    if (!json.is_object()) return {};
    return {escape_of(json, "escape_start", path), escape_of(json, "escape_goal", path)};
  } catch (const Json::exception&) {
    refuse(path, "has an escape that is none");
  }
}

}  // namespace ridgeway
