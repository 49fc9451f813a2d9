// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "corrected_scans.hpp"
#include "live_basins.hpp"
#include "live_field.hpp"
#include "live_ridges.hpp"
#include "live_window.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "roadmap/build_stages.hpp"
#include "scan_log.hpp"
#include "shared_memory.hpp"
#include "touched_space.hpp"

namespace ridgeway {
namespace detail {

/// Where the voxels of a map may lie: places are relative to its origin, and exact near it.
inline VoxelRange reach_of_map(const VoxelIndex& origin) {
  return grown({origin, origin}, kMaxVoxelIndex / 2);
}
inline constexpr const char* kTooFar = "lies farther than 5e8 voxels from the map's origin";
inline constexpr const char* kNearerOrigin = "give an origin near the map";

}  // namespace detail

struct LiveRoadmap::State {
  /// What follows the map.
  struct Live {
    detail::LiveField field;
    detail::LiveRidges ridges;
    detail::LiveBasins basins;
    detail::LiveAttach attach;
    std::unique_ptr<detail::BuildMemory> memory;
    bool is_built = false;  ///< the last snapshot is of these, as they were before the last update
    std::ptrdiff_t diagram_voxels = 0;  ///< of that snapshot
  };

  explicit State(const LiveConfig& given);

  const LiveConfig config;
  mutable std::mutex updating;  // of all that follows but the snapshot: one update after the other
  TsdfFusion fusion;
  detail::LiveWindow window;
  std::unique_ptr<detail::ScanLog> log;  // none unless poses may be corrected
  detail::FrameIndex frames_of_blocks;   // that of the log
  std::uint64_t frames = 0;              // that were fused
  std::optional<Live> now;               // none before the first update
  bool is_stale = false;                 // the map is right, distances are not
  std::uint64_t version = 0;
  std::vector<PoseCorrection> under_way;           // that were begun and not finished
  std::unique_ptr<detail::Correction> correction;  // none: no pose is another for them
  mutable std::mutex mutex;                        // of the snapshot
  std::shared_ptr<const Roadmap> snapshot;

  // live_scans.cpp
  UpdateReport integrate(const DepthImage& image, const PinholeCamera& camera,
                         const Eigen::Isometry3d& T_world_camera);
  UpdateReport integrate(std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor);
  void begin_correcting(std::span<const PoseCorrection> corrections);
  bool is_correction_ready() const;
  UpdateReport finish_correcting();

  // live_update.cpp
  /// Brings all up to date; `first`: the map's origin if it has none, nothing where only changes
  /// give it one.
  void update(std::span<const VoxelChange> changes, const std::optional<VoxelIndex>& first,
              UpdateReport& report);
  bool has_snapshot() const;
  /// The last snapshot with what is learnt. For any thread.
  std::shared_ptr<const Roadmap> settled();

 private:
  void require_near_origin(std::span<const VoxelChange> changes, const Point& sensor) const;
  template <typename Fuse, typename Keep>
  UpdateReport integrate_frame(const Eigen::Isometry3d& T_world_sensor, const Fuse& fuse,
                               const Keep& keep);
  std::vector<Eigen::Isometry3d> corrected(std::span<const PoseCorrection> corrections) const;

  void bring_up_to_date(std::span<const VoxelChange> changes, UpdateReport& report);
  Live nothing(const VoxelIndex& origin, bool near_only) const;
  Live remade() const;
  std::shared_ptr<const Roadmap> last_built_on(Live& live) const;
  detail::TouchedSpace touched_space_of(Live& live, bool has_last) const;
  std::shared_ptr<const Roadmap> built_on(Live& live, detail::Lap& lap, UpdateReport& report) const;
  std::shared_ptr<const Roadmap> built_in_batch(detail::Lap& lap, UpdateReport& report) const;
  std::shared_ptr<const Roadmap> published(BuildResult result, BuildReport& report) const;
};

}  // namespace ridgeway
