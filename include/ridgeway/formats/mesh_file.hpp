// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <memory>

#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {

/// Reads the triangles of a .ply, .obj, .stl or .dae file, all its parts as one. Polygons are cut
/// into triangles; points and lines are left out. Coordinates are the file's, in single precision;
/// those of .dae files, which name a unit and an upward axis, come out in metres, z up. Throws
/// InputError, naming the file, for another format, a damaged file, and for what SolidMesh refuses.
std::shared_ptr<const SolidMesh> load_mesh(const std::filesystem::path& file);

}  // namespace ridgeway
