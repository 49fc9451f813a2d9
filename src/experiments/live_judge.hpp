// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <memory>
#include <optional>

#include "ridgeway/live/live_roadmap.hpp"

namespace ridgeway {

/// How many voxels of a stage's result there are, and how many came or went with a scan.
struct StageChange {
  std::size_t voxels = 0, changed = 0;
  std::size_t blocks = 0;  ///< that hold changed ones
};

/// One scan.
struct LiveScan {
  UpdateReport update;
  BuildSeconds batch;      ///< of build_roadmap of the same map
  bool is_same = true;     ///< whether that gave the same roadmap, the tangent graph apart
  bool is_judged = false;  ///< whether it was asked
  std::size_t known_voxels = 0, map_blocks = 0;
  StageChange traversable, gvd, thick_edges, edges, kernel, diagram;
};

/// Whether two roadmaps are the same, layouts with other slots and tangent graphs apart.
bool is_same(const Roadmap& a, const Roadmap& b);

/// Holds every few updates of a live roadmap against a batch build.
class LiveJudge {
 public:
  /// `every`: how many updates to a judgement; 0: none.
  LiveJudge(const BuildConfig& build, std::size_t every);
  ~LiveJudge();

  /// After an update of a roadmap, always the same one.
  LiveScan judge(const LiveRoadmap& live, const UpdateReport& update);

 private:
  struct Stages;

  const BuildConfig build_;
  const std::size_t every_;
  std::size_t updates_ = 0;
  std::unique_ptr<Stages> before_;
};

}  // namespace ridgeway
