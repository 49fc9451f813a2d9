// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "depth_surfaces.hpp"
#include "ridgeway/common/parallel.hpp"
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

  /// The surfaces and the configuration must outlive it. `beyond`: see DepthRanges.
  VoxelLook(const DepthSurfaces& surfaces, const DepthImage& beyond, const PinholeCamera& camera,
            const FusionConfig& config)
      : surfaces_(surfaces),
        image_(surfaces.image()),
        fx_(static_cast<float>(camera.fx)),
        fy_(static_cast<float>(camera.fy)),
        cx_(static_cast<float>(camera.cx)),
        cy_(static_cast<float>(camera.cy)),
        nearby_(static_cast<float>(1.0 * config.voxel_size)),
        truncation_(static_cast<float>(config.truncation)),
        behind_(static_cast<float>(config.depth_behind)),
        sparse_from_(nearby_ / std::hypot(0.5f / fx_, 0.5f / fy_)),
        config_(config),
        sights_(image_.depth.size()) {
    for (int u = 0; u < image_.width; ++u) ray_x_.push_back((static_cast<float>(u) - cx_) / fx_);
    for (int v = 0; v < image_.height; ++v) ray_y_.push_back((static_cast<float>(v) - cy_) / fy_);
    parallel_for_each_index(static_cast<std::size_t>(image_.height), [&](std::size_t row) {
      for (int u = 0; u < image_.width; ++u) {
        const Pixel pixel{u, static_cast<int>(row)};
        sights_[place_of(pixel)] = sight_of(pixel, beyond);
      }
    });
  }

  const DepthImage& image() const { return image_; }

  /// By the pixel that sees the point.
  Measured at(const Eigen::Vector3f& p) const {
    Pixel pixel;
    return project(p, pixel) ? at(p, pixel) : Measured{};
  }

  /// Calls body(i, measured) for those of eight points in a row, `step` apart, of which something
  /// is measured. Asked of a million voxels an image: what all of them ask first branches nowhere,
  /// for the compiler to ask it of several at once.
  template <typename Body>
  void along(const Eigen::Vector3f& first, const Eigen::Vector3f& step, const Body& body) const {
    constexpr std::size_t kRow = 8;
    std::array<float, kRow> x, y, z, u, v;
    for (std::size_t i = 0; i < kRow; ++i) {
      const auto steps = static_cast<float>(static_cast<int>(i));
      x[i] = first.x() + steps * step.x();
      y[i] = first.y() + steps * step.y();
      z[i] = first.z() + steps * step.z();
      u[i] = fx_ * x[i] / z[i] + cx_ + 0.5f;
      v[i] = fy_ * y[i] / z[i] + cy_ + 0.5f;
    }
    for (std::size_t i = 0; i < kRow; ++i) {
      if (!is_in_view(z[i], u[i], v[i])) continue;
      const Measured measured =
          at({x[i], y[i], z[i]}, {static_cast<int>(u[i]), static_cast<int>(v[i])});
      if (measured.gain > 0.0f) body(i, measured);
    }
  }

  /// By the surface that a pixel sees, no farther off than `most`; it has to see one.
  Measured by(const Pixel& pixel, const Eigen::Vector3f& p, float most) const {
    const Sight& sight = sights_[place_of(pixel)];
    const float value = sight.facing > 0.0f
                            ? surfaces_.normal(sight.tile).dot(p - sight.depth * ray_of(pixel))
                            : (sight.depth - p.z()) * sight.stretch;
    const float near = std::clamp(value, -most, most);
    return {near, gain_at(near, sight.facing, p)};
  }

  Eigen::Vector3f ray_of(const Pixel& pixel) const {
    return {ray_x_[static_cast<std::size_t>(pixel.u)], ray_y_[static_cast<std::size_t>(pixel.v)],
            1.0f};
  }

 private:
  /// What points ask of the pixel that sees them, many of the same one.
  struct Sight {
    float depth;
    float stretch;       ///< the ray's length over its depth
    float facing;        ///< cosine of incidence; 0 without a normal
    float behind;        ///< it tells of what lies up to so far behind what it sees, metres
    std::uint32_t tile;  ///< whose normal it is
  };

  std::size_t place_of(const Pixel& pixel) const {
    return static_cast<std::size_t>(pixel.v) * static_cast<std::size_t>(image_.width) +
           static_cast<std::size_t>(pixel.u);
  }

  Sight sight_of(const Pixel& pixel, const DepthImage& beyond) const {
    const Eigen::Vector3f ray = ray_of(pixel);
    const float stretch = ray.norm();
    const std::uint32_t tile = surfaces_.tile_at(pixel.u, pixel.v);
    if (const float far = beyond.at(pixel.u, pixel.v); far != 0.0f)
      return {far, stretch, 0.0f, static_cast<float>(config_.max_range) - far * stretch, tile};
    const float depth = image_.at(pixel.u, pixel.v);
    const float behind = depth != 0.0f ? behind_ : -std::numeric_limits<float>::infinity();
    return {depth, stretch, -surfaces_.normal(tile).dot(ray) / stretch, behind, tile};
  }

  [[gnu::always_inline]] Measured at(const Eigen::Vector3f& p, const Pixel& pixel) const {
    const Sight& sight = sights_[place_of(pixel)];
    const float beyond = (p.z() - sight.depth) * sight.stretch;
    if (beyond > sight.behind) return {};
    const Eigen::Vector3f& normal = surfaces_.normal(sight.tile);
    const Eigen::Vector3f surface = sight.depth * ray_of(pixel);
    const bool has_normal = sight.facing > 0.0f;
    float value = has_normal ? normal.dot(p - surface) : -beyond;
    if (std::abs(value) < truncation_ && has_normal && !is_surface(p - value * normal, surface)) {
      if (value < 0.0f) return {};
      value = truncation_;
    }
    if (value <= -behind_ || (value >= truncation_ && !config_.carve)) return {};
    if (p.z() > sparse_from_ && value > 0.0f && is_between_rays(p, pixel)) return {};
    return {std::min(value, truncation_), gain_at(value, sight.facing, p)};
  }

  /// Whether a pixel sees a point at that depth.
  bool is_in_view(float z, float u, float v) const {
    constexpr float kNearest = 1e-3f;
    return z >= kNearest && u >= 0.0f && v >= 0.0f && u < static_cast<float>(image_.width) &&
           v < static_cast<float>(image_.height);
  }

  /// The pixel that sees a point of the camera's frame; false outside the image.
  bool project(const Eigen::Vector3f& p, Pixel& pixel) const {
    const float u = fx_ * p.x() / p.z() + cx_ + 0.5f, v = fy_ * p.y() / p.z() + cy_ + 0.5f;
    if (!is_in_view(p.z(), u, v)) return false;
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

  /// Whether at the point's depth the pixel's ray is farther off than a voxel: the point may be in
  /// something that all rays miss.
  bool is_between_rays(const Eigen::Vector3f& p, const Pixel& pixel) const {
    return (p - p.z() * ray_of(pixel)).squaredNorm() > nearby_ * nearby_;
  }

  float gain_at(float value, float facing, const Eigen::Vector3f& p) const {
    return gain_of(value, config_) * std::max(facing, static_cast<float>(kLeastFacing)) /
           (p.z() * p.z());
  }

  const DepthSurfaces& surfaces_;
  const DepthImage& image_;
  const float fx_, fy_, cx_, cy_, nearby_, truncation_, behind_;
  // Depth from which pixels are so sparse that a point between them may be so far from their rays.
  const float sparse_from_;
  const FusionConfig& config_;
  std::vector<float> ray_x_, ray_y_;  // by column, and by row
  std::vector<Sight> sights_;         // by pixel
};

}  // namespace ridgeway::detail
