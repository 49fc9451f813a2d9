// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "esdf/distance_sweeps.hpp"
#include "esdf/plain_distances.hpp"

namespace ridgeway::testing {

/// Whether distance and site of a voxel are those of the plain form; `obstacles` in (z, y, x)
/// order.
inline ::testing::AssertionResult has_plain_site(const BlockLayout& layout,
                                                 const detail::NearestSites& nearest, VoxelId id,
                                                 const std::vector<VoxelIndex>& obstacles) {
  const VoxelIndex v = layout.index_of(id);
  const detail::PlainNearest plain = detail::plain_nearest(v, obstacles);
  const SiteOffset o = nearest.offset[id];
  const VoxelIndex at = v + VoxelIndex{o.x, o.y, o.z};
  if (nearest.squared[id] == plain.squared && at == plain.site)
    return ::testing::AssertionSuccess();
  const auto text = [](const VoxelIndex& i) {
    return std::to_string(i.x) + "," + std::to_string(i.y) + "," + std::to_string(i.z);
  };
  return ::testing::AssertionFailure()
         << "voxel " << text(v) << " has " << nearest.squared[id] << " to " << text(at) << ", not "
         << plain.squared << " to " << text(plain.site);
}

}  // namespace ridgeway::testing
