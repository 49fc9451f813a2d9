// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bench_table.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "console.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/io/atomic_file.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;
namespace fs = std::filesystem;

/// Nested keys joined by dots.
Json flat(const Json& row) {
  Json result = Json::object();
  for (const auto& [key, value] : row.items()) {
    if (!value.is_object()) {
      result[key] = value;
      continue;
    }
    for (const auto& [inner, number] : value.items())
      result[std::string(key).append(".").append(inner)] = number;
  }
  return result;
}

std::string cell_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "-";
  return value.is_number_float() ? text_of(value.get<double>()) : value.dump();
}

}  // namespace

void BenchTable::print() const {
  std::vector<std::vector<std::string>> lines;
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
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i)
      text.append(i == 0 ? 0 : 2, ' ').append(widths[i] - line[i].size(), ' ').append(line[i]);
    std::printf("%s\n", text.c_str());
  }
}

void BenchTable::write(const fs::path& folder, const std::string& name, Json facts) const {
  std::string csv;
  for (const Json& row : rows_) {
    const Json cells = flat(row);
    const auto line = [&](const auto& text_of_cell) {
      std::string text;
      for (const auto& [key, value] : cells.items())
        text.append(text.empty() ? "" : ",").append(text_of_cell(key, value));
      csv.append(text).append("\n");
    };
    if (csv.empty()) line([](const std::string& key, const Json&) { return key; });
    line([](const std::string&, const Json& value) {
      return value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
    });
  }
  facts["rows"] = rows_;
  write_text_file(folder / (name + ".csv"), csv);
  write_text_file(folder / (name + ".json"), facts.dump(2) + "\n");
}

void require_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder) || ::access(folder.c_str(), W_OK) != 0)
    throw InputError("'" + folder + "'", "is no folder that can be written to",
                     "give another folder");
}

}  // namespace ridgeway::cli
