// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "initial_spline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway::detail {

/// The steps from a free path to a verified trajectory; reports into the result as it goes.
class SmoothPath {
 public:
  SmoothPath(const EsdfMap& esdf, const TrajectoryConfig& config, TrajectoryResult& result);

  /// False where a moving start can neither follow the path nor brake.
  bool run(const std::vector<Point>& path, const StartState& start);

 private:
  struct Attempt {
    Trajectory trajectory;
    std::optional<Point> doubt;  ///< where it is not shown to be free; nothing if it holds
    bool within_limits = false;
    bool holds() const { return within_limits && !doubt; }
  };

  std::optional<Trajectory> smooth(std::span<const Point> path, const StartState& start);
  std::optional<Trajectory> smooth_or_stop(std::span<const Point> path, const StartState& start);
  std::optional<Trajectory> brake(const StartState& start, const Point& from);
  Attempt optimise(SpaceSpline& spline, const SplineCostConfig& cost);
  Attempt verify(Trajectory trajectory, bool from_rest);
  Trajectory stop_and_go(std::span<const Point> path) const;
  void note(TrajectoryStep step);

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const TrajectoryConfig& config_;
  TrajectoryResult& result_;
  DistanceField field_;
  SplineCostConfig cost_;
};

}  // namespace ridgeway::detail
