// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/mesh_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <cstring>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/graph_export.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "sensing/test_meshes.hpp"
#include "support/png_bytes.hpp"
#include "support/sanitized.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

using testing::TriangleList;

/// From (0, 0, 0) to (1, 2, 4).
TriangleList box() { return testing::box_mesh({0.5, 1.0, 2.0}, {1.0, 2.0, 4.0}); }

std::string numbers(const Point& p) {
  return number_text(p.x()) + " " + number_text(p.y()) + " " + number_text(p.z());
}

std::string obj(const TriangleList& mesh) {
  std::string text = "mtllib none.mtl\n";
  for (const Point& v : mesh.vertices) text += "v " + numbers(v) + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + number_text(a + 1) + " " + number_text(b + 1) + " " + number_text(c + 1) + "\n";
  return text;
}

std::string ply(const TriangleList& mesh) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + number_text(mesh.vertices.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     number_text(mesh.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point& v : mesh.vertices) text += numbers(v) + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "3 " + number_text(a) + " " + number_text(b) + " " + number_text(c) + "\n";
  return text;
}

std::string stl(const TriangleList& mesh) {
  std::string text = "solid box\n";
  for (const Triangle& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : triangle) text += "vertex " + numbers(mesh.vertices[v]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

template <typename Value>
void append(std::string& bytes, Value value) {
  std::string raw(sizeof(value), '\0');
  std::memcpy(raw.data(), &value, sizeof(value));
  bytes += raw;
}

std::string binary_stl(const TriangleList& mesh) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0f);
    for (const std::uint32_t v : triangle)
      for (const double part : mesh.vertices[v]) append(bytes, static_cast<float>(part));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// In centimetres, placed twice, the second 5 m along the file's first axis.
std::string dae(const TriangleList& mesh, const std::string& up) {
  std::string places, corners;
  for (const Point& v : mesh.vertices) places += numbers(100.0 * v) + " ";
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) corners += number_text(v) + " ";
  const std::string count = number_text(mesh.vertices.size());
  return "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"><asset><unit meter=\"0.01\"/>"
         "<up_axis>" +
         up +
         "</up_axis></asset>\n<library_geometries><geometry id=\"g\"><mesh>"
         "<source id=\"s\"><float_array id=\"a\" count=\"" +
         number_text(3 * mesh.vertices.size()) + "\">" + places +
         "</float_array><technique_common><accessor source=\"#a\" count=\"" + count +
         "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>"
         "<triangles count=\"" +
         number_text(mesh.triangles.size()) +
         "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + corners +
         "</p></triangles></mesh></geometry></library_geometries>\n"
         "<library_visual_scenes><visual_scene id=\"w\">"
         "<node id=\"one\"><instance_geometry url=\"#g\"/></node>"
         "<node id=\"two\"><translate>500 0 0</translate><instance_geometry url=\"#g\"/></node>"
         "</visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url=\"#w\"/></scene></COLLADA>\n";
}

/// A chunk of a .glb file: size, type, and bytes filled up to whole words.
std::string glb_chunk(std::string bytes, const char* type, char filler) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filler);
  std::string chunk;
  append(chunk, static_cast<std::uint32_t>(bytes.size()));
  return chunk.append(type, 4).append(bytes);
}

/// In metres with y up, as the format has it, placed twice, the second 5 m along x. `image`: JSON
/// of the picture that its only material shows, empty for no material; the file holds a small PNG.
std::string glb(const TriangleList& mesh, const std::string& image) {
  std::string data;
  for (const Point& v : mesh.vertices)
    for (const double part : {v.x(), v.z(), -v.y()}) append(data, static_cast<float>(part));
  const std::size_t corners_at = data.size();
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) append(data, v);
  const std::size_t texture_at = data.size();
  for (std::size_t i = 0; i < 2 * mesh.vertices.size(); ++i) append(data, 0.5f);
  const std::size_t picture_at = data.size();
  data += png_bytes({.width = 2, .height = 2, .bits = 8, .colour = 2}, 14);
  const auto view = [](std::size_t begin, std::size_t end) {
    return R"({"buffer": 0, "byteOffset": )" + number_text(begin) + R"(, "byteLength": )" +
           number_text(end - begin) + "}";
  };
  const auto accessor = [](int number, int type, const char* kind, std::size_t count) {
    return R"({"bufferView": )" + number_text(number) + R"(, "componentType": )" +
           number_text(type) + R"(, "count": )" + number_text(count) + R"(, "type": ")" + kind +
           "\"}";
  };
  const std::string material =
      image.empty() ? ""
                    : R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture":
            {"index": 0}}}], "textures": [{"source": 0}], "images": [)" +
                          image + "]";
  const std::string json =
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
          "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2},
                                      "indices": 1)" +
      std::string(image.empty() ? "" : R"(, "material": 0)") + R"(}]}], "accessors": [)" +
      accessor(0, 5126, "VEC3", mesh.vertices.size()) + "," +
      accessor(1, 5125, "SCALAR", 3 * mesh.triangles.size()) + "," +
      accessor(2, 5126, "VEC2", mesh.vertices.size()) + R"(], "bufferViews": [)" +
      view(0, corners_at) + "," + view(corners_at, texture_at) + "," +
      view(texture_at, picture_at) + "," + view(picture_at, data.size()) +
      R"(], "buffers": [{"byteLength": )" + number_text(data.size()) + "}]" + material + "}";
  const std::string body = glb_chunk(json, "JSON", ' ') + glb_chunk(data, "BIN\0", '\0');
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(12 + body.size()));
  return file + body;
}

void expect_box(const SolidMesh& mesh, const Point& high) {
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_LT(mesh.low().norm(), 1e-6);
  EXPECT_LT((mesh.high() - high).norm(), 1e-6);
  EXPECT_NEAR(mesh.distance({0.5, 1.0, 2.0}).distance, -0.5, 1e-6);
}

TEST(MeshFile, EveryFormatGivesTheSameBox) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] :
       std::vector<std::pair<std::string, std::string>>{{"box.obj", obj(box())},
                                                        {"box.ply", ply(box())},
                                                        {"box.stl", stl(box())},
                                                        {"BOX.STL", binary_stl(box())}}) {
    write_whole(folder / name, bytes);
    const auto mesh = load_mesh(folder / name);
    EXPECT_EQ(mesh->triangle_count(), 12u) << name;
    expect_box(*mesh, {1.0, 2.0, 4.0});
  }
}

TEST(MeshFile, ColladaComesInMetresWithZUp) {
  const TemporaryFolder folder;
  write_whole(folder / "z.dae", dae(box(), "Z_UP"));
  const auto z_up = load_mesh(folder / "z.dae");
  EXPECT_EQ(z_up->triangle_count(), 24u);
  expect_box(*z_up, {6.0, 2.0, 4.0});
  EXPECT_NEAR(z_up->distance({5.5, 1.0, 2.0}).distance, -0.5, 1e-6);
  EXPECT_NEAR(z_up->distance({3.0, 1.0, 2.0}).distance, 2.0, 1e-6);
  write_whole(folder / "y.dae", dae(box(), "Y_UP"));
  const auto y_up = load_mesh(folder / "y.dae");
  EXPECT_LT((y_up->low() - Point(0.0, -4.0, 0.0)).norm(), 1e-6);
  EXPECT_LT((y_up->high() - Point(6.0, 0.0, 2.0)).norm(), 1e-6);
}

TEST(MeshFile, GltfComesInMetresWithZUpWhateverItsTextures) {
  const TemporaryFolder folder;
  for (const char* image : {"", R"({"bufferView": 3, "mimeType": "image/png"})",
                            R"({"uri": "not/there.png"})", R"({"uri": "../../../etc/passwd"})"}) {
    write_whole(folder / "box.glb", glb(box(), image));
    const auto mesh = load_mesh(folder / "box.glb");
    EXPECT_EQ(mesh->triangle_count(), 24u) << image;
    expect_box(*mesh, {6.0, 2.0, 4.0});
    EXPECT_NEAR(mesh->distance({3.0, 1.0, 2.0}).distance, 2.0, 1e-6);
  }
}

TEST(MeshFile, ListsAmongTheVerticesOfAPlyFileArePassedOver) {
  const TemporaryFolder folder;
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty list uchar float tags\n"
      "property float y\nproperty float z\nelement face 12\n"
      "property list uchar int vertex_indices\nend_header\n";
  const TriangleList mesh = box();
  for (const Point& v : mesh.vertices)
    text += number_text(v.x()) + (v.x() > 0.0 ? " 2 0.5 7 " : " 0 ") + number_text(v.y()) + " " +
            number_text(v.z()) + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "3 " + number_text(a) + " " + number_text(b) + " " + number_text(c) + "\n";
  write_whole(folder / "box.ply", text);
  expect_box(*load_mesh(folder / "box.ply"), {1.0, 2.0, 4.0});
}

TEST(MeshFile, ReadsWhatExportWrites) {
  const TemporaryFolder folder;
  const TriangleList ball = testing::sphere_mesh(2.0, 3);
  SurfaceMesh surface{ball.vertices, ball.vertices, ball.triangles};
  for (Eigen::Vector3d& normal : surface.normals) normal.normalize();
  write_mesh_ply(surface, folder / "ball.ply");
  const auto mesh = load_mesh(folder / "ball.ply");
  EXPECT_EQ(mesh->triangle_count(), ball.triangles.size());
  EXPECT_TRUE(mesh->is_closed());
  EXPECT_NEAR(mesh->distance({0.0, 0.0, 3.0}).distance, 1.0, 1e-6);
}

TEST(MeshFile, WhatIsNoMeshIsRefusedByName) {
  const TemporaryFolder folder;
  TriangleList bad_index = box(), bad_vertex = box();
  bad_index.triangles[3][1] = 99;
  bad_vertex.vertices[2].x() = 1e39;  // infinite in single precision
  const std::string points = ply({box().vertices, {}});
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"none.obj", ""},
           {"text.stl", "nothing of that kind"},
           {"text.ply", "nothing of that kind"},
           {"text.dae", "nothing of that kind"},
           {"box.glb", obj(box())},
           {"box.stl", ply(box())},
           {"box.dae", obj(box())},
           {"points.ply", points},
           {"index.ply", ply(bad_index)},
           {"index.obj", obj(bad_index)},
           {"index.dae", dae(bad_index, "Z_UP")},
           {"vertex.ply", ply(bad_vertex)},
           {"vertex.stl", stl(bad_vertex)},
           {"thin.obj", "v 0 0 0\nv 1 0 0\nv 0 0 0\nf 1 2 3\n"}}) {
    if (!bytes.empty()) write_whole(folder / name, bytes);
    try {
      load_mesh(folder / name);
      ADD_FAILURE() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

/// Nodes that each place the next one twice: 2^40 boxes in four kilobytes.
TEST(MeshFile, AFileThatPlacesItsPartsWithoutEndIsRefusedWithinItsLimits) {
  const TemporaryFolder folder;
  std::string text = dae(box(), "Z_UP"), nodes = "<library_nodes>";
  constexpr int kDepth = 40;
  for (int i = 0; i < kDepth; ++i) {
    const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
    nodes.append("<node id=\"n").append(std::to_string(i)).append("\">");
    nodes.append(next).append(next).append("</node>");
  }
  nodes += "<node id=\"n" + std::to_string(kDepth) +
           "\"><instance_geometry url=\"#g\"/></node></library_nodes>\n";
  text.insert(text.find("<library_visual_scenes>"), nodes);
  const std::string place = "<instance_geometry url=\"#g\"/></node></visual_scene>";
  text.replace(text.find(place), place.size(),
               "<instance_node url=\"#n0\"/></node></visual_scene>");
  write_whole(folder / "bomb.dae", text);
  if (testing::kIsSanitized) {  // sanitizers take memory of their own
    EXPECT_THROW(load_mesh(folder / "bomb.dae"), InputError);
    return;
  }
  // In a process that has read nothing else: what its children took is the peak of all of them, and
  // of itself when it started them.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto read_and_leave = [&] {
    try {
      load_mesh(folder / "bomb.dae");
    } catch (const InputError&) {
      rusage used{};
      constexpr long kMost = 350'000;  // kilobytes
      if (::getrusage(RUSAGE_CHILDREN, &used) == 0) std::exit(used.ru_maxrss < kMost ? 0 : 2);
    }
    std::exit(1);
  };
  EXPECT_EXIT(read_and_leave(), ::testing::ExitedWithCode(0), "");
}

/// Single precision leaves a part of a voxel of coordinates far from zero.
TEST(MeshFile, MapsAccountForWhatSinglePrecisionLoses) {
  const TemporaryFolder folder;
  const auto load_at = [&](double far, std::string& notes) {
    TriangleList moved = box();
    for (Point& v : moved.vertices) v.y() += far;
    std::string text = ply(moved);
    for (std::size_t at = 0; (at = text.find("float", at)) != std::string::npos;)
      text.replace(at, 5, "double");
    write_whole(folder / "box.ply", text);
    LoadNotes told;
    OccupancyMap map = load_map(folder / "box.ply", {.voxel_size = 0.1}, &told);
    for (const std::string& note : told.notes) notes += note + "\n";
    return map;
  };
  std::string near, far;
  load_at(0.03, near);
  EXPECT_EQ(near.find("single precision"), std::string::npos) << near;
  // At 400 km they are off by 16 mm: the box is that much thicker on all sides, and never thinner.
  for (const double rest : {0.0, 0.011, 0.049, 0.087}) {
    far.clear();
    const double y = 400'000.0 + rest;
    const OccupancyMap map = load_at(y, far);
    EXPECT_NE(far.find("single precision"), std::string::npos) << far;
    for (const double side : {y, y + 2.0}) {
      const VoxelIndex touched = voxel_at({0.55, side, 2.05}, 0.1);
      EXPECT_EQ(map.at(touched - map.origin), VoxelState::kOccupied) << rest;
    }
  }
  EXPECT_THROW(load_at(5'400'000.0, far), InputError);
}

TEST(MeshFile, StopsWhenItsCallerDoesNotWantToGoOn) {
  const TemporaryFolder folder;
  write_whole(folder / "box.obj", obj(box()));
  EXPECT_THROW(load_mesh(folder / "box.obj", [](std::string_view, double) { return false; }),
               Cancelled);
}

TEST(MeshFile, AReaderThatIsNotThereOrSaysNonsenseIsRefused) {
  const TemporaryFolder folder;
  write_whole(folder / "box.obj", obj(box()));
  for (const auto& [program, problem] :
       std::vector<std::pair<std::string, std::string>>{{"/no/such/reader", "/no/such/reader"},
                                                        {"/bin/true", "damaged"},
                                                        {"/bin/echo", "damaged"}}) {
    ::setenv("RIDGEWAY_MESH_READER", program.c_str(), 1);
    try {
      load_mesh(folder / "box.obj");
      ADD_FAILURE() << program;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
    }
    ::unsetenv("RIDGEWAY_MESH_READER");
  }
}

TEST(MeshFile, DamageIsReadOrRefusedButNeverCrashes) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.obj", obj(box())},        {"a.ply", ply(box())},         {"a.stl", stl(box())},
      {"b.stl", binary_stl(box())}, {"a.dae", dae(box(), "Z_UP")}, {"a.glb", glb(box(), "")}};
  int refused = 0;
  Random random(1);
  for (int i = 0; i < 150; ++i) {
    auto [name, bytes] = files[static_cast<std::size_t>(i) % files.size()];
    if (i % 4 == 0) bytes.resize(1 + random.below(bytes.size() - 1));
    for (int k = 0; k < i % 4; ++k)
      bytes[random.below(bytes.size())] = "0123456789-. \n\xff\0"[random.below(16)];
    write_whole(folder / name, bytes);
    try {
      load_mesh(folder / name);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 30);
  EXPECT_LT(refused, 150);
}

}  // namespace
}  // namespace ridgeway
