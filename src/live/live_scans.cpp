// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What is fused, and fused again.
#include <algorithm>
#include <string>
#include <unordered_set>

#include "live_state.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"

namespace ridgeway {

/// Throws InputError for changes too far from the map's origin: before the first update that is the
/// one that was given, else the sensor's voxel.
void LiveRoadmap::State::require_near_origin(std::span<const VoxelChange> changes,
                                             const Point& sensor) const {
  const VoxelIndex origin =
      now ? now->field.esdf.origin
          : config.origin.value_or(voxel_at(sensor, config.fusion.voxel_size));
  const VoxelRange reach = detail::reach_of_map(origin);
  if (!std::all_of(changes.begin(), changes.end(),
                   [&](const VoxelChange& change) { return reach.contains(change.voxel); }))
    throw InputError("pose", detail::kTooFar, detail::kNearerOrigin);
}

template <typename Fuse, typename Keep>
UpdateReport LiveRoadmap::State::integrate_frame(const Eigen::Isometry3d& T_world_sensor,
                                                 const Fuse& fuse, const Keep& keep) {
  detail::Lap lap;
  UpdateReport report;
  std::vector<BlockIndex> reached;
  const std::size_t logged = log ? log->size() : 0;
  const auto take_back = [&] {
    fusion.undo();
    frames_of_blocks.drop_last(reached, frames);
    if (log && log->size() > logged) log->drop_last();
  };
  try {
    fuse();
    if (log) {
      keep(*log);
      reached = fusion.reached_blocks();
      if (frames == 0)
        frames_of_blocks.origin = config.fusion.origin.value_or(
            voxel_at(T_world_sensor.translation(), config.fusion.voxel_size));
      frames_of_blocks.add(T_world_sensor, reached, log->first());
    }
    const Point& sensor = T_world_sensor.translation();
    const std::vector<VoxelChange> found = fusion.find_changes();
    require_near_origin(found, sensor);  // those that wait outside of the window too
    const std::vector<VoxelChange> changes = window.take_near(found, sensor);
    report.fusion_seconds = lap.seconds();
    update(changes, voxel_at(sensor, config.fusion.voxel_size), report);
  } catch (const InputError& error) {
    take_back();
    throw error.within("frame " + std::to_string(frames + 1));
  } catch (...) {
    take_back();
    throw;
  }
  fusion.accept_changes();
  window.keep();
  report.frame = ++frames;
  if (log && !correction) log->forget_oldest_if_full();
  report.waiting_voxels = window.size();
  return report;
}

UpdateReport LiveRoadmap::State::integrate(const DepthImage& image, const PinholeCamera& camera,
                                           const Eigen::Isometry3d& T_world_camera) {
  return integrate_frame(
      T_world_camera, [&] { fusion.integrate(image, camera, T_world_camera); },
      [&](detail::ScanLog& kept) { kept.add(image, camera); });
}

UpdateReport LiveRoadmap::State::integrate(std::span<const Point> points,
                                           const Eigen::Isometry3d& T_world_sensor) {
  return integrate_frame(
      T_world_sensor, [&] { fusion.integrate(points, T_world_sensor); },
      [&](detail::ScanLog& kept) { kept.add(points); });
}

/// The poses of all frames with some of them corrected.
std::vector<Eigen::Isometry3d> LiveRoadmap::State::corrected(
    std::span<const PoseCorrection> corrections) const {
  if (!log)
    throw InputError("log_folder", "was not given, so that no scan was kept",
                     "give one where poses are to be corrected");
  std::vector<Eigen::Isometry3d> poses = frames_of_blocks.poses;
  for (const PoseCorrection& one : corrections) {
    const std::string name = "frame " + std::to_string(one.frame);
    if (one.frame < 1 || one.frame > poses.size())
      throw InputError(name, "was not fused", "count frames from 1 in the order they were fused");
    try {
      validate_transform(one.T_world_sensor);
    } catch (const InputError& error) {
      throw error.within(name);
    }
    poses[one.frame - 1] = one.T_world_sensor;
  }
  return poses;
}

void LiveRoadmap::State::begin_correcting(std::span<const PoseCorrection> corrections) {
  std::unordered_set<std::uint64_t> said_again;
  for (const PoseCorrection& one : corrections) said_again.insert(one.frame);
  std::vector<PoseCorrection> all;
  for (const PoseCorrection& one : under_way)
    if (!said_again.contains(one.frame)) all.push_back(one);
  all.insert(all.end(), corrections.begin(), corrections.end());
  std::vector<Eigen::Isometry3d> poses = corrected(all);
  const auto same = [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return a.matrix() == b.matrix();
  };
  std::unique_ptr<detail::Correction> next;
  if (!std::equal(poses.begin(), poses.end(), frames_of_blocks.poses.begin(), same))
    next = std::make_unique<detail::Correction>(config.fusion, *log, frames_of_blocks,
                                                std::move(poses));
  correction = std::move(next);
  under_way = std::move(all);
}

bool LiveRoadmap::State::is_correction_ready() const {
  return !correction || correction->is_ready(frames_of_blocks);
}

UpdateReport LiveRoadmap::State::finish_correcting() {
  detail::Lap lap;
  UpdateReport report;
  under_way.clear();
  const std::unique_ptr<detail::Correction> ended = std::move(correction);
  if (!ended) {
    report.version = version;
    report.has_roadmap = has_snapshot();
    report.waiting_voxels = window.size();
    return report;
  }
  detail::CorrectedScans& scans = ended->finished(frames_of_blocks);
  std::vector<Point> places;
  places.reserve(scans.frames.poses.size());
  for (const Eigen::Isometry3d& pose : scans.frames.poses) places.emplace_back(pose.translation());
  try {
    fusion.take_over(scans.part, places);
    const std::vector<VoxelChange> found = fusion.find_changes();
    require_near_origin(found, places.back());
    const std::vector<VoxelChange> changes = window.take_near(found, places.back());
    report.fusion_seconds = lap.seconds();
    update(changes, std::nullopt, report);
  } catch (...) {
    fusion.undo();
    throw;
  }
  fusion.accept_changes();
  window.keep();
  frames_of_blocks = std::move(scans.frames);
  log->forget_oldest_if_full();
  report.waiting_voxels = window.size();
  report.fused_again = scans.redone.size();
  return report;
}

}  // namespace ridgeway
