// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench_table.hpp"
#include "experiments/live_judge.hpp"

namespace ridgeway::cli {

/// Those that count: of a flight the first few find little but the unknown.
std::span<const LiveScan> later_scans(const std::vector<LiveScan>& scans);

/// Counts and milliseconds over the later scans of a flight.
BenchTable live_table(const std::vector<LiveScan>& scans);

/// Writes NAME.csv, a row a scan, and charts of the milliseconds by scan (NAME.png, NAME.svg) into
/// a folder; nothing where it is empty.
void write_scans(const std::vector<LiveScan>& scans, const std::string& folder,
                 const std::string& name);

}  // namespace ridgeway::cli
