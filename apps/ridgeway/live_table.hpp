// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "bench_table.hpp"
#include "experiments/live_judge.hpp"

namespace ridgeway::cli {

/// Counts and milliseconds over the scans of a flight.
BenchTable live_table(const std::vector<LiveScan>& scans);

/// Writes live_scans.csv, a row a scan, and charts of the milliseconds by scan (live.png, live.svg)
/// into a folder.
void write_scans(const std::vector<LiveScan>& scans, const std::string& folder);

}  // namespace ridgeway::cli
