// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <memory>

#include "ridgeway/common/progress.hpp"
#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {

/// Reads the triangles of a .ply, .obj, .stl or .dae file, all its parts as one. Polygons are cut
/// into triangles; points and lines are left out. Coordinates are the file's, in single precision;
/// those of .dae files, which name a unit and an upward axis, come out in metres, z up. Throws
/// InputError, naming the file, for another format, a damaged file, and for what SolidMesh refuses.
///
/// The file is read by a program of its own, ridgeway-mesh-reader, under limits of memory and time
/// that grow with the file, as the library for these formats does not stand up to damaged ones. It
/// is looked for beside the running program, in ../libexec/ridgeway from there, where Ridgeway was
/// installed, or before all where the environment variable RIDGEWAY_MESH_READER says. `progress` is
/// asked while it works; Cancelled is thrown when that says so.
std::shared_ptr<const SolidMesh> load_mesh(const std::filesystem::path& file,
                                           const Progress& progress = {});

}  // namespace ridgeway
