// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway::detail {

/// The surfaces in a depth image: their directions, and their depths without most of the noise.
///
/// The inverse depth of a plane is linear in the pixel, and its noise is small, so planes are
/// fitted to it by least squares over windows of 4 x 4 pixel tiles. Of several windows that hold a
/// tile the one that fits best is taken, so that edges stay sharp (Kuwahara 1976), and a small one
/// only where it fits much better, so that noise is averaged out. A pixel takes the plane of its
/// own tile if it is off by no more than noise, else the one, of those around too, that it fits
/// best. What noise is, is measured: a quarter of the tiles around are no noisier. So a thin pole
/// before a wall is no noise, and an image without noise stays as it is.
class DepthSurfaces {
 public:
  DepthSurfaces(const DepthImage& raw, const PinholeCamera& camera);

  /// The tile whose plane a pixel takes; one that has none where it takes none.
  std::uint32_t tile_at(int u, int v) const { return tile_[pixel(u, v)]; }
  /// Of a tile, of length one, towards the camera, in its frame; zero where there is none.
  const Eigen::Vector3f& normal(std::uint32_t tile) const { return normals_[tile]; }

  /// The image with each depth moved onto its plane where that is no farther than noise.
  const DepthImage& image() const { return image_; }

 private:
  std::size_t pixel(int u, int v) const { return static_cast<std::size_t>(v * image_.width + u); }

  DepthImage image_;
  std::vector<std::uint32_t> tile_;       // by pixel
  std::vector<Eigen::Vector3f> normals_;  // by tile, and one of length zero
};

}  // namespace ridgeway::detail
