// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ridgeway {

/// For each image the place of the pose nearest in time, each pose once, nearest pairs first, none
/// farther apart than a gap. Times in seconds, in any order.
std::vector<std::optional<std::size_t>> associate(std::span<const double> images,
                                                  std::span<const double> poses,
                                                  double longest_gap);

}  // namespace ridgeway
