// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "live_judge.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// What changes from scan to scan while a world is explored, and what an update costs against a
/// batch build. Lengths in metres.
struct LiveFlightConfig {
  double voxel_size = 0.1;
  double min_clearance = 0.3;
  double max_distance = 4.0;
  double spacing = 0.3;  ///< way between scans
  double sigma = 0.01;   ///< noise of every range
  std::size_t scans = 100;
  std::uint64_t seed = 1;        ///< of places and noise
  std::size_t verify_every = 1;  ///< scans to a batch build that it is held against; 0: none
  std::size_t copies = 0;        ///< of the exact world that are known from the first, beside it
  bool queries = false;          ///< plan in another thread meanwhile
  std::size_t tangent_pairs = 2000;  ///< of the batch builds

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Paths that were planned in another thread while the map was updated, each on the snapshot of
/// that time, and again when nothing else ran.
struct LiveQueries {
  std::size_t asked = 0, solved = 0;
  std::size_t wrong = 0;          ///< paths that are not free in the snapshot they were asked of
  std::vector<double> meanwhile;  ///< seconds of that thread, by query
  std::vector<double> alone;      ///< and of the same queries afterwards
};

struct LiveFlight {
  std::vector<LiveScan> scans;
  LiveQueries queries;
  /// Bytes that the live roadmap holds in the end, its snapshot included, over those of a batch
  /// build of the same map; nothing where the allocator does not tell, as that of a sanitizer.
  std::optional<double> memory_ratio;
};

/// The ratio above. `before`: allocated_bytes() before the live roadmap was made.
std::optional<double> memory_ratio(const LiveRoadmap& live, const BuildConfig& build,
                                   std::uint64_t before);

/// A forward camera flies between random places of a world, along paths planned on its exact map,
/// and all it sees goes into a live roadmap. Where it is cancelled the results are those that were
/// done.
void run_live_flight(const World& world, const LiveFlightConfig& config, const Progress& progress,
                     LiveFlight& results);

/// A door between two rooms is closed in front of a camera, and opened again.
struct DoorConfig {
  double voxel_size = 0.1;
  double min_clearance = 0.3;
  double max_distance = 2.0;
  double sigma = 0.01;
  int forget_after = 8;  ///< see FusionConfig
  std::uint64_t seed = 1;
  std::size_t verify_every = 1;  ///< scans to a comparison with a batch build; 0: none

  /// Throws InputError naming the bad field.
  void validate() const;
};
struct DoorResult {
  LiveFlight flight;
  int until_no_path = -1;  ///< scans from the first of the closed door on; -1: never
  int until_path = -1;     ///< and from the first of the door that is open again
  bool has_path_first = false;
};
DoorResult run_door(const DoorConfig& config, const Progress& progress = {});

/// Random changes of a small map, boxes and specks that come and go; how many of them left the
/// roadmap that a batch build gives. With one thread and with more in turn.
struct ChangeSets {
  std::size_t done = 0, same = 0;
  /// Of those: sets after which there is no roadmap, in batch neither.
  std::size_t without_roadmap = 0;
};
void run_change_sets(std::size_t count, std::uint64_t seed, const Progress& progress,
                     ChangeSets& results);

}  // namespace ridgeway
