// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// How far sites are kept, voxels. `farthest`: the map's own limit, voxels.
inline double site_limit(double farthest) {
  return std::min(farthest, static_cast<double>(kFarthestSite));
}

/// The largest 4 d^2 of a site that is kept. The limit counts, with a relative slack of 1e-9 on the
/// distance, so that a whole number of voxels is no matter of rounding: 4e-9 outweighs what
/// least_clearance takes off. A build, a live map and the check of a file must agree to the bit.
inline std::uint32_t largest_kept(double farthest) {
  return static_cast<std::uint32_t>(least_clearance(site_limit(farthest), 1.0).value *
                                    (1.0 + 4e-9));
}

}  // namespace ridgeway::detail
