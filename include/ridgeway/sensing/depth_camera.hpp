// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// From pixels to rays and back, without distortion. The frame: x right, y down, z forward; the
/// centre of the first pixel is (0, 0).
struct PinholeCamera {
  int width = 320;    ///< pixels
  int height = 240;   ///< pixels
  double fx = 160.0;  ///< focal length, pixels; across 320 of them 90 degrees
  double fy = 160.0;  ///< focal length, pixels
  double cx = 159.5;  ///< of the optical axis, pixels
  double cy = 119.5;  ///< of the optical axis, pixels

  /// The point of a pixel's ray at depth 1.
  Eigen::Vector3d ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Depths along the optical axis in metres, row by row; 0 where nothing was measured.
struct DepthImage {
  int width = 0;             ///< pixels
  int height = 0;            ///< pixels
  std::vector<float> depth;  ///< width * height metres, row by row

  /// Of the pixel in column u and row v, which must be there.
  float at(int u, int v) const {
    return depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(u)];
  }
};

/// What a simulated depth camera sees and how well.
struct DepthSensor {
  PinholeCamera camera = {};     ///< its optics
  double min_range = 0.0;        ///< metres along the ray; nothing nearer is measured
  double max_range = 10.0;       ///< metres along the ray; nothing beyond is measured
  double range_sigma = 0.0;      ///< metres; independent Gaussian noise on every range
  double baseline = 0.0;         ///< metres; above 0 a stereo pair, this camera the left one
  double disparity_sigma = 0.0;  ///< pixels; a pair's noise: grows with the square of the depth

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// A stereo pair as drones carry it: sees nothing nearer than 0.5 m or in the strip that only the
/// left camera sees, and is off by about 1.4 % at 5 m.
DepthSensor stereo_sensor();

/// Renders what a sensor sees from a pose (camera to world). The same seed gives the same image
/// for any number of threads.
DepthImage render_depth(const World& world, const DepthSensor& sensor,
                        const Eigen::Isometry3d& T_world_camera, std::uint64_t seed = 0);

/// A lidar that spins about its upright axis: rows of beams at even angles from one edge of its
/// view to the other, each fired in all columns around. Its frame: x forward, y left, z up.
struct SpinningLidar {
  int rows = 32;             ///< of beams, one above the other
  int columns = 640;         ///< all around
  double vertical = 1.0;     ///< radians, from the lowest row to the highest, level in the middle
  double min_range = 0.0;    ///< metres; nothing nearer is measured
  double max_range = 10.0;   ///< metres; nothing beyond is measured
  double range_sigma = 0.0;  ///< metres; independent Gaussian noise on every range

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// What a lidar measures in one turn, from a pose (sensor to world) that it has all the while:
/// points in its frame, row by row, without beams that meet nothing in range. The same seed gives
/// the same points for any number of threads.
std::vector<Point> scan_with(const World& world, const SpinningLidar& lidar,
                             const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed = 0);

}  // namespace ridgeway
