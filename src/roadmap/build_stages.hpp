// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "common/clock.hpp"
#include "esdf/remembered_space.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/diagram_memory.hpp"
#include "skeleton/peeling_memory.hpp"
#include "skeleton/watershed.hpp"

/// Parts of build_roadmap, for those who have the results of its first stages already.
namespace ridgeway::detail {

/// What is kept from one build to the next of a map that changes.
struct BuildMemory {
  SegmentMemory segments;
  PeelingMemory peeling;
  DiagramMemory diagram;
  BasinNumbers basin;                    ///< of the watershed that was built on last
  std::vector<std::uint8_t> is_highest;  ///< by basin: no pass leads to a higher peak
  /// Whole 26-connected parts of traversable space that are left out of a build, as all about them
  /// is as it was; none: none are.
  std::optional<Rest> rest = {};
};

/// Times the stages one after the other and reports each to the caller.
class StageClock {
 public:
  explicit StageClock(const Progress& progress) : progress_(progress) {}

  void begin(std::string_view stage) {
    if (progress_ && !progress_(stage, static_cast<double>(done_++) / kStages)) throw Cancelled();
    start();
  }
  /// Goes on with a stage that was ended.
  void start() { start_ = detail::seconds_now(); }
  void end(double& seconds) const { seconds += detail::seconds_now() - start_; }

 private:
  static constexpr int kStages = 8;
  const Progress& progress_;
  int done_ = 0;
  double start_ = detail::seconds_now();
};

/// What compute_gvd takes of the whole configuration.
GvdConfig ridges_of(const BuildConfig& config);

/// Throws InputError where a valid configuration does not suit maps of a voxel size.
void require_suits(const BuildConfig& config, double voxel_size);

/// What compute_esdf takes of the whole configuration.
EsdfConfig distances_config(const BuildConfig& config);

/// The distances of a map, in which small pockets of free space are filled where unknown space is
/// ignored. Consumes the map.
EsdfMap distances_of(OccupancyMap map, const BuildConfig& config);

/// Work that needs the distances alone, for threads that would have nothing to do where a stage
/// goes through its voxels one by one: a batch build makes its cell graph there.
using Beside = std::function<void()>;

/// All that follows from the distances, which `result.roadmap` holds, with its min_clearance, but
/// for what is learnt. `traversable`: the voxels free at that, at least one.
void build_on_distances(VoxelMask traversable, const BuildConfig& config, BuildResult& result,
                        StageClock& clock, const Beside& beside = {});

/// What is traversable, and the watershed of it.
struct Space {
  VoxelMask traversable;
  Watershed watershed;
};

/// Called once each, at the same time: EdgesOf gives the thinned edges of the GVD, SpaceOf what the
/// kernel is peeled from, which does without these edges.
using EdgesOf = std::function<VoxelMask()>;
using SpaceOf = std::function<Space()>;

/// All that follows from these two and the distances, which `result.roadmap` holds: kernel,
/// diagram, graph and attach field. `memory`: what a live roadmap keeps of its last build; null in
/// a batch build.
void build_on_watershed(const EdgesOf& edges_of, const SpaceOf& space_of, const BuildConfig& config,
                        BuildResult& result, StageClock& clock, BuildMemory* memory = nullptr,
                        const Beside& beside = {});

/// What is learnt of a roadmap that is complete but for this, its cells unless it has them, and the
/// total of all seconds. Queries do without, slower.
void build_what_is_learnt(const BuildConfig& config, BuildResult& result, StageClock& clock);

}  // namespace ridgeway::detail
