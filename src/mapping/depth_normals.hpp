// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway::detail {

/// Directions of the surfaces in a depth image.
///
/// The inverse depth of a plane is linear in the pixel, and its noise is small, so planes are
/// fitted to it by least squares over windows of 4 x 4 pixel tiles. Of several windows that hold a
/// tile the one that fits best is taken, so that edges stay sharp (Kuwahara 1976), and a small one
/// only where it fits much better, so that noise is averaged out. A pixel takes the plane of the
/// tile, of its own and those around, that its own depth fits best.
class DepthNormals {
 public:
  DepthNormals(const DepthImage& image, const PinholeCamera& camera);

  /// Of length one, towards the camera, in its frame; zero where there is none.
  const Eigen::Vector3f& at(int u, int v) const {
    return normals_[tile_[static_cast<std::size_t>(v * width_ + u)]];
  }

 private:
  int width_;
  std::vector<std::uint32_t> tile_;       // by pixel
  std::vector<Eigen::Vector3f> normals_;  // by tile, and one of length zero
};

}  // namespace ridgeway::detail
