// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Meshes of which Assimp reads a part, and does not say so: a wall that is left out is a way.
#include <gtest/gtest.h>

#include "formats/mesh_file.hpp"
#include "ridgeway/common/error.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

const char* const kFloor = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n";

std::string ply(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\n" +
         elements + "end_header\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n" + body;
}

std::string gltf(const std::string& more, const std::string& uri = "data:;base64,AAAA") {
  return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 3, "uri": ")" + uri + "\"}]" +
         more + "}";
}

std::string stl(std::uint32_t count, std::size_t bytes) {
  std::string file(80, ' ');
  file.append(reinterpret_cast<const char*>(&count), 4);
  return file + std::string(bytes - file.size(), '\0');
}

TEST(MeshWholeness, WhatWouldBeReadInPartIsRefused) {
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const TemporaryFolder folder;
  for (const auto& [name, bytes, what] : std::vector<std::array<std::string, 3>>{
           {"a.ply", ply(strips, "4 0 1 2 3\n"), "has faces in the element 'tristrips'"},
           {"a.ply", ply(faces + strips, "3 0 1 2\n4 0 1 2 3\n"), "tristrips"},
           {"a.ply", ply(faces + faces, "3 0 1 2\n3 0 2 3\n"), "more than one element face"},
           {"a.gltf", gltf(R"(, "extensionsRequired": ["KHR_mesh_quantization"])"),
            "needs the extension 'KHR_mesh_quantization'"},
           {"a.gltf", gltf(R"(, "nodes": [{"extensions": {"EXT_mesh_gpu_instancing": {}}}])"),
            "needs the extension 'EXT_mesh_gpu_instancing'"},
           {"a.gltf", gltf("", "a.bin"), "in another file, 'a.bin'"},
           {"a.obj", kFloor + std::string("f 1 2 3\n  surf 0 1 0 1 1 2 3 4\n"), "curved surfaces"},
           {"a.stl", stl(2, 194), "2 triangles, which are 184 bytes, and has 194"},
           {"a.stl", stl(1, 184), "1 triangles, which are 134 bytes, and has 184"}}) {
    const std::filesystem::path file = folder / name;
    write_whole(file, bytes);
    const std::string told = refusal([&] { load_mesh(file); });
    EXPECT_NE(told.find(what), std::string::npos) << name << ": " << told;
  }
}

TEST(MeshWholeness, IndentedAndCapitalLettersAreReadToo) {
  const TemporaryFolder folder;
  write_whole(folder / "a.obj", kFloor + std::string("  f 1 2 3\n\tf 1 3 4\n"));
  EXPECT_EQ(load_mesh(folder / "a.obj")->triangle_count(), 2u);
  write_whole(folder / "a.stl",
              "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\n"
              "ENDLOOP\nENDFACET\nENDSOLID A\n");
  EXPECT_EQ(load_mesh(folder / "a.stl")->triangle_count(), 1u);
}

/// Extensions that only colours need are no reason, and a file beside is not looked at.
TEST(MeshWholeness, ColoursAreNoMatter) {
  const TemporaryFolder folder;
  write_whole(folder / "a.gltf", gltf(R"(, "extensionsRequired": ["KHR_materials_unlit"])"));
  const std::string told = refusal([&] { load_mesh(folder / "a.gltf"); });
  EXPECT_EQ(told.find("extension"), std::string::npos) << told;  // it has no triangles
}

}  // namespace
}  // namespace ridgeway
