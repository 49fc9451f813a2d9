// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "deformation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "paths/planning_constants.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway::detail {
namespace {

/// Places on a path by their length along it.
class Along {
 public:
  explicit Along(std::span<const Point> path) : path_(path), passed_(path.size()) {
    for (std::size_t i = 1; i < path.size(); ++i)
      passed_[i] = passed_[i - 1] + (path[i] - path[i - 1]).norm();
  }

  double length() const { return passed_.back(); }

  Point at(double length) const {
    const auto next = std::upper_bound(passed_.begin() + 1, passed_.end(), length);
    if (next == passed_.end()) return path_.back();
    const auto i = static_cast<std::size_t>(next - passed_.begin());
    const Point segment = path_[i] - path_[i - 1];
    return path_[i - 1] + segment * ((length - passed_[i - 1]) / segment.norm());
  }

 private:
  std::span<const Point> path_;
  std::vector<double> passed_;  ///< length up to each of its points
};

}  // namespace

bool deforms_into(const FreeSpace& space, std::span<const Point> a, std::span<const Point> b,
                  double radius) {
  const Along on_a(a), on_b(b);
  // Obstacles are whole voxels, however small the robot.
  const double apart = kPlanning.look_step * std::max(radius, 0.25 * space.map().voxel_size);
  const double steps = std::ceil(std::max(on_a.length(), on_b.length()) / apart);
  const auto looks = steps > 1.0 ? static_cast<std::size_t>(steps) - 1 : 0;
  // Paths of two classes mostly begin and end alike: from the middle on, at half the distance each
  // time, it is sooner seen that something is between them.
  for (std::size_t stride = std::bit_floor(looks); stride > 0; stride /= 2)
    for (std::size_t k = stride; k <= looks; k += 2 * stride) {
      const auto share = [&](const Along& path) {
        return path.at(path.length() * static_cast<double>(k) / steps);
      };
      if (!space.is_free(share(on_a), share(on_b), kPlanning.deform_radius * radius)) return false;
    }
  return true;
}

}  // namespace ridgeway::detail
