// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

#include "ridgeway/formats/point_cloud.hpp"

namespace ridgeway {

/// Text with a point a line: x, y, z and any further columns, which are ignored, separated by
/// blanks, tabs, commas or semicolons. Empty lines, comments ("#", "//") and one line of column
/// names that begins with x are passed over. Throws InputError naming file and line.
PointCloud read_xyz(std::string_view bytes, const std::string& name);

}  // namespace ridgeway
