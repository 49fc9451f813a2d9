// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/random.hpp"
#include "ridgeway/exploration/explorer.hpp"

namespace ridgeway {

/// What Ridgeway's explorer is compared with: the receding horizon next best view planner of
/// Bircher et al. (ICRA 2016), written anew, with the settings that its authors published for
/// exploration (interface_nbvp_rotors/resource/exploration.yaml): branches of a random tree of 30
/// nodes, up to 200 where none has a gain, 1 m at most from node to node; the gain of a node is the
/// unknown volume in view at a random heading, times exp(-0.5 metres on the way there); the best
/// branch's first edge is flown, from rest to rest, the rest of it is kept for the next tree. Their
/// gain looks 1.5 m far; here as far as our own planner looks, as it gave up early otherwise.
class NextBestView {
 public:
  NextBestView(const ExplorerConfig& config, std::uint64_t seed);

  /// As Explorer::decide; does nothing until the last trajectory has come to its end.
  ExplorationStep decide(const std::shared_ptr<const Roadmap>& now, const FlightState& state);

 private:
  struct Node {
    Point position;  ///< local frame
    double yaw = 0.0;
    std::size_t parent = 0;
    double way = 0.0;   ///< metres from the root
    double gain = 0.0;  ///< of the branch up to here
  };
  double unknown_in_view(const EsdfMap& esdf, const Point& from, double yaw) const;
  void add(const Roadmap& roadmap, std::vector<Node>& tree, std::size_t parent, const Point& at,
           double yaw) const;
  void grow(const Roadmap& roadmap, std::vector<Node>& tree);
  static std::optional<Point> root_at(const Roadmap& roadmap, const Point& local);
  std::optional<Trajectory> fly(const Roadmap& roadmap, const FlightState& state, const Point& root,
                                const Viewpoint& to) const;

  ExplorerConfig config_;
  Random random_;
  std::vector<Viewpoint> kept_;  ///< of the last best branch, world
  double busy_until_ = 0.0;
};

}  // namespace ridgeway
