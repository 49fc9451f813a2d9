// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "common/random.hpp"
#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway {

/// Depths of 0.1 to 10 m, and a fifth of the pixels without.
inline DepthImage random_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  DepthImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.depth.push_back(random.below(5) == 0 ? 0.0f
                                               : static_cast<float>(random.uniform(0.1, 10.0)));
  return image;
}

}  // namespace ridgeway
