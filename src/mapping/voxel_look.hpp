// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>

#include "depth_surfaces.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway::detail {

/// What a depth image says of points in the camera's frame, metres.
class VoxelLook {
 public:
  /// A signed distance, metres, and how much it counts; nothing where that is 0.
  struct Measured {
    float value = 0.0f, gain = 0.0f;
  };
  struct Pixel {
    int u = 0, v = 0;
  };

  /// The surfaces and the configuration must outlive it.
  VoxelLook(const DepthSurfaces& surfaces, const PinholeCamera& camera, const FusionConfig& config)
      : surfaces_(surfaces),
        image_(surfaces.image()),
        fx_(static_cast<float>(camera.fx)),
        fy_(static_cast<float>(camera.fy)),
        cx_(static_cast<float>(camera.cx)),
        cy_(static_cast<float>(camera.cy)),
        nearby_(static_cast<float>(1.0 * config.voxel_size)),
        truncation_(static_cast<float>(config.truncation)),
        behind_(static_cast<float>(config.depth_behind)),
        config_(config) {}

  const DepthImage& image() const { return image_; }

  /// By the pixel that sees the point. Asked of a million voxels an image, in line.
  [[gnu::always_inline]] Measured at(const Eigen::Vector3f& p) const {
    Pixel pixel;
    if (!project(p, pixel)) return {};
    const float depth = image_.at(pixel.u, pixel.v);
    const Eigen::Vector3f ray = ray_of(pixel);
    const float stretch = ray.norm();
    const float beyond = (p.z() - depth) * stretch;
    if (depth == 0.0f || beyond > behind_) return {};
    const Eigen::Vector3f surface = depth * ray;
    const Eigen::Vector3f& normal = surfaces_.normal_at(pixel.u, pixel.v);
    const float facing = -normal.dot(ray) / stretch;  // cosine of incidence; 0 without a normal
    float value = facing > 0.0f ? normal.dot(p - surface) : -beyond;
    if (std::abs(value) < truncation_ && facing > 0.0f &&
        !is_surface(p - value * normal, surface)) {
      if (value < 0.0f) return {};
      value = truncation_;
    }
    if (value <= -behind_ || (value >= truncation_ && !config_.carve)) return {};
    return {std::min(value, truncation_), gain_at(value, facing, p)};
  }

  /// By the surface that a pixel sees, no farther off than `most`; it has to see one.
  Measured by(const Pixel& pixel, const Eigen::Vector3f& p, float most) const {
    const Eigen::Vector3f ray = ray_of(pixel);
    const float stretch = ray.norm(), depth = image_.at(pixel.u, pixel.v);
    const Eigen::Vector3f& normal = surfaces_.normal_at(pixel.u, pixel.v);
    const float facing = -normal.dot(ray) / stretch;
    const float value = facing > 0.0f ? normal.dot(p - depth * ray) : (depth - p.z()) * stretch;
    const float near = std::clamp(value, -most, most);
    return {near, gain_at(near, facing, p)};
  }

  Eigen::Vector3f ray_of(const Pixel& pixel) const {
    return {(static_cast<float>(pixel.u) - cx_) / fx_, (static_cast<float>(pixel.v) - cy_) / fy_,
            1.0f};
  }

 private:
  /// The pixel that sees a point of the camera's frame; false outside the image.
  bool project(const Eigen::Vector3f& p, Pixel& pixel) const {
    constexpr float kNearest = 1e-3f;
    if (p.z() < kNearest) return false;
    const float u = fx_ * p.x() / p.z() + cx_ + 0.5f, v = fy_ * p.y() / p.z() + cy_ + 0.5f;
    if (!(u >= 0.0f && v >= 0.0f && u < static_cast<float>(image_.width) &&
          v < static_cast<float>(image_.height)))
      return false;
    pixel = {static_cast<int>(u), static_cast<int>(v)};
    return true;
  }

  /// Whether the surface reaches as far as the foot of a perpendicular to its plane: seen at a
  /// slant, the plane runs on where the surface has ended.
  bool is_surface(const Eigen::Vector3f& foot, const Eigen::Vector3f& seen) const {
    if ((foot - seen).squaredNorm() < nearby_ * nearby_) return true;
    Pixel pixel;
    if (!project(foot, pixel)) return true;
    const float depth = image_.at(pixel.u, pixel.v);
    return depth > 0.0f && std::abs(depth - foot.z()) < 0.5f * truncation_;
  }

  float gain_at(float value, float facing, const Eigen::Vector3f& p) const {
    return gain_of(value, config_) * std::max(facing, static_cast<float>(kLeastFacing)) /
           (p.z() * p.z());
  }

  const DepthSurfaces& surfaces_;
  const DepthImage& image_;
  const float fx_, fy_, cx_, cy_, nearby_, truncation_, behind_;
  const FusionConfig& config_;
};

}  // namespace ridgeway::detail
