// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What is fused, and fused again.
#include <algorithm>
#include <string>

#include "live_state.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"

namespace ridgeway {

void detail::FrameIndex::add(const Eigen::Isometry3d& pose, std::span<const BlockIndex> reached) {
  const auto frame = static_cast<std::uint32_t>(poses.size());
  poses.push_back(pose);
  for (const BlockIndex& block : reached) of_block[block].push_back(frame);
}

void detail::FrameIndex::drop_last(std::span<const BlockIndex> reached,
                                   std::size_t frames) noexcept {
  for (const BlockIndex& block : reached)
    if (const auto own = of_block.find(block); own != of_block.end())
      while (!own->second.empty() && own->second.back() >= frames) own->second.pop_back();
  while (poses.size() > frames) poses.pop_back();
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
      frames_of_blocks.add(T_world_sensor, reached);
    }
    const Point& sensor = T_world_sensor.translation();
    const std::vector<VoxelChange> changes = window.take_near(fusion.find_changes(), sensor);
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
  if (log) log->forget_oldest_if_full();
  ++frames;
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

/// All poses, and the frames whose pose is another than before, ascending.
std::vector<Eigen::Isometry3d> LiveRoadmap::State::corrected(
    std::span<const PoseCorrection> corrections, std::vector<std::uint32_t>& moved) const {
  if (!log)
    throw InputError("log_folder", "was not given, so that no scan was kept",
                     "give one where poses are to be corrected");
  std::vector<Eigen::Isometry3d> poses = frames_of_blocks.poses;
  for (const PoseCorrection& correction : corrections) {
    const std::string name = "frame " + std::to_string(correction.frame);
    if (correction.frame < 1 || correction.frame > poses.size())
      throw InputError(name, "was not fused", "count frames from 1 in the order they were fused");
    try {
      validate_transform(correction.T_world_sensor);
    } catch (const InputError& error) {
      throw error.within(name);
    }
    poses[correction.frame - 1] = correction.T_world_sensor;
  }
  for (std::uint32_t frame = 0; frame < poses.size(); ++frame)
    if (poses[frame].matrix() != frames_of_blocks.poses[frame].matrix()) moved.push_back(frame);
  return poses;
}

/// Fuses a frame of the log from a pose.
void LiveRoadmap::State::fuse_logged(TsdfFusion& part, std::uint32_t frame,
                                     const Eigen::Isometry3d& pose) const {
  try {
    if (frame < log->first())
      throw InputError("log", "no longer has this scan", "let log_bytes be more");
    const detail::LoggedScan scan = log->read(frame);
    if (scan.is_image)
      part.integrate(scan.image, scan.camera, pose);
    else
      part.integrate(scan.points, pose);
  } catch (const InputError& error) {
    throw error.within("frame " + std::to_string(frame + 1));
  }
}

/// Which frames reach which blocks once some have moved, and the blocks to fuse again: those that
/// moved ones reached, or reach now.
detail::FrameIndex LiveRoadmap::State::frames_after(
    const std::vector<Eigen::Isometry3d>& poses, const std::vector<std::uint32_t>& moved,
    std::unordered_set<BlockIndex, BlockHash>& redone) const {
  detail::FrameIndex after = frames_of_blocks;
  after.poses = poses;
  const auto has_moved = [&](std::uint32_t frame) {
    return std::binary_search(moved.begin(), moved.end(), frame);
  };
  for (auto& [block, of_block] : after.of_block)
    if (std::erase_if(of_block, has_moved) > 0) redone.insert(block);
  FusionConfig probing = config.fusion;
  probing.origin = config.fusion.origin.value_or(
      voxel_at(frames_of_blocks.poses.front().translation(), config.fusion.voxel_size));
  for (const std::uint32_t frame : moved) {
    TsdfFusion probe(probing);
    fuse_logged(probe, frame, poses[frame]);
    for (const BlockIndex& block : probe.reached_blocks()) {
      std::vector<std::uint32_t>& of_block = after.of_block[block];
      of_block.insert(std::lower_bound(of_block.begin(), of_block.end(), frame), frame);
      redone.insert(block);
    }
  }
  return after;
}

UpdateReport LiveRoadmap::State::correct_poses(std::span<const PoseCorrection> corrections) {
  detail::Lap lap;
  UpdateReport report;
  std::vector<std::uint32_t> moved;
  const std::vector<Eigen::Isometry3d> poses = corrected(corrections, moved);
  if (moved.empty()) return report;
  std::unordered_set<BlockIndex, BlockHash> redone;
  detail::FrameIndex after = frames_after(poses, moved, redone);
  std::vector<std::uint32_t> needed = moved;
  for (const BlockIndex& block : redone) {
    const std::vector<std::uint32_t>& of_block = after.of_block[block];
    needed.insert(needed.end(), of_block.begin(), of_block.end());
  }
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  TsdfFusion part = fusion.within_blocks(std::vector<BlockIndex>(redone.begin(), redone.end()));
  for (const std::uint32_t frame : needed) fuse_logged(part, frame, poses[frame]);
  std::vector<Point> places;
  places.reserve(poses.size());
  for (const Eigen::Isometry3d& pose : poses) places.emplace_back(pose.translation());
  try {
    fusion.take_over(part, places);
    const std::vector<VoxelChange> changes = window.take_near(fusion.find_changes(), places.back());
    report.fusion_seconds = lap.seconds();
    update(changes, {}, report);
  } catch (...) {
    fusion.undo();
    throw;
  }
  fusion.accept_changes();
  window.keep();
  report.waiting_voxels = window.size();
  frames_of_blocks = std::move(after);
  report.fused_again = redone.size();
  return report;
}

}  // namespace ridgeway
