// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <utility>

#include "kept_parts.hpp"
#include "live_state.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "roadmap/build_stages.hpp"

namespace ridgeway {
namespace {

using detail::LiveField;

std::vector<VoxelChange> all_of(const OccupancyMap& map) {
  std::vector<VoxelChange> changes;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] != VoxelState::kUnknown)
      changes.push_back({map.origin + map.layout.index_of(id), map.state[id]});
  return changes;
}

/// Some blocks, and those that came with the last update.
std::vector<std::uint32_t> with_added(std::vector<std::uint32_t> slots, const LiveField& field) {
  for (std::uint32_t slot = field.first_of_last; slot < field.esdf.layout.block_count(); ++slot)
    slots.push_back(slot);
  return slots;
}

/// What a report counts of a build of some parts, with those that were kept.
void count_all_parts(const std::vector<VoxelId>& peaks, const detail::BuildMemory& memory,
                     BuildResult& result) {
  result.report.traversable_components = 0;
  for (std::size_t basin = 0; basin < peaks.size(); ++basin)
    if (peaks[basin] != kNoVoxel) result.report.traversable_components += memory.is_highest[basin];
  result.report.graph_components = connected_components(result.roadmap.graph).count;
}

}  // namespace

bool LiveRoadmap::State::has_snapshot() const {
  const std::lock_guard lock(mutex);
  return snapshot != nullptr;
}

void LiveRoadmap::State::update(std::span<const VoxelChange> changes,
                                const std::optional<VoxelIndex>& first, UpdateReport& report) {
  detail::Lap all;
  report.waiting_voxels = window.size();
  if (!now && !first && changes.empty()) return;  // nothing says yet where the map begins
  if (now && is_stale) {
    now = remade();
    is_stale = false;
  }
  const bool is_first = !now;
  if (is_first) now = nothing(config.origin.value_or(first.value_or(VoxelIndex{})), true);
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
  report.has_roadmap = has_snapshot();
  report.waiting_voxels = window.size();
  report.seconds = report.fusion_seconds + all.seconds();
}

void LiveRoadmap::State::bring_up_to_date(std::span<const VoxelChange> changes,
                                          UpdateReport& report) {
  detail::Lap lap;
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
  const bool has_empty = std::find(field.known.begin(), field.known.end(), 0) != field.known.end();
  report.in_batch = !follows || has_empty;
  std::optional<Live> other;
  std::shared_ptr<const Roadmap> next;
  if (!follows) {
    next = built_in_batch(lap, report);
    if (has_empty) {
      other = nothing(field.esdf.origin, field.esdf.site.has_near_only());
      apply_changes(other->field, all_of(map_of(field)));
    }
  } else if (report.in_batch) {
    other = remade();
    next = built_on(*other, lap, report);
  } else {
    update_distances(field);
    if (field.is_outgrown) {
      report.in_batch = true;
      drop_distances(field);
      other = remade();
    }
    next = built_on(other ? *other : *now, lap, report);
  }
  {
    const std::lock_guard lock(mutex);
    snapshot.swap(next);
    ++version;
  }
  next.reset();  // may free the last snapshot, which takes long: planners need not wait for that
  if (other) now = std::move(other);
  now->memory->segments.forget_unasked();
  constexpr std::size_t kUsual = 50'000;  // changes of an update
  if (now->field.before.capacity() > kUsual) decltype(now->field.before)().swap(now->field.before);
}

/// A map without blocks.
LiveRoadmap::State::Live LiveRoadmap::State::nothing(const VoxelIndex& origin,
                                                     bool near_only) const {
  Live live{LiveField(config.fusion.voxel_size, origin, detail::distances_config(config.build),
                      near_only),
            {.radius = config.build.min_clearance, .config = detail::ridges_of(config.build)},
            {},
            {},
            nullptr};
  live.memory = std::make_unique<detail::BuildMemory>();
  return live;
}

/// The same map in fields of their own, to which it is one change.
LiveRoadmap::State::Live LiveRoadmap::State::remade() const {
  const auto with_distances = [&](bool near_only) {
    Live made = nothing(now->field.esdf.origin, near_only);
    apply_changes(made.field, all_of(map_of(now->field)));
    update_distances(made.field);
    return made;
  };
  const bool near_only = !now->field.is_outgrown && now->field.esdf.site.has_near_only();
  Live other = with_distances(near_only);
  if (other.field.is_outgrown) {
    other = nothing(now->field.esdf.origin, false);  // makes room
    other = with_distances(false);
  }
  update_traversable(other.ridges, other.field);
  update_edges(other.ridges, other.field);
  update_basins(other.basins, other.memory->basin, other.field, other.ridges);
  return other;
}

/// The stages that follow once the distances are right.
std::shared_ptr<const Roadmap> LiveRoadmap::State::built_on(Live& live, detail::Lap& lap,
                                                            UpdateReport& report) const {
  BuildReport& build = report.build;
  LiveField& field = live.field;
  report.changed_distances = field.changed.count();
  report.changed_blocks = field.changed.slots.size();
  build.allocated_voxels = field.esdf.layout.voxel_count();
  build.seconds.esdf = lap.seconds();
  update_traversable(live.ridges, field);
  build.traversable_voxels = live.ridges.traversable_count;
  build.seconds.gvd = lap.seconds();
  live.memory->segments.change(field.esdf.layout, with_added(field.changed.slots, field),
                               with_added(field.flipped.slots, field));
  live.memory->peeling.change(field.esdf.layout, field.changed.voxels, field.changed.slots);
  live.memory->diagram.change(field.esdf.layout, field.changed.voxels, field.changed.slots);
  if (build.traversable_voxels == 0) {
    live.is_built = false;
    update_edges(live.ridges, field);
    update_basins(live.basins, live.memory->basin, field, live.ridges);
    return nullptr;
  }
  BuildResult result;
  result.report = build;
  result.roadmap.esdf = share(field);
  result.roadmap.min_clearance = live.ridges.radius;
  report.copy_seconds = lap.seconds();
  const Progress none;
  detail::StageClock clock(none);
  const std::shared_ptr<const Roadmap> before = last_built_on(live);
  detail::TouchedSpace space;
  double edge_seconds = 0.0;
  const auto edges = [&] {
    detail::Lap own;
    update_edges(live.ridges, field);
    edge_seconds = own.seconds();
    return live.ridges.edges;
  };
  const auto watershed = [&] {
    space = touched_space_of(live, before != nullptr);
    live.memory->rest.reset();
    if (space.has_rest) live.memory->rest = {&live.ridges.traversable, &space.touched};
    return detail::Space{
        space.touched,
        watershed_of(live.basins, std::move(live.memory->basin),
                     ways_to_build_on(live.attach, field.esdf.layout, live.basins.ways.next,
                                      live.ridges.traversable, space),
                     field, space.touched)};
  };
  detail::build_on_watershed(edges, watershed, config.build, result, clock, live.memory.get());
  if (live.memory->rest) {
    live.diagram_voxels +=
        detail::add_kept_parts(*before, *live.memory->rest, field.changed.slots, result.roadmap);
    result.report.diagram_voxels = static_cast<std::size_t>(live.diagram_voxels);
    live.memory->rest.reset();
    count_all_parts(live.basins.peaks, *live.memory, result);
  }
  live.diagram_voxels = static_cast<std::ptrdiff_t>(result.report.diagram_voxels);
  BuildReport& built = result.report;
  built.gvd_voxels = live.ridges.gvd_count;
  built.edge_voxels = live.ridges.thick_count;
  built.seconds.gvd += edge_seconds;  // which are of the kernel's, that was peeled meanwhile
  built.seconds.kernel -= edge_seconds;
  result.roadmap.attach = share(live.attach, space, std::move(result.roadmap.attach));
  live.is_built = true;
  return published(std::move(result), build);
}

/// The last snapshot, if it was built on these; from now on it is not, until they are built on
/// again.
std::shared_ptr<const Roadmap> LiveRoadmap::State::last_built_on(Live& live) const {
  if (!std::exchange(live.is_built, false)) return nullptr;
  const std::lock_guard lock(mutex);
  return snapshot;
}

/// Brings the basins up to date, and finds what is to be built on.
detail::TouchedSpace LiveRoadmap::State::touched_space_of(Live& live, bool has_last) const {
  update_basins(live.basins, live.memory->basin, live.field, live.ridges);
  return has_last ? touched_space(live.basins, live.memory->basin, live.field, live.ridges,
                                  live.memory->segments)
                  : all_touched(live.field, live.ridges);
}

/// A roadmap that is complete but for what is learnt.
std::shared_ptr<const Roadmap> LiveRoadmap::State::published(BuildResult result,
                                                             BuildReport& report) const {
  result.report.seconds.total = result.report.seconds.sum();
  report = result.report;
  result.roadmap.is_settled = false;
  result.roadmap.source = config.source;
  result.roadmap.config = config.record;
  return std::make_shared<const Roadmap>(std::move(result.roadmap));
}

/// Where unknown space is ignored, pockets of free space are filled: whether one is small enough
/// may change from far away.
std::shared_ptr<const Roadmap> LiveRoadmap::State::built_in_batch(detail::Lap& lap,
                                                                  UpdateReport& report) const {
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
  if (result.report.traversable_voxels == 0) {
    report.build = result.report;
    return nullptr;
  }
  detail::build_on_distances(std::move(traversable), config.build, result, clock);
  return published(std::move(result), report.build);
}

/// The last snapshot with what is learnt. For any thread: what takes long is done without the
/// lock, on a snapshot that stays as it is.
std::shared_ptr<const Roadmap> LiveRoadmap::State::settled() {
  std::shared_ptr<const Roadmap> last = [&] {
    const std::lock_guard lock(mutex);
    return snapshot;
  }();
  if (!last || last->is_settled) return last;
  BuildResult result;
  result.roadmap = detail::in_same_memory(*last);
  const Progress none;
  detail::StageClock clock(none);
  detail::build_what_is_learnt(config.build, result, clock);
  auto all = std::make_shared<const Roadmap>(std::move(result.roadmap));
  const std::lock_guard lock(mutex);
  if (snapshot == last) snapshot = all;
  return all;
}

}  // namespace ridgeway
