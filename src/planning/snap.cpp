// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "snap.hpp"

#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "endpoint.hpp"
#include "places_around.hpp"

namespace ridgeway::detail {
namespace {

/// Where an end of a query may be moved to: itself where it can be used, else places around it, the
/// nearest of each part of space there.
class EndPlaces {
 public:
  EndPlaces(const FreeSpace& space, const Point& end, double radius, double snap)
      : space_(space),
        end_(end),
        radius_(radius),
        snap_(snap),
        threshold_(least_clearance(space.inner_radius(radius), space.map().voxel_size)),
        stays_(find_endpoint(space, end, radius).status == EndpointStatus::kOk),
        around_(space.map(), end, space.inner_radius(radius), snap) {}

  /// Of the next part; nothing where there are no more, or time is up.
  std::optional<Point> next(const Deadline& deadline) {
    if (tried_ != kNoVoxel && !flood(std::exchange(tried_, kNoVoxel), deadline))  // of no use
      return std::nullopt;
    if (stays_) return std::exchange(is_given_, true) ? std::nullopt : std::optional(end_);
    if (!is_given_) {
      is_given_ = true;
      if (has_voxel(end_, space_.map().voxel_size)) {
        const VoxelIndex own = voxel_at(end_, space_.map().voxel_size);
        if (auto place = use(own)) return place;  // too near to walls but for its middle
      }
    }
    while (const std::optional<Point> place = around_.next(deadline))
      if (auto used = use(voxel_at(*place, space_.map().voxel_size))) return used;
    return std::nullopt;
  }

 private:
  std::optional<Point> use(const VoxelIndex& voxel) {
    const VoxelId id = space_.map().layout.find(voxel);
    if (id == kNoVoxel || seen_.contains(id) || !is_place(id)) return std::nullopt;
    tried_ = id;
    return centre_of(voxel, space_.map().voxel_size);
  }

  bool is_place(VoxelId id) const {
    const EsdfMap& esdf = space_.map();
    const Point centre = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
    return esdf.is_open(id) && esdf.squared[id] >= threshold_ && space_.is_within_limits(id) &&
           (centre - end_).norm() <= snap_ && space_.is_free(centre, radius_);
  }

  /// All places around that moves join with one are as good, or as bad. False where time is up.
  bool flood(VoxelId from, const Deadline& deadline) {
    std::vector<VoxelId> open{from};
    seen_.insert(from);
    for (int step = 0; !open.empty(); ++step) {
      if (deadline.has_passed(step)) return false;
      const VoxelId here = open.back();
      open.pop_back();
      for (int d = 0; d < 27; ++d) {
        const VoxelId next = space_.map().layout.neighbour(here, d);
        if (d == kCentre || next == kNoVoxel || seen_.contains(next) || !is_place(next) ||
            !space_.move_is_free(here, next, d, threshold_))
          continue;
        seen_.insert(next);
        open.push_back(next);
      }
    }
    return true;
  }

  const FreeSpace& space_;
  const Point end_;
  const double radius_, snap_;
  const SquaredHalves threshold_;
  const bool stays_;
  bool is_given_ = false;
  VoxelId tried_ = kNoVoxel;  // the last place given
  PlacesAround around_;
  std::unordered_set<VoxelId> seen_;
};

}  // namespace

bool is_refused(PlanStatus status) {
  switch (status) {
    case PlanStatus::kOk:
    case PlanStatus::kNoRoute:
    case PlanStatus::kRadiusTooSmall:
    case PlanStatus::kTimeout:
      return false;
    default:
      return true;
  }
}

PlanResult plan_snapped(const FreeSpace& space, const Point& start, const Point& goal,
                        double radius, double snap, const PlanBetween& plan_between,
                        const PlanResult& refused, const Deadline& deadline) {
  std::optional<PlanResult> first;
  const auto describe_move = [](const Point& from, const Point& to) {
    return from == to ? Moved{} : Moved{(to - from).norm(), to};
  };
  EndPlaces starts(space, start, radius, snap);
  while (const std::optional<Point> from = starts.next(deadline)) {
    EndPlaces goals(space, goal, radius, snap);
    while (const std::optional<Point> to = goals.next(deadline)) {
      PlanResult result = plan_between(*from, *to);
      result.moved_start = describe_move(start, *from);
      result.moved_goal = describe_move(goal, *to);
      if (result.status != PlanStatus::kNoRoute) return result;
      if (!first) first = std::move(result);
    }
  }
  PlanResult result = first ? *std::move(first) : refused;
  if (deadline.has_passed()) result.status = PlanStatus::kTimeout;
  return result;
}

}  // namespace ridgeway::detail
