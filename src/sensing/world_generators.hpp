// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>

#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// A perfect maze (one way between any two cells) with a few more openings, on a square.
struct MazeConfig {
  int cells = 10;          ///< along each side
  double cell = 3.0;       ///< metres from wall to wall, middle to middle
  double wall = 0.3;       ///< metres thick
  double height = 2.5;     ///< metres from floor to ceiling
  int extra_openings = 8;  ///< walls taken out of the perfect maze
  std::uint64_t seed = 1;

  /// Throws InputError naming the bad field.
  void validate() const;
};
World make_maze(const MazeConfig& config = {});

/// A machine hall: columns, tanks and machines on the floor, pipes and a crane under the ceiling, a
/// mezzanine along one wall.
struct HallConfig {
  double length = 20.0, width = 22.0, height = 5.0;  ///< metres along x, y, z
  int tanks = 6, machines = 12, pipes = 5;
  std::uint64_t seed = 1;

  /// Throws InputError naming the bad field.
  void validate() const;
};
World make_hall(const HallConfig& config = {});

/// The house of the paper's first experiment, 15 x 10 x 5 m: that of worlds/house.yaml.
World make_house();

}  // namespace ridgeway
