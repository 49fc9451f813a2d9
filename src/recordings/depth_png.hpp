// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>

#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway {

/// Depths of a 16-bit grey PNG: value / units_per_metre; 0 and `none` stand for no measurement.
/// Throws InputError, naming the file, for any other image and for a damaged one.
DepthImage read_depth_png(const std::filesystem::path& file, double units_per_metre,
                          int none = 65535);

/// Writes depths to a 16-bit grey PNG, whole or not at all, rounded to a unit; those that do not
/// fit as 0.
void write_depth_png(const DepthImage& image, const std::filesystem::path& file,
                     double units_per_metre);

}  // namespace ridgeway
