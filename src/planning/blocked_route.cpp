// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/blocked_route.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/name_table.hpp"
#include "query.hpp"

namespace ridgeway {
namespace {

constexpr std::array kFaces{4, 10, 12, 14, 16, 22};  // directions of the neighbours across them

/// The voxels that face moves over what is not occupied join with one, and whether they reach what
/// is not allocated, which is all one: unknown.
struct NotSolid {
  VoxelMask voxels;
  bool outside = false;
};

NotSolid flood_not_solid(const EsdfMap& esdf, VoxelId from) {
  const BlockLayout& layout = esdf.layout;
  NotSolid reached{VoxelMask(layout)};
  std::vector<VoxelId> open;
  const auto reach = [&](VoxelId id) {
    if (esdf.state[id] == VoxelState::kOccupied || reached.voxels.test(id)) return;
    reached.voxels.set(id);
    open.push_back(id);
  };
  const auto has_absent_neighbour = [&](VoxelId id) {
    return std::any_of(kFaces.begin(), kFaces.end(),
                       [&](int d) { return layout.neighbour(id, d) == kNoVoxel; });
  };
  for (reach(from); !open.empty();) {
    const VoxelId id = open.back();
    open.pop_back();
    bool leaves = false;
    for (const int d : kFaces) {
      const VoxelId next = layout.neighbour(id, d);
      leaves |= next == kNoVoxel;
      if (next != kNoVoxel) reach(next);
    }
    if (!leaves || reached.outside) continue;
    reached.outside = true;
    for (VoxelId other = 0; other < layout.voxel_count(); ++other)
      if (has_absent_neighbour(other)) reach(other);
  }
  return reached;
}

/// The first unknown voxel beside the free space around a voxel, by the number of face moves, from
/// which another place can be reached.
std::optional<VoxelIndex> nearest_gate(const EsdfMap& esdf, VoxelId from, const NotSolid& beyond) {
  const BlockLayout& layout = esdf.layout;
  VoxelMask seen(layout);
  std::vector<VoxelId> queue{from};
  seen.set(from);
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const int d : kFaces) {
      const VoxelId next = layout.neighbour(queue[i], d);
      const bool is_unknown = next == kNoVoxel || esdf.state[next] == VoxelState::kUnknown;
      if (is_unknown) {
        if (next == kNoVoxel ? beyond.outside : beyond.voxels.test(next))
          return layout.index_of(queue[i]) + offset_of(d);
      } else if (esdf.state[next] == VoxelState::kFree && !seen.test(next)) {
        seen.set(next);
        queue.push_back(next);
      }
    }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(Blocker blocker) {
  constexpr std::array<std::string_view, 3> kNames{"obstacle", "unknown", "limits"};
  return name_in(kNames, blocker);
}

RouteBlocks::RouteBlocks(const Roadmap& roadmap)
    : esdf_(roadmap.esdf), parts_(roadmap.esdf, false), around_(roadmap.esdf) {}

std::optional<BlockedRoute> RouteBlocks::between(const Point& start, const Point& goal,
                                                 double radius,
                                                 const FlightLimits& limits_world) const {
  const FlightLimits limits = detail::limits_of(esdf_, limits_world);
  const detail::QueryEnds ends =
      detail::find_ends(FreeSpace(esdf_, limits), detail::place_in_local(esdf_, start, radius),
                        detail::place_in_local(esdf_, goal, radius), radius);
  if (ends.status != PlanStatus::kOk) return std::nullopt;
  BlockedRoute blocked;
  const ComponentReport report = parts_.report(radius, {ends.from, ends.to});
  blocked.start_number = report.asked[0];
  blocked.goal_number = report.asked[1];
  blocked.start_component = report.components[blocked.start_number];
  blocked.goal_component = report.components[blocked.goal_number];
  if (limits.any() && blocked.start_number == blocked.goal_number) {
    blocked.by = Blocker::kLimits;
    return blocked;
  }
  const auto place_of = [&](const VoxelIndex& voxel) {
    return to_world(esdf_, centre_of(voxel, esdf_.voxel_size));
  };
  if (const std::optional<Pass> narrow = parts_.narrowest_move(ends.from, ends.to)) {
    blocked.radius = narrow->clearance.metres(esdf_.voxel_size);
    VoxelId from = narrow->from, to = narrow->to;
    const VoxelId lower = esdf_.squared[from] <= esdf_.squared[to] ? from : to;
    if (esdf_.squared[lower] <= narrow->clearance) from = to = lower;  // else it dips on the way
    const std::array<Point, 2> move{place_of(esdf_.layout.index_of(from)),
                                    place_of(esdf_.layout.index_of(to))};
    blocked.place = 0.5 * (move[0] + move[1]);
    const PathSurroundings around = around_.along(move, radius);
    const bool is_known =
        esdf_.unknown == UnknownPolicy::kIgnore || around.known <= around.unknown * (1.0 + 1e-9);
    blocked.by = is_known ? Blocker::kObstacle : Blocker::kUnknown;
    return blocked;
  }
  const NotSolid beyond = flood_not_solid(esdf_, ends.to);
  if (const auto gate = nearest_gate(esdf_, ends.from, beyond)) {
    blocked.place = place_of(*gate);
    blocked.by = Blocker::kUnknown;
  }
  return blocked;
}

}  // namespace ridgeway
