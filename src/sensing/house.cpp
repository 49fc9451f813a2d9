// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "world_generators.hpp"

namespace ridgeway {

World make_house() {
  World house;
  house.name = "house";
  const Point size(15.0, 10.0, 5.0);
  for (int axis = 0; axis < 3; ++axis) {
    house.planes.push_back({Eigen::Vector3d::Unit(axis), 0.0});
    house.planes.push_back({-Eigen::Vector3d::Unit(axis), -size[axis]});
  }
  house.boxes = {// Walls
                 {{3.75, 5, 2.5}, {7.5, 0.5, 5}},
                 {{9.5, 5, 2.5}, {1, 0.5, 5}},
                 {{1.25, 7.5, 2.5}, {2.5, 0.5, 5}},
                 {{6.5, 7.5, 2.5}, {5, 0.5, 5}},
                 {{12.5, 7.5, 2.5}, {5, 0.5, 5}},
                 {{10, 2.5, 2.5}, {0.5, 5, 5}},
                 {{8, 8.75, 2.5}, {0.5, 2.5, 5}},
                 {{5, 8.25, 2.5}, {0.5, 1.5, 5}},
                 // Things in the rooms
                 {{2.5, 2.5, 2.5}, {1, 1, 5}},
                 {{3.5, 2.5, 1.25}, {1, 1, 2.5}},
                 {{13.75, 8.5, 1.25}, {2.5, 2, 2.5}}};
  house.spheres = {{{11.5, 1.5, 1.25}, 1}, {{13.5, 1.5, 1.25}, 1}};
  house.cylinders = {{{12.5, 5, 1.25}, 0.5, 2.5}};
  return house;
}

}  // namespace ridgeway
