// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "command.hpp"
#include "console.hpp"
#include "experiments/live_flight.hpp"
#include "ridgeway/live/live_roadmap.hpp"

namespace ridgeway::cli {

/// What came of a recording that was replayed.
struct LiveReplay {
  std::vector<UpdateReport> updates;  ///< a scan each
  std::string layout;                 ///< of the recording
  std::size_t unreadable = 0, without_pose = 0;
  std::string first_unreadable;             ///< which image it was, and what is the matter with it
  std::string upward_axis;                  ///< what a person should be told of it
  std::size_t verified = 0, identical = 0;  ///< scans held against a batch build, and the same
  std::string first_other;                  ///< the frame of the first that was not
  std::vector<double> batch_seconds;        ///< of the builds that verified
  LiveQueries queries;                      ///< that were asked meanwhile
  double behind = 0.0;                      ///< seconds at most, where it kept to the clock
  Stopwatch watch;
};

/// Builds the map in batch, and notes whether that gives the same roadmap: the same file, both made
/// beside the output; or none, where the live one has none.
void verify_by_batch(LiveRoadmap& live, const LiveConfig& config, const std::string& output,
                     const std::string& frame, LiveReplay& replay);

/// A row a scan; milliseconds.
std::string csv_of(const LiveReplay& replay);

/// To stdout, or with --json as one object.
void print(const LiveReplay& replay, const Roadmap& roadmap, const std::string& file,
           const Globals& globals);

}  // namespace ridgeway::cli
