// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <span>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Length, each piece of it times `factor` of the distance to the nearest obstacle there: of those
/// that the voxels around know, which is only ever too far, and hardly ever at all.
class PathCost {
 public:
  PathCost(const FreeSpace& space, double radius, double prefer_clearance)
      : space_(space), radius_(radius), prefer_clearance_(prefer_clearance) {}

  /// Whether cost is more than length.
  bool prefers_clearance() const { return prefer_clearance_ > 0.0; }
  /// 1 + prefer_clearance * (radius / clearance)^2.
  double factor(double clearance) const;
  double of(std::span<const Point> path) const;
  /// Whether a stretch of a path may become another: where it costs no more, up to a thousandth.
  bool is_kept(std::span<const Point> before, std::span<const Point> after) const;

 private:
  const FreeSpace& space_;
  const double radius_, prefer_clearance_;
};

}  // namespace ridgeway::detail
