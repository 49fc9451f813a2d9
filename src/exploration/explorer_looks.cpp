// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "explorer_state.hpp"
#include "glances.hpp"
#include "ray_walk.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway {

using detail::Place;

/// Finds what is seen from where; false where rays do not suffice for all of it. Thorough looks in
/// a row have more of them each time, so that they come to an end whatever changes meanwhile.
bool Explorer::State::look_around(const Point& here, bool thorough) {
  diagram.update(*roadmap);
  places = diagram.places();
  if (thorough) {
    const std::vector<Place> more = detail::widest_places(*roadmap, config.spacing);
    places.insert(places.end(), more.begin(), more.end());
  }
  constexpr int kThorough = 3;  // times twice as many rays, at first
  thorough_looks = thorough ? thorough_looks + 1 : 0;
  const int doublings = thorough ? std::min(kThorough + thorough_looks, 30) : 0;
  const std::size_t most = std::numeric_limits<std::size_t>::max() >> doublings;
  const std::size_t rays = std::min(config.most_rays, most) << doublings;
  return views.update(*roadmap, frontiers, config.least_frontier, places, here, rays, thorough);
}

/// Unknown voxels that are in view from a place, within a share of the range, after what was seen
/// from there is in the map: looks in vain. After several of them a voxel is left alone.
void Explorer::State::count_looks(const Point& from, int heading, double share, int weight,
                                  const Place* standing) {
  const double s = roadmap->esdf.voxel_size;
  const double reach = share * config.view.range;
  std::vector<const FrontierPart*> near;
  for (const FrontierPart& part : frontiers.parts())
    if ((part.centroid - from).norm() <= reach + kBlockSide * s) near.push_back(&part);
  std::vector<std::vector<VoxelIndex>> seen(near.size());  // targets, by part
  parallel_for_each_index(near.size(), [&](std::size_t i) {
    for (const VoxelIndex& target : near[i]->targets) {
      const Point centre = centre_of(target, s);
      if ((centre - from).norm() <= reach &&
          (views.headings_to(from, centre) >> heading & 1) != 0 &&
          detail::sees(roadmap->esdf, from, target))
        seen[i].push_back(target);
    }
  });
  std::vector<VoxelIndex> hopeless;
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (const VoxelIndex& target : seen[i]) {
      int& count = looks[target];
      count += weight;
      if (count >= config.most_looks) hopeless.push_back(target);
    }
    if (!seen[i].empty() && standing != nullptr) views.ban(*standing, *near[i]);
  }
  if (hopeless.empty()) return;
  frontiers.ignore(hopeless);
  frontiers.update(roadmap);
}

/// Until it has to look as its next stop does, at a time, the robot may look elsewhere: that takes
/// no time of the flight.
void Explorer::State::look_on_the_way(Trajectory& trajectory, double until) const {
  const Trajectory local = to_local(roadmap->esdf, trajectory);
  const double from = trajectory.at(0.0).yaw, to = trajectory.at(until).yaw;
  const std::vector<detail::Glance> glances =
      detail::glances_along(local, until, views, places, config.spacing);
  if (const std::optional<double> yaw = detail::yaw_between(views, config.headings, glances, from,
                                                            to, until, config.motion.max_yaw_rate))
    detail::turn_by_way_of(trajectory, *yaw, until, config.motion.max_yaw_rate);
}

/// In flight a look counts where the robot is elsewhere, or turned, since the last one.
void Explorer::State::look_in_flight(const FlightState& state) {
  constexpr double kInRange = 0.6;  // of the range: from farther off little may be measured
  const int heading = views.heading_of(state.yaw);
  const Point here = to_local(roadmap->esdf, state.position);
  if (last_look && heading == last_look->second &&
      (here - last_look->first).norm() < 0.5 * config.spacing)
    return;
  last_look.emplace(here, heading);
  // At the heading next to the true one the sides of the view differ by half a step at most.
  if (std::abs(detail::turn_between(state.yaw, views.yaw_of(heading))) <
      0.25 * 2.0 * std::numbers::pi / config.headings)
    count_looks(here, heading, kInRange, 1, nullptr);
}

}  // namespace ridgeway
