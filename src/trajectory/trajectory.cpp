// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/trajectory/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "common/require.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

TrajectoryState state_of(const TrajectorySegment& segment, double t, double time) {
  const Eigen::Vector4d value = segment.derivative(0, t), rate = segment.derivative(1, t);
  return {time,      value.head<3>(), rate.head<3>(), segment.derivative(2, t).head<3>(),
          value.w(), rate.w()};
}

}  // namespace

Eigen::Vector4d TrajectorySegment::derivative(int order, double t) const {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  for (int k = kCoefficients - 1; k >= order; --k) {
    double factor = 1.0;
    for (int i = 0; i < order; ++i) factor *= k - i;
    value = value * t + factor * coefficients.col(k);
  }
  return value;
}

double Trajectory::duration() const {
  double sum = 0.0;
  for (const TrajectorySegment& segment : segments) sum += segment.duration;
  return sum;
}

TrajectoryState Trajectory::at(double time) const {
  if (segments.empty())
    throw InputError("trajectory", "has no segments", "ask one of a result that is ok()");
  double begin = 0.0;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    if (time < begin + segments[i].duration)
      return state_of(segments[i], std::max(time - begin, 0.0), time);
    begin += segments[i].duration;
  }
  const TrajectorySegment& last = segments.back();
  return state_of(last, std::clamp(time - begin, 0.0, last.duration), time);
}

std::vector<TrajectoryState> Trajectory::sample(double step) const {
  constexpr double kMostStates = 1e7;
  detail::require(step > 0.0 && std::isfinite(step), "step", step, "give seconds, above 0");
  std::vector<TrajectoryState> states;
  if (segments.empty()) return states;
  const double end = duration();
  detail::require(end <= kMostStates * step, "step", step,
                  "give a larger one: ten million states are the most");
  std::size_t i = 0;
  double begin = 0.0;
  for (std::size_t k = 0;; ++k) {
    const double time = std::min(static_cast<double>(k) * step, end);
    while (i + 1 < segments.size() && time >= begin + segments[i].duration)
      begin += segments[i++].duration;
    const double t = std::clamp(time - begin, 0.0, segments[i].duration);
    states.push_back(state_of(segments[i], t, time));
    if (time >= end) return states;
  }
}

}  // namespace ridgeway
