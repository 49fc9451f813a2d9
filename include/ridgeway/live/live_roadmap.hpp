// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

namespace ridgeway {

/// How scans are fused, and how roadmaps are built of them.
struct LiveConfig {
  FusionConfig fusion = {};  ///< its voxel size is the map's
  BuildConfig build = {};    ///< as build_roadmap takes it
  /// The lattice's voxel that is the map's own (0, 0, 0). Left out: the voxel that holds the sensor
  /// at the first pose, or, where voxels are set before that, the lattice's zero.
  std::optional<VoxelIndex> origin = {};
  /// Metres: blocks farther than this from the sensor, along any axis, do not follow what is fused
  /// until it comes nearer, or catch_up() is called.
  double window = std::numeric_limits<double>::infinity();
  /// Folder, new or empty, in which scans are kept for correct_poses; empty: none are. It is used
  /// by one roadmap alone, and emptied with it.
  std::filesystem::path log_folder = {};
  std::uint64_t log_bytes = std::uint64_t{4} << 30;  ///< of all scans that are kept: the newest
  std::string source = {};  ///< what snapshots say of where they are from (Roadmap::source)
  std::string record = {};  ///< what snapshots say of their configuration (Roadmap::config)

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Where the sensor was at a frame, counted from 1, as it is known now (sensor to world).
struct PoseCorrection {
  std::uint64_t frame = 0;                                           ///< UpdateReport::frame
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();  ///< sensor to world, metres
};

/// What an update did, and how long that took.
struct UpdateReport {
  /// That was fused, as PoseCorrection counts: each scan and image that integrate() took, those in
  /// which nothing was measured too; 0 for other updates.
  std::uint64_t frame = 0;
  std::uint64_t version = 0;          ///< of the snapshot: how many there have been
  bool has_roadmap = false;           ///< false: no voxel is traversable
  bool in_batch = false;              ///< all was built again, nothing brought up to date
  std::size_t changed_voxels = 0;     ///< that are in another state than before
  std::size_t flipped_voxels = 0;     ///< of them became obstacles or ceased to be
  std::size_t added_blocks = 0;       ///< of the map
  std::size_t waiting_voxels = 0;     ///< changes outside of the window that do not count yet
  std::size_t fused_again = 0;        ///< blocks, by correct_poses
  std::size_t changed_distances = 0;  ///< voxels with another distance or site than before
  std::size_t changed_blocks = 0;     ///< that hold such voxels
  BuildReport build;                  ///< counts of the stages; seconds.esdf is that of the update
  double fusion_seconds = 0.0;        ///< until the changed voxels were known
  double map_seconds = 0.0;           ///< to bring the states up to date
  double copy_seconds = 0.0;          ///< to give the snapshot a field of its own
  double seconds = 0.0;               ///< in all, until the snapshot was there
};

/// A roadmap that follows its map while the map is being made.
///
/// Contract: after every update the snapshot has the same bytes as build_roadmap(map(),
/// config.build), the tangent graph apart, and settled() has the same with it, for any order and
/// grouping of the changes and any number of threads, voxels that become free or unknown again
/// included.
///
/// Threads may share one: updates come one after the other, and any number of threads may call
/// snapshot() meanwhile and plan on what they get. An update that throws leaves map and snapshot as
/// they were: InputError for bad input, naming the frame, counted from 1, or the change, counted
/// from 0.
class LiveRoadmap {
 public:
  /// Throws InputError naming the bad field, or a log folder that cannot be used.
  explicit LiveRoadmap(const LiveConfig& config = {});
  ~LiveRoadmap();
  /// The one moved from can only be assigned to or destroyed.
  LiveRoadmap(LiveRoadmap&&) noexcept;
  /// The one moved from can only be assigned to or destroyed.
  LiveRoadmap& operator=(LiveRoadmap&&) noexcept;

  /// Fuses a depth image of a camera with a pose (camera to world), as TsdfFusion does. Throws
  /// InputError as that does, and for a scan that changes voxels farther than 5e8 from the origin.
  UpdateReport integrate(const DepthImage& image, const PinholeCamera& camera,
                         const Eigen::Isometry3d& T_world_camera);
  /// Fuses points in the sensor's frame, its origin at 0.
  UpdateReport integrate(std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor);

  /// Sets voxels of the lattice; of several changes of one voxel the last counts. For maps that
  /// are made elsewhere. What is fused later goes by what was fused before, not by these: a voxel
  /// that was set stays so until a measurement turns its fused state into another.
  UpdateReport set_voxels(std::span<const VoxelChange> changes);

  /// Takes other poses for some frames, of which the last of each counts: the blocks that those
  /// frames reached, or reach now, are forgotten and fused again, from the log. After it all is as
  /// if every frame had been fused with its corrected pose, by a roadmap with the same origins,
  /// both its own and the fusion's; what was set by set_voxels stays where nothing fused speaks
  /// against it. Planners go on with the last snapshot meanwhile. Throws InputError where there is
  /// no log, no such frame, or a frame that is needed has left the log. The same as the next three,
  /// one after the other.
  UpdateReport correct_poses(std::span<const PoseCorrection> corrections);
  /// Begins it in a thread of its own and returns at once; scans may be fused meanwhile, and count
  /// with the poses they are given. What was begun and not finished before begins anew with it. The
  /// log may grow beyond its bound until it is finished.
  void begin_correcting(std::span<const PoseCorrection> corrections);
  /// Whether finish_correcting() would return without waiting for that thread: nothing was begun,
  /// or all but a few scans are fused again.
  bool is_correction_ready();
  /// Waits for that thread and updates the roadmap. A correction that throws here is given up, and
  /// all is as it was.
  UpdateReport finish_correcting();

  /// Follows what waits outside of the window.
  UpdateReport catch_up();

  /// The roadmap after the last update, which stays as it is; none while no voxel is
  /// traversable: then no path is safe. Never waits for an update.
  std::shared_ptr<const Roadmap> snapshot() const;

  /// The same with cell graph and tangent graph, which are of the whole map and take as long as
  /// many updates: snapshots come without them (Roadmap::is_settled), and queries on those are as
  /// right, but slower, their paths at times longer. Makes them, unless that was done, in the
  /// thread that asks, while others go on; from then on, until the next update, snapshot() has them
  /// too.
  std::shared_ptr<const Roadmap> settled();

  /// The map after the last update: the blocks in which something is known, without what waits
  /// outside of the window.
  OccupancyMap map() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ridgeway
