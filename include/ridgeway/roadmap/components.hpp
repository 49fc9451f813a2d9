// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// A connected part of traversable space.
struct Component {
  std::size_t voxels = 0;
  double volume = 0.0;     ///< cubic metres
  Point widest;            ///< its place of largest clearance, metres
  double clearance = 0.0;  ///< there, metres
};

/// The largest radius, below min_clearance, at which two components would be one, and the place
/// that is too narrow. `a` and `b` index the components; the joins form a forest.
struct ComponentJoin {
  std::size_t a = 0, b = 0;
  double radius = 0.0;  ///< metres
  Point place;          ///< metres
};

struct ComponentReport {
  std::vector<Component> components;  ///< largest first
  std::vector<ComponentJoin> joins;   ///< widest first
};

/// Parts of traversable space at the roadmap's min_clearance, exact over all legal moves, and how
/// a smaller robot would find them joined. Takes about as long as the kernel's stage.
ComponentReport report_components(const Roadmap& roadmap);

}  // namespace ridgeway
