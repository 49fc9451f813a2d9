// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>

#include "ridgeway/mapping/surface_mesh.hpp"

namespace ridgeway {

/// Binary PLY: vertices (x, y, z as doubles in metres, nx, ny, nz) and triangles. The file is
/// replaced whole or not at all; throws InputError where it cannot be written.
void write_mesh_ply(const SurfaceMesh& mesh, const std::filesystem::path& path);

}  // namespace ridgeway
