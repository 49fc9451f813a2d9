// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/blocked_route.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "open_inside.hpp"
#include "query.hpp"

namespace ridgeway {
namespace {

/// The first unknown voxel beside the free space around a voxel, by the number of face moves, from
/// which another place can be reached.
std::optional<VoxelIndex> nearest_gate(const EsdfMap& esdf, VoxelId from,
                                       const detail::OpenInside& around_goal) {
  const BlockLayout& layout = esdf.layout;
  VoxelMask seen(layout);
  std::vector<VoxelId> queue{from};
  seen.set(from);
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const int d : detail::faces_of(esdf)) {
      const VoxelId next = layout.neighbour(queue[i], d);
      const bool is_unknown = next == kNoVoxel || esdf.state[next] == VoxelState::kUnknown;
      if (is_unknown) {
        const VoxelIndex gate = layout.index_of(queue[i]) + offset_of(d);
        if (around_goal.reaches(gate)) return gate;
      } else if (esdf.state[next] == VoxelState::kFree && !seen.test(next)) {
        seen.set(next);
        queue.push_back(next);
      }
    }
  return std::nullopt;
}

}  // namespace

RouteBlocks::RouteBlocks(const Roadmap& roadmap)
    : esdf_(roadmap.esdf), parts_(roadmap.esdf, false) {}

std::optional<BlockedRoute> RouteBlocks::between(const Point& start, const Point& goal,
                                                 double radius,
                                                 const FlightLimits& limits_world) const {
  PlanConfig{.radius = radius}.validate();
  detail::validate_query(esdf_, start, goal, radius);
  const FlightLimits limits = detail::limits_of(esdf_, limits_world);
  const detail::QueryEnds ends =
      detail::find_ends(FreeSpace(esdf_, limits), detail::place_in_local(esdf_, start, radius),
                        detail::place_in_local(esdf_, goal, radius), radius);
  if (ends.status != PlanStatus::kOk) return std::nullopt;
  BlockedRoute blocked;
  const ComponentReport report = parts_.parts(radius, {ends.from, ends.to});
  blocked.start_number = report.asked[0];
  blocked.goal_number = report.asked[1];
  blocked.start_component = report.components[blocked.start_number];
  blocked.goal_component = report.components[blocked.goal_number];
  if (has_flight_limits(esdf_, limits) && blocked.start_number == blocked.goal_number) {
    blocked.by = Blocker::kLimits;
    return blocked;
  }
  const auto place_of = [&](const VoxelIndex& voxel) {
    return to_world(esdf_, centre_of(voxel, esdf_.voxel_size));
  };
  if (const std::optional<Pass> narrow = parts_.narrowest_move(ends.from, ends.to)) {
    blocked.radius = narrow->clearance == SquaredHalves(kNoSite)
                         ? std::numeric_limits<double>::infinity()
                         : narrow->clearance.metres(esdf_.voxel_size);
    const SpaceParts::Narrow place = parts_.look_at(*narrow);
    blocked.place = place.place;
    blocked.by = place.by;
    return blocked;
  }
  if (esdf_.unknown == UnknownPolicy::kFree) return blocked;  // what is occupied encloses one
  const detail::OpenInside around_goal(esdf_, ends.to);
  if (const auto gate = nearest_gate(esdf_, ends.from, around_goal)) {
    blocked.place = place_of(*gate);
    blocked.by = Blocker::kUnknown;
    return blocked;
  }
  if (!around_goal.way_out()) return blocked;
  const detail::OpenInside around_start(esdf_, ends.from);
  if (around_start.way_out()) blocked.map_end = place_of(*around_start.way_out());
  return blocked;
}

PlaceFacts describe_place(const Roadmap& roadmap, const Point& point) {
  const EsdfMap& esdf = roadmap.esdf;
  const double radius = roadmap.min_clearance;
  detail::validate_query(esdf, point, point, radius);
  const FreeSpace space(esdf);
  PlaceFacts facts;
  const Point local = detail::place_in_local(esdf, point, radius);
  const detail::QueryEnds ends = detail::find_ends(space, local, local, radius);
  facts.status = ends.status;
  if (has_voxel(local, esdf.voxel_size)) {
    const VoxelId id = esdf.layout.find(voxel_at(local, esdf.voxel_size));
    if (id != kNoVoxel) facts.state = esdf.state[id];
    facts.clearance = space.distance(local);
  }
  const SpaceParts parts(esdf);
  const bool fits = facts.status == PlanStatus::kOk;
  facts.report = parts.report(radius, fits ? std::vector{ends.from} : std::vector<VoxelId>{});
  if (!fits) return facts;
  facts.component = facts.report.asked[0];
  // The joins are a forest, widest first: along it the narrowest join decides.
  std::vector<const ComponentJoin*> narrowest(facts.report.components.size());
  std::vector<std::size_t> reached{facts.component};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const ComponentJoin& join : facts.report.joins) {
      if (join.a != reached[i] && join.b != reached[i]) continue;
      const std::size_t other = join.a == reached[i] ? join.b : join.a;
      if (other == facts.component || narrowest[other] != nullptr) continue;
      const ComponentJoin* before = narrowest[reached[i]];
      narrowest[other] = before != nullptr && before->radius < join.radius ? before : &join;
      reached.push_back(other);
    }
  for (std::size_t other = 0; other < narrowest.size(); ++other)
    if (const ComponentJoin* join = narrowest[other])
      facts.ways.push_back({facts.component, other, join->radius, join->place, join->by});
  std::stable_sort(facts.ways.begin(), facts.ways.end(),
                   [](const auto& a, const auto& b) { return a.radius > b.radius; });
  return facts;
}

}  // namespace ridgeway
