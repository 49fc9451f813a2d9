// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

#include "ridgeway/formats/point_cloud.hpp"

namespace ridgeway {

/// Does a file begin like a .ply file?
bool is_ply(std::string_view bytes);

/// Whether its header says that it has faces. Throws InputError for a header that is damaged.
bool has_ply_faces(std::string_view bytes, const std::string& name);

/// Throws InputError unless all faces are in one element `face`: Assimp 5.2 reads one alone, and of
/// a strip of triangles the last.
void require_one_list_of_faces(std::string_view bytes, const std::string& name);

/// The vertices of a .ply file, ascii or binary in either byte order: properties x, y and z of the
/// element `vertex`, among any other properties and elements, lists too. Faces are counted, not
/// read. Throws InputError naming file and byte.
PointCloud read_ply(std::string_view bytes, const std::string& name);

}  // namespace ridgeway
