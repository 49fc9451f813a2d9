// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "common/random.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway::testing {

inline Eigen::Vector3d random_vector(Random& random, double low, double high) {
  const double x = random.uniform(low, high), y = random.uniform(low, high);
  return {x, y, random.uniform(low, high)};
}

/// A few solids of every kind within 5 m of the origin, above a slanted floor.
inline World random_world(std::uint64_t seed) {
  Random random(seed, 77);
  World world;
  world.planes.push_back(
      {Eigen::Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 1.0).normalized(),
       random.uniform(-6.0, -4.0)});
  for (int i = 0; i < 3; ++i) {
    world.boxes.push_back({random_vector(random, -5.0, 5.0), random_vector(random, 0.2, 3.0)});
    world.spheres.push_back({random_vector(random, -5.0, 5.0), random.uniform(0.2, 1.5)});
    world.cylinders.push_back(
        {random_vector(random, -5.0, 5.0), random.uniform(0.1, 1.5), random.uniform(0.2, 4.0)});
  }
  return world;
}

inline Eigen::Vector3d random_direction(Random& random) {
  for (;;) {
    const Eigen::Vector3d v = random_vector(random, -1.0, 1.0);
    if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
  }
}

}  // namespace ridgeway::testing
