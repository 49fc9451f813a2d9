// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>

#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// A simulated world as YAML: `name`, and lists `planes` {point, normal} (open where the normal
/// points; of any length), `boxes` {centre, size}, `spheres` {centre, radius}, upright `cylinders`
/// {centre, radius, height} and `meshes` {file, and if wanted scale, rotation [roll, pitch, yaw] in
/// degrees, translation, in this order}; metres. `timed` lists solids that come and go: `from` and
/// `until`, seconds, either may be left out, and boxes, spheres and cylinders. The file of a mesh
/// (load_mesh) is found from the folder of this one. Throws InputError, with the line, for unknown
/// or missing keys, for what is no number and for a mesh that cannot be read.
World load_world(const std::filesystem::path& file);

/// The same text for the same world; load_world gives it back, meshes with the whole path of their
/// file. Throws InputError for a mesh without one.
std::string world_yaml(const World& world);
/// Writes it to a file, whole or not at all.
void save_world(const World& world, const std::filesystem::path& file);

}  // namespace ridgeway
