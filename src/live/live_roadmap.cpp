// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/live/live_roadmap.hpp"

#include <tbb/task_arena.h>

#include <string>

#include "common/require.hpp"
#include "live_state.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "roadmap/build_stages.hpp"

namespace ridgeway {
namespace {

void validate_changes(std::span<const VoxelChange> changes, const VoxelIndex& origin) {
  const VoxelRange reach = detail::reach_of_map(origin);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto refuse = [i](const char* what, const char* remedy) {
      throw InputError("change " + std::to_string(i), what, remedy);
    };
    if (changes[i].state > VoxelState::kOccupied)
      refuse("has no enumerator of VoxelState", "give kUnknown, kFree or kOccupied");
    if (!kAllVoxels.contains(changes[i].voxel))
      refuse("lies farther than 1e9 voxels from the world's zero",
             "check its units and the voxel size");
    if (!reach.contains(changes[i].voxel)) refuse(detail::kTooFar, detail::kNearerOrigin);
  }
}

/// Runs work while nothing else updates the state. Isolated: a thread that waits for a loop of it
/// must not take up another task of the caller's, which may want the same state.
template <typename Work>
auto alone(std::mutex& updating, const Work& work) {
  const std::lock_guard lock(updating);
  return tbb::this_task_arena::isolate(work);
}

}  // namespace

void LiveConfig::validate() const {
  fusion.validate();
  build.validate();
  detail::require_suits(build, fusion.voxel_size);
  if (origin) require_within_reach({*origin, *origin}, "origin");
  detail::require(window > 0.0, "window", window, "give metres above 0, or leave it out");
}

LiveRoadmap::State::State(const LiveConfig& given)
    : config(given),
      fusion([&] {
        given.validate();
        FusionConfig undoable = given.fusion;
        undoable.can_undo = true;
        return undoable;
      }()),
      window(given.window, given.fusion.voxel_size) {
  if (!given.log_folder.empty())
    log = std::make_unique<detail::ScanLog>(given.log_folder, given.log_bytes);
}

LiveRoadmap::LiveRoadmap(const LiveConfig& config) : state_(std::make_unique<State>(config)) {}
LiveRoadmap::~LiveRoadmap() = default;
LiveRoadmap::LiveRoadmap(LiveRoadmap&&) noexcept = default;
LiveRoadmap& LiveRoadmap::operator=(LiveRoadmap&&) noexcept = default;

UpdateReport LiveRoadmap::integrate(const DepthImage& image, const PinholeCamera& camera,
                                    const Eigen::Isometry3d& T_world_camera) {
  return alone(state_->updating, [&] { return state_->integrate(image, camera, T_world_camera); });
}

UpdateReport LiveRoadmap::integrate(std::span<const Point> points,
                                    const Eigen::Isometry3d& T_world_sensor) {
  return alone(state_->updating, [&] { return state_->integrate(points, T_world_sensor); });
}

UpdateReport LiveRoadmap::set_voxels(std::span<const VoxelChange> changes) {
  State& s = *state_;
  return alone(s.updating, [&] {
    validate_changes(changes,
                     s.now ? s.now->field.esdf.origin : s.config.origin.value_or(VoxelIndex{}));
    UpdateReport report;
    s.update(s.window.take_with(changes), std::nullopt, report);
    s.window.keep();
    report.waiting_voxels = s.window.size();
    return report;
  });
}

UpdateReport LiveRoadmap::catch_up() {
  State& s = *state_;
  return alone(s.updating, [&] {
    UpdateReport report;
    s.update(s.window.take_all(), std::nullopt, report);
    s.window.keep();
    report.waiting_voxels = 0;
    return report;
  });
}

UpdateReport LiveRoadmap::correct_poses(std::span<const PoseCorrection> corrections) {
  return alone(state_->updating, [&] {
    state_->begin_correcting(corrections);
    return state_->finish_correcting();
  });
}

void LiveRoadmap::begin_correcting(std::span<const PoseCorrection> corrections) {
  alone(state_->updating, [&] { state_->begin_correcting(corrections); });
}

bool LiveRoadmap::is_correction_ready() {
  return alone(state_->updating, [&] { return state_->is_correction_ready(); });
}

UpdateReport LiveRoadmap::finish_correcting() {
  return alone(state_->updating, [&] { return state_->finish_correcting(); });
}

std::shared_ptr<const Roadmap> LiveRoadmap::snapshot() const {
  const std::lock_guard lock(state_->mutex);
  return state_->snapshot;
}

std::shared_ptr<const Roadmap> LiveRoadmap::settled() { return state_->settled(); }

OccupancyMap LiveRoadmap::map() const {
  const State& s = *state_;
  return alone(s.updating, [&] {
    if (s.now) return map_of(s.now->field);
    OccupancyMap map;
    map.voxel_size = s.config.fusion.voxel_size;
    map.origin = s.config.origin.value_or(VoxelIndex{});
    return map;
  });
}

}  // namespace ridgeway
