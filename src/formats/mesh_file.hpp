// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mapping/mesh_map.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {

/// The format of a mesh by what its bytes say, or where they say nothing (.obj) by its name: "dae",
/// "glb", "gltf", "obj", "ply" or "stl"; empty for what is no mesh, such as a .ply file without
/// faces.
std::string mesh_format(std::string_view bytes, const std::filesystem::path& file);

/// STL in words, in capitals or not. Else it is binary: a header that ends in the number of
/// triangles, and so many bytes for each.
bool is_text_stl(std::string_view bytes);
inline constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

/// What a mesh file says of its frame; .dae files name both, .glb files are in metres with y up.
struct MeshFrame {
  std::optional<double> unit;  ///< metres
  std::optional<UpAxis> up;
};
MeshFrame mesh_frame(const std::string& format, std::string_view bytes);

/// The triangles of a mesh file in metres, z up: its own frame, unless another is given; what
/// neither says is metres and z up. With what single precision leaves of its coordinates. Throws
/// InputError as load_mesh does.
TriangleSoup read_mesh(const std::filesystem::path& file, std::string_view bytes,
                       const std::string& format, const MeshFrame& given,
                       const Progress& progress = {});

/// Reads the triangles of a .ply, .obj, .stl, .dae or .glb file, all its parts as one. Polygons are
/// cut into triangles; points and lines are left out. Coordinates are the file's, in single
/// precision; those of .dae files, which name a unit and an upward axis, and of .glb files come out
/// in metres, z up. Throws InputError, naming the file, for another format, a damaged file, and for
/// what SolidMesh refuses.
///
/// The file is read by a program of its own, ridgeway-mesh-reader, under limits of memory and time
/// that grow with the file, as the library for these formats does not stand up to damaged ones. It
/// is looked for beside the running program, in ../libexec/ridgeway from there, where Ridgeway was
/// installed, or before all where the environment variable RIDGEWAY_MESH_READER says. `progress` is
/// asked while it works; Cancelled is thrown when that says so.
std::shared_ptr<const SolidMesh> load_mesh(const std::filesystem::path& file,
                                           const Progress& progress = {});

}  // namespace ridgeway
