// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "glances.hpp"

#include <cmath>

#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kGlanceStep = 0.25;      // seconds between places at which the robot looks
constexpr double kShortestGlance = 0.25;  // seconds that a look on the way takes at least
constexpr double kWorthATurn = 1.1;       // times what is seen else: less is not worth a turn
constexpr double kGlanceFading = 0.5;     // of a gain, where it is seen at the very end
constexpr double kGlanceRounding = 1e-9;

/// From one yaw to another by way of a third, as late from there as there is time for.
struct TwoTurns {
  double from = 0.0, between = 0.0, to = 0.0;
  double until = 0.0, rate = 0.0;

  double there() const { return std::abs(turn_between(from, between)) / rate; }
  double back() const { return std::abs(turn_between(between, to)) / rate; }
  bool is_in_time() const { return there() + kShortestGlance + back() <= until; }
  double yaw_at(double time) const {
    if (time < there() - kGlanceRounding)
      return from + std::copysign(rate * time, turn_between(from, between));
    if (time <= until - back() + kGlanceRounding) return between;
    return between + std::copysign(rate * (time - until + back()), turn_between(between, to));
  }
};

/// What is seen at the given headings, each voxel once.
template <typename HeadingAt>
double value_of(const Views& views, std::span<const Glance> glances, double until,
                const HeadingAt& heading_at) {
  std::vector<std::uint64_t> covered(views.parts(), 0);
  double value = 0.0;
  for (const Glance& glance : glances) {
    const int heading = heading_at(glance);
    const double weight = 1.0 - kGlanceFading * glance.time / until;
    value += weight * views.gain_at(glance.place, heading, covered);
    views.cover(glance.place, heading, covered);
  }
  return value;
}

}  // namespace

std::vector<Glance> glances_along(const Trajectory& trajectory, double until, const Views& views,
                                  std::span<const Place> places, double near) {
  std::vector<Glance> glances;
  for (double time = kGlanceStep; time <= until; time += kGlanceStep) {
    const TrajectoryState at = trajectory.at(time);
    double nearest = near * near;
    std::optional<std::size_t> passed;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const double d = (places[i].position - at.position).squaredNorm(); d < nearest) {
        nearest = d;
        passed = i;
      }
    if (passed) glances.push_back({time, *passed, views.heading_of(at.yaw)});
  }
  return glances;
}

std::optional<double> yaw_between(const Views& views, int headings, std::span<const Glance> glances,
                                  double from_yaw, double to_yaw, double until, double max_rate) {
  double best = kWorthATurn * value_of(views, glances, until,
                                       [](const Glance& glance) { return glance.heading; });
  std::optional<double> best_yaw;
  for (int heading = 0; heading < headings; ++heading) {
    const TwoTurns turns = {from_yaw, views.yaw_of(heading), to_yaw, until, max_rate};
    if (!turns.is_in_time()) continue;
    const double value = value_of(views, glances, until, [&](const Glance& glance) {
      return views.heading_of(turns.yaw_at(glance.time));
    });
    if (value <= best) continue;
    best = value;
    best_yaw = turns.between;
  }
  return best_yaw;
}

}  // namespace ridgeway::detail
