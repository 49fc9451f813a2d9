// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/random_maps.hpp"

namespace ridgeway::testing {

/// A world given by what is free, in metres, sampled at voxel centres inside a box of voxels.
struct Shape {
  std::string name;
  double voxel_size;
  double min_clearance;
  VoxelIndex size;  ///< voxels from the origin
  std::function<bool(const Point&)> is_free;

  OccupancyMap map() const {
    return make_map(voxel_size, {0, 0, 0}, size - VoxelIndex{1, 1, 1}, [&](const VoxelIndex& v) {
      return is_free(centre_of(v, voxel_size)) ? VoxelState::kFree : VoxelState::kOccupied;
    });
  }
};

inline bool inside(const Point& p, const Point& low, const Point& high) {
  return (p.array() > low.array()).all() && (p.array() < high.array()).all();
}

/// The shapes that have broken skeletons before. All rooms keep a voxel of wall around them.
inline std::vector<Shape> test_shapes() {
  const auto room = [](const Point& p, double x, double y, double z) {
    return inside(p, Point(0.1, 0.1, 0.1), Point(x - 0.1, y - 0.1, z - 0.1));
  };
  return {
      {"round_tunnel",
       0.1,
       0.3,
       {60, 14, 14},
       [](const Point& p) {
         return p.x() > 0.1 && p.x() < 5.9 && std::hypot(p.y() - 0.7, p.z() - 0.7) < 0.55;
       }},
      {"one_voxel_passage",
       0.1,
       0.05,
       {40, 20, 12},
       [=](const Point& p) {
         const bool wall = p.x() > 1.9 && p.x() < 2.1;
         return room(p, 4, 2, 1.2) &&
                (!wall || (std::abs(p.y() - 0.95) < 0.05 && std::abs(p.z() - 0.55) < 0.05));
       }},
      {"radius_a_whole_number_of_voxels",
       0.05,
       0.3,
       {60, 60, 30},
       [](const Point& p) {
         return inside(p, Point(0.1, 0.1, 0.1), Point(1.0, 2.9, 1.4)) ||
                inside(p, Point(0.1, 0.1, 0.1), Point(2.9, 0.7, 0.7));
       }},
      {"sphere_in_sphere",
       0.1,
       0.2,
       {40, 40, 40},
       [](const Point& p) {
         const double d = (p - Point(2, 2, 2)).norm();
         return d < 1.85 && d > 0.8;
       }},
      {"thin_pole",
       0.1,
       0.3,
       {40, 40, 20},
       [=](const Point& p) {
         return room(p, 4, 4, 2) &&
                !(std::abs(p.x() - 1.95) < 0.05 && std::abs(p.y() - 1.95) < 0.05);
       }},
      {"ring_in_a_room",
       0.1,
       0.2,
       {44, 44, 24},
       [=](const Point& p) {
         const double round = std::hypot(p.x() - 2.2, p.y() - 2.2) - 1.1;
         return room(p, 4.4, 4.4, 2.4) && std::hypot(round, p.z() - 1.2) > 0.15;
       }},
      {"floating_box",
       0.1,
       0.2,
       {40, 40, 30},
       [=](const Point& p) {
         return room(p, 4, 4, 3) && !inside(p, Point(1.5, 1.5, 1.2), Point(2.5, 2.5, 1.9));
       }},
      {"staircase",
       0.1,
       0.3,
       {60, 16, 50},
       [](const Point& p) {
         const double step = 0.3 * std::floor(p.x() / 0.4);
         return p.x() > 0.1 && p.x() < 5.9 && p.y() > 0.1 && p.y() < 1.5 && p.z() > 0.1 + step &&
                p.z() < 1.3 + step && p.z() < 4.9;
       }},
      {"door_of_the_robots_width",
       0.1,
       0.3,
       {60, 30, 16},
       [=](const Point& p) {
         const bool wall = p.x() > 2.9 && p.x() < 3.2;
         return room(p, 6, 3, 1.6) && (!wall || (p.y() > 1.2 && p.y() < 1.8 + 0.1 && p.z() < 1.0));
       }},
      {"in_sight_of_each_other",
       0.1,
       0.3,
       {50, 12, 12},
       [=](const Point& p) { return room(p, 5, 1.2, 1.2); }},
  };
}

/// The one of a name. Throws where there is none.
inline Shape test_shape(const std::string& name) {
  for (const Shape& shape : test_shapes())
    if (shape.name == name) return shape;
  throw std::invalid_argument("there is no shape '" + name + "'");
}

}  // namespace ridgeway::testing
