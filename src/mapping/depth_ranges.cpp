// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "depth_ranges.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ridgeway::detail {
namespace {

/// Whether fewer than two of the eight pixels around one measure something, too.
bool is_alone(const DepthImage& image, int u, int v) {
  int others = 0;
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, image.height - 1); ++y)
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, image.width - 1); ++x)
      others += (x != u || y != v) && image.at(x, y) != 0.0f;
  return others < 2;
}

DepthImage without_outliers(const DepthImage& image) {
  DepthImage kept = image;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      if (image.at(u, v) != 0.0f && is_alone(image, u, v))
        kept.depth[static_cast<std::size_t>(v * image.width + u)] = 0.0f;
  return kept;
}

}  // namespace

DepthRanges ranges_of(const DepthImage& image, const PinholeCamera& camera,
                      const FusionConfig& config) {
  DepthRanges ranges{image, {image.width, image.height, std::vector<float>(image.depth.size())}};
  bool any_beyond = false;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * image.width + u);
      const double stretch = camera.ray(u, v).norm();
      const double range = static_cast<double>(image.at(u, v)) * stretch;
      if (config.takes(range)) continue;
      ranges.within.depth[pixel] = 0.0f;
      if (!config.carve || !config.is_beyond(range)) continue;
      ranges.beyond.depth[pixel] = static_cast<float>(as_far_as_it_counts(range, config) / stretch);
      any_beyond = true;
    }
  if (any_beyond) ranges.beyond = without_outliers(ranges.beyond);
  return ranges;
}

}  // namespace ridgeway::detail
