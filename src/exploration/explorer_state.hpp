// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ridgeway/exploration/explorer.hpp"
#include "tour.hpp"
#include "views.hpp"
#include "ways.hpp"

namespace ridgeway {

struct Explorer::State {
  explicit State(const ExplorerConfig& given);

  /// A goal that was decided on.
  struct Goal {
    detail::Place place;
    int heading = 0;
    double promised = 0.0;  ///< what was to be seen from there, as Stop::gain
    /// When it is passed in flight, seconds of the state's clock; else the robot stops there.
    double passed_at = std::numeric_limits<double>::infinity();
    std::uint64_t next = 0;  ///< the place after it that the trajectory leads to, if it is passed
  };
  /// A stop of the tour with what it costs.
  struct TourStop {
    detail::Stop stop;
    detail::Access access;
    double from_robot = 0.0;  ///< metres
    /// Unknown voxels that are expected to be measured there, and at no stop chosen before.
    double expected = 0.0;
  };

  ExplorationStep decide(std::shared_ptr<const Roadmap> now, const FlightState& given);

  const ExplorerConfig config;
  Frontiers frontiers;
  detail::DiagramPlaces diagram;
  detail::Views views;
  std::vector<detail::Place> places;  ///< that views are of
  std::shared_ptr<const Roadmap> roadmap;
  std::optional<Goal> goal;
  std::map<VoxelIndex, int> looks;                 ///< in vain, by unknown voxel
  std::optional<std::pair<Point, int>> last_look;  ///< in flight: where, and the heading
  std::vector<std::uint64_t> refused;              ///< places that no trajectory led to
  std::vector<std::uint64_t> late;                 ///< places from which home would be reached late
  std::set<std::pair<std::uint64_t, int>>
      passed;         ///< places and headings that were passed in flight
  Trajectory flying;  ///< world
  // Seconds of the state's clock.
  double flying_since = -std::numeric_limits<double>::infinity();
  double room_at_first = 0.0;  ///< metres from obstacles where it began, as that was known
  double out_after = 0.0;      ///< seconds after which it has left a place where it did not fit
  double asked_last = -std::numeric_limits<double>::infinity();
  double longest_gap;  ///< between two decisions, as far as is known
  double last_way_home = -std::numeric_limits<double>::infinity();
  double last_tour = -std::numeric_limits<double>::infinity();
  /// At rest, and not done yet with what was begun: it goes on with the next scan.
  bool is_searching = false;
  int thorough_looks = 0;  ///< in a row, so far: at all there is, from everywhere
  bool is_returning = false;
  bool is_out_of_time = false;
  /// The thorough look led to no flight, as the robot has no way or no trajectory to anywhere.
  bool leads_nowhere = false;
  bool has_seen_all = false;  ///< no viewpoint sees anything, by the thorough look

 private:
  void follow_origin(const VoxelIndex& by);
  bool look_around(const Point& here, bool thorough);
  void count_looks(const Point& from, int heading, double share, int weight,
                   const detail::Place* standing);
  void look_on_the_way(Trajectory& trajectory, double until) const;
  void look_in_flight(const FlightState& state);
  /// Which stops count; none given: all.
  using MayStop = std::function<bool(const TourStop&)>;
  std::vector<TourStop> cover(const detail::WaysFrom& ways, double least_gain, bool with_refused,
                              const MayStop& may_stop = {}) const;
  bool is_set_aside(const detail::Place& place) const;
  double expected_at(const detail::Stop& stop) const;
  void keep_best(std::vector<TourStop>& stops, const FlightState& state) const;
  std::vector<std::size_t> order(const std::vector<TourStop>& stops, const FlightState& state,
                                 double& seconds) const;
  void refine_first(std::vector<TourStop>& stops, const std::vector<std::size_t>& tour,
                    const FlightState& state, const detail::WaysFrom& ways) const;
  double seconds_from_robot(const TourStop& stop, const FlightState& state) const;
  MayStop home_in_time(const FlightState& state) const;
  bool fly_to(const Point& goal_local, double yaw, const FlightState& state,
              ExplorationStep& step) const;
  void go_home(const FlightState& state, bool arrived, ExplorationStep& step);
  bool leaves_time_for_home(const FlightState& state, const Trajectory& trajectory,
                            ExplorationStep& step) const;
  double kept_clearance() const;
  void take_off(Trajectory trajectory, double time);
  bool is_in_doubt(const FlightState& state) const;
  bool brake(const FlightState& state, ExplorationStep& step) const;
  Point ahead(double seconds, double length) const;
  void go_on(const FlightState& state, bool arrived, ExplorationStep& step);
  bool choose(const FlightState& state, bool thorough, ExplorationStep& step);
  bool fly_tour(const std::vector<TourStop>& stops, const std::vector<std::size_t>& tour,
                const FlightState& state, ExplorationStep& step);
  detail::Access access_at(const Point& local) const;
};

}  // namespace ridgeway
