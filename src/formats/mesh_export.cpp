// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "common/number_text.hpp"
#include "files/atomic_file.hpp"
#include "files/little_endian.hpp"
#include "ridgeway/formats/graph_export.hpp"

namespace ridgeway {

void write_mesh_ply(const SurfaceMesh& mesh, const std::filesystem::path& path) {
  AtomicFile file(path);
  file.write(
      "ply\nformat binary_little_endian 1.0\ncomment surface of a map, metres\n"
      "element vertex " +
      number_text(mesh.vertices.size()) +
      "\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "element face " +
      number_text(mesh.triangles.size()) +
      "\n"
      "property list uchar int vertex_indices\nend_header\n");
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (const double part : mesh.vertices[i]) append_number(bytes, part);
    for (const double part : mesh.normals[i]) append_number(bytes, static_cast<float>(part));
  }
  for (const Triangle& triangle : mesh.triangles) {
    append_number(bytes, std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) append_number(bytes, vertex);
  }
  file.write(bytes);
  file.commit();
}

}  // namespace ridgeway
