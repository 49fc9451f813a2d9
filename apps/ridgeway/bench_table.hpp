// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "json.hpp"
#include "sensing/poses.hpp"

namespace ridgeway::cli {

/// What an experiment measured: one JSON object a row, all with the same keys, which may hold
/// objects of numbers ("length_ratio": {"median", "p95"}). Printed as a table, written as CSV and
/// JSON.
class BenchTable {
 public:
  using Json = nlohmann::ordered_json;

  void add(Json row) { rows_.push_back(std::move(row)); }
  const Json& rows() const { return rows_; }

  /// Prints the rows as aligned columns, nested keys as "length_ratio.p95" (a column a row, where
  /// the lines would get too long), or with --json one object of `facts` and rows. With a folder,
  /// not empty, writes NAME.csv and NAME.json there. Returns the exit code; rows that are not
  /// `complete`, as the experiment was interrupted, are only printed.
  int report(const Globals& globals, const std::string& folder, const std::string& name, Json facts,
             bool complete) const;

  /// The rows alone, to stdout, under a line with a title where there is one.
  void print(const std::string& title = {}) const;

 private:
  std::string csv() const;

  Json rows_ = Json::array();
};

/// Throws InputError where two of the maps or worlds that rows and files are named by have one
/// name.
void require_distinct(std::vector<std::string> names);

/// A text as a cell of CSV (RFC 4180): quoted where it has to be.
std::string csv_cell(const std::string& text);

/// What the experiments with a moving depth camera share: the world, and where the camera may be.
struct ScanOptions {
  std::string world;
  std::optional<Box> volume = Box{Point(1.0, 1.0, 1.0), Point(14.0, 10.0, 5.0)};
  std::size_t scans = 200;

  World load() const;  ///< the house where no file is given
  PoseSampling poses(std::uint64_t seed) const;
};
void add_scan_options(Command& command, ScanOptions& options);

/// Makes the folder that --output names, before the long work. Throws InputError where it cannot
/// be made or written to.
void require_folder(const std::string& folder);

}  // namespace ridgeway::cli
