// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "poses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "box_between_planes.hpp"
#include "common/number_text.hpp"
#include "common/random.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {

void PoseSampling::validate() const {
  if (!low.allFinite() || !(high - low).allFinite() || (low.array() > high.array()).any())
    throw InputError("volume of poses", "is no box", "give the lesser corner first, metres");
  if (!(clearance >= 0.0 && std::isfinite(clearance)))
    throw InputError("clearance of poses", "is " + number_text(clearance), "give metres");
}

PoseSampling sampling_inside(const World& world) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  Point low = Point::Constant(kUnbounded), high = Point::Constant(-kUnbounded);
  const auto reach = [&](const Point& centre, const Eigen::Vector3d& half) {
    low = low.cwiseMin(centre - half);
    high = high.cwiseMax(centre + half);
  };
  for (const SolidBox& box : world.boxes) reach(box.centre, 0.5 * box.size);
  for (const SolidSphere& ball : world.spheres) reach(ball.centre, Point::Constant(ball.radius));
  for (const SolidCylinder& round : world.cylinders)
    reach(round.centre, {round.radius, round.radius, 0.5 * round.height});
  for (const PlacedMesh& placed : world.meshes) {
    const Eigen::Vector3d half = 0.5 * placed.scale * (placed.mesh->high() - placed.mesh->low());
    const Point centre = placed.scale * placed.mesh->low() + half;
    reach(placed.T_world_mesh * centre, placed.T_world_mesh.linear().cwiseAbs() * half);
  }
  const auto [floor, ceiling] = detail::box_between(world.planes);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(floor[axis])) low[axis] = floor[axis];
    if (std::isfinite(ceiling[axis])) high[axis] = ceiling[axis];
  }
  if (!low.allFinite() || !high.allFinite())
    throw InputError("world", "has no walls on some side and nothing in it to look at",
                     "add planes or solids, or give the volume of the poses");
  return {.low = low, .high = high};
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
  constexpr std::size_t kTriesEach = 100000;
  sampling.validate();
  Random random(sampling.seed);
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t tries = 0; poses.size() < sampling.count; ++tries) {
    if (tries >= kTriesEach * (poses.size() + 1))
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
