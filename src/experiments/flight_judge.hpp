// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway {

/// What a judge saw of a flight, by finite differences between samples a millisecond apart.
struct FlightVerdict {
  std::string complaint;      ///< the first thing that is wrong; empty where all holds
  double length = 0.0;        ///< metres flown
  double clearance = 0.0;     ///< smallest distance to an obstacle, metres, or the radius and half
                              ///< a voxel where that is less
  double speed = 0.0;         ///< largest, m/s
  double acceleration = 0.0;  ///< largest, m/s^2, over the joints and from rest to rest too
  double jerk = 0.0;          ///< largest, m/s^3
  double yaw_rate = 0.0;      ///< largest, rad/s

  bool holds() const { return complaint.empty(); }
};

/// An independent judge of trajectories, which shares no code with what plans and verifies them: it
/// evaluates the polynomials itself, and looks at every voxel near enough to matter in a plain
/// dense grid of its own. Immutable: safe to ask from many threads.
class FlightJudge {
 public:
  /// Copies the box around the map's blocks, a byte a voxel. Throws InputError for a map without
  /// blocks, or where there is no memory for the box.
  FlightJudge(const OccupancyMap& map, UnknownPolicy policy);

  /// A flight from the configuration's motion at `start` to rest at `goal`: ends where it should,
  /// in one piece, keeps the radius from obstacles (and in known-free voxels where unknown space is
  /// no obstacle), keeps all limits, and its clearance is no smaller than stated. Differences may
  /// exceed limits by what rounding does to them.
  FlightVerdict judge(const TrajectoryResult& flown, const Point& start, const Point& goal,
                      const TrajectoryConfig& config) const;

 private:
  VoxelState at(int x, int y, int z) const;
  bool touches_free(const Point& p) const;
  double distance(const Point& p, double reach) const;
  void look_around(const std::vector<Eigen::Vector4d>& samples, double radius,
                   FlightVerdict& verdict) const;

  double voxel_size_;
  VoxelIndex to_own_;  // from the lattice's voxels to the map's own, of which all below are
  UnknownPolicy policy_;
  VoxelIndex low_, high_;
  std::vector<VoxelState> states_;
};

}  // namespace ridgeway
