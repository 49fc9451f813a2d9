// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "common/require.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway {

void SpinningLidar::validate() const {
  using detail::require;
  constexpr int kMostBeams = 16384;  // along one side
  require(rows > 1 && rows <= kMostBeams, "lidar rows", rows, "give 2 to 16384");
  require(columns > 2 && columns <= kMostBeams, "lidar columns", columns, "give 3 to 16384");
  require(vertical > 0.0 && vertical < std::numbers::pi, "lidar vertical", vertical,
          "give radians above 0 and below half a turn");
  require(min_range >= 0.0 && std::isfinite(min_range), "lidar min_range", min_range,
          "give metres, 0 or more");
  require(max_range > min_range && std::isfinite(max_range), "lidar max_range", max_range,
          "give metres, above min_range");
  require(range_sigma >= 0.0 && std::isfinite(range_sigma), "lidar range_sigma", range_sigma,
          "give metres, 0 for no noise");
}

std::vector<Point> scan_with(const World& world, const SpinningLidar& lidar,
                             const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed) {
  lidar.validate();
  const auto rows = static_cast<std::size_t>(lidar.rows);
  const Point origin = T_world_sensor.translation();
  std::vector<std::vector<Point>> of_row(rows);
  parallel_for_each_index(rows, [&](std::size_t row) {
    Random random(seed, row);
    const double rise = lidar.vertical * (static_cast<double>(row) / (lidar.rows - 1) - 0.5);
    for (int column = 0; column < lidar.columns; ++column) {
      const double turn = 2.0 * std::numbers::pi * column / lidar.columns;
      const Eigen::Vector3d beam(std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn),
                                 std::sin(rise));
      double range = cast_ray(world, origin, T_world_sensor.linear() * beam);
      if (!(range >= lidar.min_range && range <= lidar.max_range)) continue;
      if (lidar.range_sigma > 0.0) range += lidar.range_sigma * random.normal();
      if (range > 0.0) of_row[row].push_back(range * beam);
    }
  });
  std::vector<Point> points;
  for (const std::vector<Point>& row : of_row) points.insert(points.end(), row.begin(), row.end());
  return points;
}

}  // namespace ridgeway
