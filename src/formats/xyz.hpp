// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

#include "ridgeway/formats/point_cloud.hpp"

namespace ridgeway {

/// Text with a point a line: x, y and z, separated by blanks, tabs, commas or semicolons. Empty
/// lines and comments ("#", "//") are passed over.
///
/// Further columns are ignored where the first line, or a comment before the first point, names all
/// columns: x, y and z in any place, colour (r g b), intensity, normals (nx ny nz), time, labels
/// and the like, with or without capitals, quotes and underscores. Rows of more than three columns
/// that are not named are refused, and so are names that points do not have: the corners of boxes
/// begin with x, y, z too, and as points they would be walls with nothing between. Throws
/// InputError naming file and line.
PointCloud read_xyz(std::string_view bytes, const std::string& name);

}  // namespace ridgeway
