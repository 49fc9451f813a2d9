// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/poses.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"
#include "ridgeway/sensing/random.hpp"

namespace ridgeway {

void PoseSampling::validate() const {
  if (!low.allFinite() || !high.allFinite() || (low.array() > high.array()).any())
    throw InputError("volume of poses", "is no box", "give the lesser corner first, metres");
  if (!(clearance >= 0.0 && std::isfinite(clearance)))
    throw InputError("clearance of poses", "is " + number_text(clearance), "give metres");
}

Eigen::Isometry3d level_pose(const Point& place, double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << Eigen::Vector3d(s, -c, 0.0), -Eigen::Vector3d::UnitZ(),
      Eigen::Vector3d(c, s, 0.0);  // right, down, forward
  T_world_camera.translation() = place;
  return T_world_camera;
}

std::vector<Eigen::Isometry3d> sample_poses(const World& world, const PoseSampling& sampling) {
  constexpr std::size_t kTriesEach = 10000;
  sampling.validate();
  Random random(sampling.seed);
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t tries = 0; poses.size() < sampling.count; ++tries) {
    if (tries >= kTriesEach * sampling.count)
      throw InputError(
          "volume of poses",
          "has hardly any place " + number_text(sampling.clearance) + " m from all surfaces",
          "give a smaller clearance or another volume");
    Point place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = random.uniform(sampling.low[axis], sampling.high[axis]);
    const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
    if (surface_distance(world, place).distance >= sampling.clearance)
      poses.push_back(level_pose(place, heading));
  }
  return poses;
}

}  // namespace ridgeway
