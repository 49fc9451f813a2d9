// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

#include "ridgeway/formats/point_cloud.hpp"

namespace ridgeway {

/// Does a text begin like a .pcd file?
bool is_pcd(std::string_view bytes);

/// Point Cloud Data, ascii, binary and binary_compressed, versions 0.5 to 0.7. The fields x, y and
/// z are found by name, in any order and of any type, among any others; the viewpoint is not
/// applied (PCL does not either). Throws InputError naming file and byte or line.
PointCloud read_pcd(std::string_view bytes, const std::string& name);

}  // namespace ridgeway
