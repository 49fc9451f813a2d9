// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "shaped_trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeway::detail {

TrajectorySegment tail_of(const TrajectorySegment& segment, double from) {
  TrajectorySegment tail;
  tail.duration = std::max(segment.duration - from, 0.0);
  double factorial = 1.0;
  for (int k = 0; k < kCoefficients; ++k) {
    if (k > 0) factorial *= k;
    tail.coefficients.col(k) = segment.derivative(k, from) / factorial;
  }
  return tail;
}

Trajectory tail_of(const Trajectory& trajectory, double from) {
  Trajectory tail;
  double begin = 0.0;
  for (const TrajectorySegment& segment : trajectory.segments) {
    const double end = begin + segment.duration;
    if (end > from) tail.segments.push_back(tail_of(segment, std::max(from - begin, 0.0)));
    begin = end;
  }
  if (tail.segments.empty() && !trajectory.segments.empty()) {
    const TrajectorySegment& last = trajectory.segments.back();
    TrajectorySegment stand;
    stand.coefficients.col(0) = last.derivative(0, last.duration);
    tail.segments.push_back(stand);
  }
  return tail;
}

Trajectory head_of(const Trajectory& trajectory, double until) {
  Trajectory head;
  double begin = 0.0;
  for (const TrajectorySegment& segment : trajectory.segments) {
    if (begin >= until) break;
    head.segments.push_back(segment);
    head.segments.back().duration = std::min(segment.duration, until - begin);
    begin += segment.duration;
  }
  return head;
}

/// Seconds: what is left of a duration that is no longer comes of rounding.
constexpr double kShortestMotion = 1e-9;

void turn_to(Trajectory& trajectory, double from_yaw, double to_yaw, double max_rate) {
  const double turn = turn_between(from_yaw, to_yaw);
  const double turning = std::abs(turn) / max_rate;
  const double rate = turn >= 0.0 ? max_rate : -max_rate;
  double begin = 0.0;
  std::vector<TrajectorySegment> pieces;
  const auto add = [&](TrajectorySegment piece, bool turns) {
    piece.coefficients.row(3).setZero();
    piece.coefficients(3, 0) = turns ? from_yaw + rate * begin : from_yaw + turn;
    if (turns) piece.coefficients(3, 1) = rate;
    begin += piece.duration;
    pieces.push_back(piece);
  };
  for (const TrajectorySegment& segment : trajectory.segments) {
    const double left = turning - begin;
    if (left <= kShortestMotion) {
      add(segment, false);
    } else if (segment.duration <= left) {
      add(segment, true);
    } else {
      TrajectorySegment head = segment;
      head.duration = left;
      add(head, true);
      add(tail_of(segment, left), false);
    }
  }
  if (begin < turning - kShortestMotion) {
    TrajectorySegment stand;
    if (!trajectory.segments.empty()) {
      const TrajectorySegment& last = trajectory.segments.back();
      stand.coefficients.col(0) = last.derivative(0, last.duration);
    }
    stand.duration = turning - begin;
    add(stand, true);
  }
  trajectory.segments = std::move(pieces);
}

void turn_by_way_of(Trajectory& trajectory, double yaw_between, double until, double max_rate) {
  const double from = trajectory.at(0.0).yaw, to = trajectory.at(until).yaw;
  const double between = from + turn_between(from, yaw_between);
  const double back = turn_between(between, to);
  const double leave = std::max(until - std::abs(back) / max_rate, 0.0);
  Trajectory result = head_of(trajectory, leave);
  turn_to(result, from, between, max_rate);
  Trajectory rest = tail_of(trajectory, leave);
  Trajectory turning = head_of(rest, until - leave), after;
  if (until < trajectory.duration()) after = tail_of(trajectory, until);
  turn_to(turning, between, to, max_rate);
  const double shift = between + back - to;  // whole turns
  for (TrajectorySegment& segment : after.segments) segment.coefficients(3, 0) += shift;
  for (const Trajectory* part : {&turning, &after})
    result.segments.insert(result.segments.end(), part->segments.begin(), part->segments.end());
  trajectory = std::move(result);
}

double turn_between(double from_yaw, double to_yaw) {
  return std::remainder(to_yaw - from_yaw, 2.0 * std::numbers::pi);
}

}  // namespace ridgeway::detail
