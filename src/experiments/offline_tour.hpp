// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <memory>
#include <vector>

#include "exploration/tour.hpp"
#include "exploration/viewpoints.hpp"
#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/sensing/world.hpp"
#include "viewable.hpp"

namespace ridgeway {

/// What an explorer is held against: a tour by one that knows the world. On the roadmap of the
/// exact world, of the same voxels and clearance, viewpoints with eight headings each are taken
/// greedily until they have 98% of what can be seen in view, and ordered to the shortest tour by
/// the time of flight (insertion, 2-opt and or-opt). It is flown as the explorer flies, past stops
/// without a halt where the robot has turned by then; a stop is left out once the map knows nearly
/// all that it has in view, and what is left is put in order anew each second. Not the best tour,
/// but one that needs no luck.
class OfflineTour {
 public:
  /// `radius`: clearance of the robot; `view`: as the explorer counts on it.
  OfflineTour(const World& world, double voxel_size, const VoxelRange& within, double radius,
              double max_distance, const Point& start, const FieldOfView& view,
              const MotionLimits& limits, const ViewableVolume& viewable);

  /// As Explorer::decide, but that it does not fly home.
  ExplorationStep decide(const Roadmap& now, const FlightState& state);

  std::size_t stops() const { return stops_.size(); }

 private:
  struct Stop {
    Viewpoint view;                ///< world
    std::vector<VoxelIndex> seen;  ///< of the lattice; that no stop before has in view
    bool is_done = false;
  };
  void choose_stops(const FieldOfView& view, const Point& start,
                    const std::vector<VoxelIndex>& targets);
  void leave_out_known(const Roadmap& now);
  std::vector<std::size_t> order(const FlightState& state) const;

  Roadmap world_;
  MotionLimits limits_;
  std::vector<Stop> stops_;
  std::vector<std::vector<double>> between_;  ///< seconds, [from][to]
  std::size_t goal_ = 0;
  bool has_goal_ = false;
  double passed_at_ = 0.0, busy_until_ = 0.0, last_order_ = -1e9;
};

}  // namespace ridgeway
