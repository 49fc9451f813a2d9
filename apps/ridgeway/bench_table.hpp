// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"

namespace ridgeway::cli {

/// What an experiment measured: one JSON object a row, all with the same keys, which may hold
/// objects of numbers ("length_ratio": {"median", "p95"}). Printed as a table, written as CSV and
/// JSON.
class BenchTable {
 public:
  using Json = nlohmann::ordered_json;

  void add(Json row) { rows_.push_back(std::move(row)); }
  const Json& rows() const { return rows_; }

  /// Aligned columns on stdout; nested keys as "length_ratio.p95".
  void print() const;
  /// NAME.csv and NAME.json in a folder, which is made where it is missing. `facts`: what goes
  /// with the rows in the JSON.
  void write(const std::filesystem::path& folder, const std::string& name, Json facts) const;

 private:
  Json rows_ = Json::array();
};

/// Makes the folder that --output names, before the long work. Throws InputError where it cannot
/// be made or written to.
void require_folder(const std::string& folder);

}  // namespace ridgeway::cli
