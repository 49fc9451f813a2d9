// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "deformation.hpp"

#include <algorithm>
#include <cmath>

#include "paths/planning_constants.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway::detail {
namespace {

/// Walks along a path; lengths must not fall from call to call.
class Walker {
 public:
  explicit Walker(std::span<const Point> path) : path_(path) {}

  Point at(double length) {
    for (; next_ < path_.size(); ++next_) {
      const double segment = (path_[next_] - path_[next_ - 1]).norm();
      if (passed_ + segment > length)
        return path_[next_ - 1] +
               (path_[next_] - path_[next_ - 1]) * ((length - passed_) / segment);
      passed_ += segment;
    }
    return path_.back();
  }

 private:
  std::span<const Point> path_;
  std::size_t next_ = 1;
  double passed_ = 0.0;
};

}  // namespace

bool deforms_into(const FreeSpace& space, std::span<const Point> a, std::span<const Point> b,
                  double radius) {
  const double length_a = length_of(a), length_b = length_of(b);
  const double steps = std::ceil(std::max(length_a, length_b) / (kPlanning.look_step * radius));
  Walker on_a(a), on_b(b);
  for (double k = 1.0; k < steps; k += 1.0)
    if (!space.is_free(on_a.at(length_a * k / steps), on_b.at(length_b * k / steps),
                       kPlanning.deform_radius * radius))
      return false;
  return true;
}

}  // namespace ridgeway::detail
