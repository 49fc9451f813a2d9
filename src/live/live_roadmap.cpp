// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/live/live_roadmap.hpp"

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "live_ridges.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "roadmap/build_stages.hpp"

namespace ridgeway {
namespace {

using detail::LiveField;
using detail::LiveRidges;
using detail::seconds_now;

/// Times one step after the other.
class Lap {
 public:
  double seconds() {
    const double before = std::exchange(start_, seconds_now());
    return start_ - before;
  }

 private:
  double start_ = seconds_now();
};

void validate_changes(std::span<const VoxelChange> changes, const VoxelIndex& origin) {
  const VoxelRange reach = grown({origin, origin}, kMaxVoxelIndex / 2);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto refuse = [i](const char* what, const char* remedy) {
      throw InputError("change " + std::to_string(i), what, remedy);
    };
    if (changes[i].state > VoxelState::kOccupied)
      refuse("has no enumerator of VoxelState", "give kUnknown, kFree or kOccupied");
    if (!kAllVoxels.contains(changes[i].voxel))
      refuse("lies farther than 1e9 voxels from the world's zero",
             "check its units and the voxel size");
    if (!reach.contains(changes[i].voxel))
      refuse("lies farther than 5e8 voxels from the map's origin", "give an origin near the map");
  }
}

std::vector<VoxelChange> all_of(const OccupancyMap& map) {
  std::vector<VoxelChange> changes;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] != VoxelState::kUnknown)
      changes.push_back({map.origin + map.layout.index_of(id), map.state[id]});
  return changes;
}

}  // namespace

void LiveConfig::validate() const {
  fusion.validate();
  build.validate();
  detail::require_suits(build, fusion.voxel_size);
  if (origin) require_within_reach({*origin, *origin}, "origin");
}

struct LiveRoadmap::State {
  /// What follows the map.
  struct Live {
    LiveField field;
    LiveRidges ridges;
  };

  explicit State(const LiveConfig& given) : config(given), fusion(undoable(given)) {}

  static FusionConfig undoable(const LiveConfig& given) {
    given.validate();
    FusionConfig fusion = given.fusion;
    fusion.can_undo = true;
    return fusion;
  }

  const LiveConfig config;
  TsdfFusion fusion;
  std::uint64_t frames = 0;  // that were fused
  std::optional<Live> now;   // none before the first update
  bool is_stale = false;     // the map is right, distances are not
  std::uint64_t version = 0;
  mutable std::mutex mutex;  // of what follows
  std::shared_ptr<const Roadmap> snapshot;

  template <typename Fuse>
  UpdateReport integrate(const Point& sensor_world, const Fuse& fuse) {
    Lap lap;
    UpdateReport report;
    try {
      fuse();
      const std::vector<VoxelChange> changes = fusion.find_changes();
      report.fusion_seconds = lap.seconds();
      update(changes, voxel_at(sensor_world, config.fusion.voxel_size), report);
    } catch (const InputError& error) {
      fusion.undo();
      throw error.within("frame " + std::to_string(frames + 1));
    } catch (...) {
      fusion.undo();
      throw;
    }
    fusion.accept_changes();
    ++frames;
    return report;
  }

  /// Brings all up to date; `first`: the map's origin if it has none.
  void update(std::span<const VoxelChange> changes, const VoxelIndex& first, UpdateReport& report) {
    Lap all;
    if (now && is_stale) {
      now = remade();
      is_stale = false;
    }
    const bool is_first = !now;
    if (is_first) now = nothing(config.origin.value_or(first));
    try {
      bring_up_to_date(changes, report);
    } catch (...) {
      if (is_first) {
        now.reset();
      } else {
        undo_changes(now->field);
        is_stale = true;
      }
      throw;
    }
    report.version = version;
    report.has_roadmap = snapshot != nullptr;
    report.seconds = report.fusion_seconds + all.seconds();
  }

  void bring_up_to_date(std::span<const VoxelChange> changes, UpdateReport& report) {
    Lap lap;
    LiveField& field = now->field;
    const std::uint32_t blocks = field.esdf.layout.block_count();
    apply_changes(field, changes);
    report.map_seconds = lap.seconds();
    report.changed_voxels = field.before.size();
    report.flipped_voxels = field.flipped.count();
    report.added_blocks = field.esdf.layout.block_count() - blocks;
    if (report.changed_voxels == 0) return;
    const bool follows =
        config.build.unknown == UnknownPolicy::kObstacle && !config.build.basis_point_edges;
    // Blocks in which nothing is known any more are none of the map's.
    report.in_batch =
        !follows || std::find(field.known.begin(), field.known.end(), 0) != field.known.end();
    std::optional<Live> other;
    std::shared_ptr<const Roadmap> next;
    if (!follows) {
      next = built_in_batch(lap, report);
    } else if (report.in_batch) {
      other = remade();
      next = built_on(*other, lap, report);
    } else {
      update_distances(field);
      next = built_on(*now, lap, report);
    }
    const std::lock_guard lock(mutex);
    snapshot = std::move(next);
    ++version;
    if (other) now = std::move(other);
  }

  /// A map without blocks.
  Live nothing(const VoxelIndex& origin) const {
    return {LiveField(config.fusion.voxel_size, origin, detail::distances_config(config.build)),
            {.radius = config.build.min_clearance, .config = detail::ridges_of(config.build)}};
  }

  /// The same map in fields of their own, to which it is one change.
  Live remade() const {
    Live other = nothing(now->field.esdf.origin);
    apply_changes(other.field, all_of(map_of(now->field)));
    update_distances(other.field);
    update_ridges(other.ridges, other.field);
    return other;
  }

  /// The stages that follow once the distances are right.
  std::shared_ptr<const Roadmap> built_on(Live& live, Lap& lap, UpdateReport& report) const {
    BuildReport& build = report.build;
    const LiveField& field = live.field;
    report.changed_distances = field.changed.count();
    report.changed_blocks = field.changed.slots.size();
    build.allocated_voxels = field.esdf.layout.voxel_count();
    build.seconds.esdf = lap.seconds();
    update_ridges(live.ridges, field);
    build.traversable_voxels = live.ridges.traversable_count;
    build.gvd_voxels = live.ridges.gvd_count;
    build.edge_voxels = live.ridges.thick_count;
    build.seconds.gvd = lap.seconds();
    if (build.traversable_voxels == 0) return nullptr;
    BuildResult result;
    result.report = build;
    result.roadmap.esdf = field.esdf;
    result.roadmap.min_clearance = live.ridges.radius;
    VoxelMask edges = live.ridges.edges;
    report.copy_seconds = lap.seconds();
    const Progress none;
    detail::StageClock clock(none);
    detail::build_on_edges(live.ridges.traversable, std::move(edges), config.build, result, clock);
    build = result.report;
    return std::make_shared<const Roadmap>(std::move(result.roadmap));
  }

  /// Where unknown space is ignored, pockets of free space are filled: whether one is small enough
  /// may change from far away.
  std::shared_ptr<const Roadmap> built_in_batch(Lap& lap, UpdateReport& report) const {
    BuildResult result;
    result.roadmap.esdf = detail::distances_of(map_of(now->field), config.build);
    result.roadmap.min_clearance = config.build.min_clearance;
    const EsdfMap& esdf = result.roadmap.esdf;
    VoxelMask traversable = traversable_voxels(esdf, config.build.min_clearance);
    result.report.traversable_voxels = traversable.count();
    result.report.allocated_voxels = esdf.layout.voxel_count();
    result.report.seconds.esdf = lap.seconds();
    const Progress none;
    detail::StageClock clock(none);
    const bool has_any = result.report.traversable_voxels > 0;
    if (has_any) detail::build_on_distances(std::move(traversable), config.build, result, clock);
    report.build = result.report;
    return has_any ? std::make_shared<const Roadmap>(std::move(result.roadmap)) : nullptr;
  }
};

LiveRoadmap::LiveRoadmap(const LiveConfig& config) : state_(std::make_unique<State>(config)) {}
LiveRoadmap::~LiveRoadmap() = default;
LiveRoadmap::LiveRoadmap(LiveRoadmap&&) noexcept = default;
LiveRoadmap& LiveRoadmap::operator=(LiveRoadmap&&) noexcept = default;

UpdateReport LiveRoadmap::integrate(const DepthImage& image, const PinholeCamera& camera,
                                    const Eigen::Isometry3d& T_world_camera) {
  return state_->integrate(T_world_camera.translation(),
                           [&] { state_->fusion.integrate(image, camera, T_world_camera); });
}

UpdateReport LiveRoadmap::integrate(std::span<const Point> points,
                                    const Eigen::Isometry3d& T_world_sensor) {
  return state_->integrate(T_world_sensor.translation(),
                           [&] { state_->fusion.integrate(points, T_world_sensor); });
}

UpdateReport LiveRoadmap::set_voxels(std::span<const VoxelChange> changes) {
  State& s = *state_;
  validate_changes(changes,
                   s.now ? s.now->field.esdf.origin : s.config.origin.value_or(VoxelIndex{}));
  UpdateReport report;
  s.update(changes, {}, report);
  return report;
}

std::shared_ptr<const Roadmap> LiveRoadmap::snapshot() const {
  const std::lock_guard lock(state_->mutex);
  return state_->snapshot;
}

OccupancyMap LiveRoadmap::map() const {
  const State& s = *state_;
  if (s.now) return map_of(s.now->field);
  OccupancyMap map;
  map.voxel_size = s.config.fusion.voxel_size;
  map.origin = s.config.origin.value_or(VoxelIndex{});
  return map;
}

}  // namespace ridgeway
