// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/depth_camera.hpp"

#include <cmath>
#include <string>

#include "common/random.hpp"
#include "common/require.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

using detail::require;

constexpr int kMostPixels = 16384;                      // along one side
constexpr double kLeastFocal = 1e-3, kMostFocal = 1e6;  // in sides: from 179.9 degrees to none

/// The range that a sensor reports for a true one along a ray, 0 for none. `stretch`: length of
/// the ray at depth 1; `u`: the pixel's column.
double measure(const DepthSensor& sensor, double range, double stretch, int u, Random& random) {
  if (!(range >= sensor.min_range && range <= sensor.max_range)) return 0.0;
  if (sensor.range_sigma > 0.0) range += sensor.range_sigma * random.normal();
  if (sensor.baseline > 0.0) {
    const double product = sensor.camera.fx * sensor.baseline;
    const double disparity = product / (range / stretch);
    if (u < disparity) return 0.0;  // outside the right image
    range = product / (disparity + sensor.disparity_sigma * random.normal()) * stretch;
  }
  return range > 0.0 && std::isfinite(range) ? range : 0.0;
}

}  // namespace

void PinholeCamera::validate() const {
  require(width > 0 && width <= kMostPixels, "camera width", width, "give 1 to 16384 pixels");
  require(height > 0 && height <= kMostPixels, "camera height", height, "give 1 to 16384 pixels");
  const auto sees = [](double focal, int pixels) {
    return focal > kLeastFocal * pixels && focal < kMostFocal * pixels;
  };
  require(sees(fx, width), "camera fx", fx, "give the focal length in pixels");
  require(sees(fy, height), "camera fy", fy, "give the focal length in pixels");
  require(
      cx > -0.5 && cx < width - 0.5, "camera cx", cx,
      "the principal point lies in the image: check that the intrinsics are those of this size");
  require(
      cy > -0.5 && cy < height - 0.5, "camera cy", cy,
      "the principal point lies in the image: check that the intrinsics are those of this size");
}

void DepthSensor::validate() const {
  camera.validate();
  require(min_range >= 0.0 && std::isfinite(min_range), "min_range", min_range,
          "give metres, 0 or more");
  require(max_range > min_range, "max_range", max_range, "give metres, above min_range");
  require(range_sigma >= 0.0 && std::isfinite(range_sigma), "range_sigma", range_sigma,
          "give metres, 0 for no noise");
  require(baseline >= 0.0 && std::isfinite(baseline), "baseline", baseline,
          "give metres, 0 for a single camera");
  require(disparity_sigma >= 0.0 && std::isfinite(disparity_sigma), "disparity_sigma",
          disparity_sigma, "give pixels, 0 for no noise");
}

DepthSensor stereo_sensor() {
  DepthSensor sensor;
  sensor.min_range = 0.5;
  sensor.baseline = 0.11;
  sensor.disparity_sigma = 0.05;
  return sensor;
}

DepthImage render_depth(const World& world, const DepthSensor& sensor,
                        const Eigen::Isometry3d& T_world_camera, std::uint64_t seed) {
  sensor.validate();
  const PinholeCamera& camera = sensor.camera;
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  DepthImage image{camera.width, camera.height, std::vector<float>(width * height, 0.0f)};
  const Point origin = T_world_camera.translation();
  parallel_for_each_index(height, [&](std::size_t v) {
    Random random(seed, v);
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.ray(u, static_cast<double>(v));
      const double stretch = ray.norm();
      const double range = cast_ray(world, origin, T_world_camera.linear() * (ray / stretch));
      image.depth[v * width + static_cast<std::size_t>(u)] =
          static_cast<float>(measure(sensor, range, stretch, u, random) / stretch);
    }
  });
  return image;
}

}  // namespace ridgeway
