// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "offline_tour.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <queue>

#include "common/clock.hpp"
#include "exploration/legs.hpp"
#include "exploration/ray_walk.hpp"
#include "exploration/views.hpp"
#include "exploration/ways.hpp"
#include "planning/endpoint.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway {
namespace {

constexpr double kBetweenStops = 0.8;          // metres between viewpoints
constexpr int kOfflineHeadings = 8;            // at each
constexpr std::size_t kOfflineTargets = 8000;  // voxels that stand for all that can be seen
constexpr double kEnough = 0.98;               // of them in view of the stops
constexpr double kKnown = 0.9;                 // of what a stop has in view: it is left out
constexpr double kOrderPeriod = 1.0;           // seconds
constexpr int kRounds = 5000;                  // of moves that make the tour shorter
constexpr double kFarOff = 1.5;  // seconds to a stop until which what follows can wait

/// A viewpoint with what it has in view.
struct Candidate {
  std::size_t place = 0;
  int heading = 0;
  std::vector<std::uint32_t> targets;
  std::size_t gain = 0;  ///< of them, when it was last asked
};

std::size_t gain_of(const Candidate& candidate, const std::vector<bool>& is_seen) {
  return static_cast<std::size_t>(
      std::count_if(candidate.targets.begin(), candidate.targets.end(),
                    [&](std::uint32_t target) { return !is_seen[target]; }));
}

/// What every place has in view at every heading. Local frame.
std::vector<Candidate> look_from(const EsdfMap& esdf, const std::vector<detail::Place>& places,
                                 const detail::Views& views,
                                 const std::vector<VoxelIndex>& targets) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<Candidate> of_heading(kOfflineHeadings);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      std::uint32_t headings =
          views.headings_to(places[i].position, centre_of(targets[t], esdf.voxel_size));
      if (headings == 0 || !detail::sees(esdf, places[i].position, targets[t])) continue;
      if (headings == ~0u) headings = 1;  // all around: one is as good as another
      for (; headings != 0; headings &= headings - 1)
        of_heading[static_cast<std::size_t>(std::countr_zero(headings))].targets.push_back(
            static_cast<std::uint32_t>(t));
    }
    for (int heading = 0; heading < kOfflineHeadings; ++heading) {
      Candidate& candidate = of_heading[static_cast<std::size_t>(heading)];
      if (candidate.targets.empty()) continue;
      candidate.place = i;
      candidate.heading = heading;
      candidate.gain = candidate.targets.size();
      candidates.push_back(std::move(candidate));
    }
  }
  return candidates;
}

detail::Access access_at(const Roadmap& roadmap, const Point& local) {
  const detail::Endpoint end =
      detail::find_endpoint(FreeSpace(roadmap.esdf), local, roadmap.min_clearance);
  return end.voxel == kNoVoxel ? detail::Access{} : detail::access_of(roadmap, end.voxel);
}

Roadmap roadmap_of(const World& world, double voxel_size, const VoxelRange& within, double radius,
                   double max_distance) {
  const auto corner = [&](const VoxelIndex& v) -> Point {
    return Point(v.x, v.y, v.z) * voxel_size;
  };
  OccupancyMap map = occupancy_of(world, voxel_size,
                                  {corner(within.min), corner(within.max + VoxelIndex{1, 1, 1})});
  return build_roadmap(std::move(map),
                       {.min_clearance = radius, .max_distance = max_distance, .tangent_pairs = 0})
      .roadmap;
}

}  // namespace

OfflineTour::OfflineTour(const World& world, double voxel_size, const VoxelRange& within,
                         double radius, double max_distance, const Point& start,
                         const FieldOfView& view, const MotionLimits& limits,
                         const ViewableVolume& viewable)
    : world_(roadmap_of(world, voxel_size, within, radius, max_distance)), limits_(limits) {
  choose_stops(view, start, viewable.some(kOfflineTargets));
  const EsdfMap& esdf = world_.esdf;
  std::vector<detail::Access> access;
  for (const Stop& stop : stops_)
    access.push_back(access_at(world_, to_local(esdf, stop.view.position)));
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const detail::WaysFrom ways(world_, to_local(esdf, stops_[i].view.position), access[i]);
    std::vector<double> row;
    for (std::size_t j = 0; j < stops_.size(); ++j)
      row.push_back(detail::seconds_of_leg(
          limits_, ways.to(to_local(esdf, stops_[j].view.position), access[j]),
          detail::turn_between(stops_[i].view.yaw, stops_[j].view.yaw)));
    between_.push_back(std::move(row));
  }
}

void OfflineTour::choose_stops(const FieldOfView& view, const Point& start,
                               const std::vector<VoxelIndex>& targets) {
  const EsdfMap& esdf = world_.esdf;
  std::vector<VoxelIndex> local;
  local.reserve(targets.size());
  for (const VoxelIndex& target : targets) local.push_back(target - esdf.origin);
  detail::DiagramPlaces diagram(kBetweenStops);
  diagram.update(world_);
  const detail::WaysFrom ways(world_, to_local(esdf, start),
                              access_at(world_, to_local(esdf, start)));
  std::vector<detail::Place> places = diagram.places();
  std::erase_if(places, [&](const detail::Place& place) {
    return !std::isfinite(
        ways.to(place.position, detail::access_of(world_, esdf.layout.find(place.voxel))));
  });
  const detail::Views views(view, kOfflineHeadings, kAllVoxels, 0.0);
  std::vector<Candidate> candidates = look_from(esdf, places, views, local);
  const auto is_worse = [&](std::size_t a, std::size_t b) {
    return candidates[a].gain != candidates[b].gain ? candidates[a].gain < candidates[b].gain
                                                    : a > b;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(is_worse)> queue(is_worse);
  for (std::size_t i = 0; i < candidates.size(); ++i) queue.push(i);
  std::vector<bool> is_seen(targets.size());
  std::size_t seen = 0;
  const auto enough = static_cast<std::size_t>(kEnough * static_cast<double>(targets.size()));
  while (!queue.empty() && seen < enough) {
    const std::size_t top = queue.top();
    queue.pop();
    Candidate& candidate = candidates[top];
    const std::size_t gain = gain_of(candidate, is_seen);
    if (gain == 0) continue;
    if (gain < candidate.gain) {
      candidate.gain = gain;
      queue.push(top);
      continue;
    }
    Stop stop;
    stop.view = {to_world(esdf, places[candidate.place].position), views.yaw_of(candidate.heading)};
    for (const std::uint32_t target : candidate.targets)
      if (!is_seen[target]) {
        is_seen[target] = true;
        stop.seen.push_back(targets[target]);
      }
    seen += stop.seen.size();
    stops_.push_back(std::move(stop));
  }
}

void OfflineTour::leave_out_known(const Roadmap& now) {
  const EsdfMap& esdf = now.esdf;
  for (Stop& stop : stops_) {
    if (stop.is_done) continue;
    std::size_t known = 0;
    for (const VoxelIndex& voxel : stop.seen) {
      const VoxelId id = esdf.layout.find(voxel - esdf.origin);
      known += id != kNoVoxel && esdf.state[id] != VoxelState::kUnknown;
    }
    stop.is_done = static_cast<double>(known) >= kKnown * static_cast<double>(stop.seen.size());
  }
}

/// The stops that are left, in the order of the shortest tour from where the robot is.
std::vector<std::size_t> OfflineTour::order(const FlightState& state) const {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < stops_.size(); ++i)
    if (!stops_[i].is_done) left.push_back(i);
  const EsdfMap& esdf = world_.esdf;
  const Point here = to_local(esdf, state.position);
  const detail::WaysFrom ways(world_, here, access_at(world_, here));
  detail::TourCosts costs;
  for (const std::size_t i : left) {
    const Point place = to_local(esdf, stops_[i].view.position);
    costs.first.push_back(
        detail::seconds_of_leg(limits_, ways.to(place, access_at(world_, place)),
                               detail::turn_between(state.yaw, stops_[i].view.yaw)));
    std::vector<double> row;
    row.reserve(left.size());
    for (const std::size_t j : left) row.push_back(between_[i][j]);
    costs.between.push_back(std::move(row));
  }
  std::vector<std::size_t> tour = detail::best_tour(costs, kRounds);
  for (std::size_t& stop : tour) stop = left[stop];
  return tour;
}

ExplorationStep OfflineTour::decide(const Roadmap& now, const FlightState& state) {
  ExplorationStep step;
  const double began = detail::thread_seconds_now();
  const bool at_rest = state.time >= busy_until_ - 1e-9;
  if (has_goal_ && state.time >= passed_at_ - 1e-9) stops_[goal_].is_done = true;
  leave_out_known(now);
  const bool is_due =
      !has_goal_ || stops_[goal_].is_done || state.time >= last_order_ + kOrderPeriod;
  if (!is_due) return step;
  last_order_ = state.time;
  const std::vector<std::size_t> tour = order(state);
  step.seconds.total = detail::thread_seconds_now() - began;
  if (tour.empty()) {
    if (at_rest) step.status = ExplorationStatus::kComplete;
    return step;
  }
  const bool is_kept = has_goal_ && tour[0] == goal_ && passed_at_ > state.time + kFarOff;
  if (is_kept) return step;
  FlightState from = state;
  if (at_rest) from.velocity = from.acceleration = Point::Zero();
  std::vector<Viewpoint> stops;
  stops.reserve(tour.size());
  for (const std::size_t i : tour) stops.push_back(stops_[i].view);
  if (auto passing = detail::fly_past(world_, limits_, stops, from, kBetweenStops)) {
    passed_at_ = state.time + passing->time;
    step.trajectory = std::move(passing->trajectory);
  } else if (auto halting = detail::fly_to_rest(world_, limits_, stops[0], from)) {
    passed_at_ = state.time + halting->duration();
    step.trajectory = std::move(*halting);
  } else {
    if (at_rest) stops_[tour[0]].is_done = true;  // no trajectory leads there
    has_goal_ = false;
    return step;
  }
  goal_ = tour[0];
  has_goal_ = true;
  busy_until_ = state.time + step.trajectory.duration();
  step.status = ExplorationStatus::kFly;
  step.seconds.total = detail::thread_seconds_now() - began;
  return step;
}

}  // namespace ridgeway
