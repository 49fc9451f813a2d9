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
#include "sensing/test_meshes.hpp"
#include "support/temporary_folder.hpp"

#if defined(__has_feature)  // clang
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

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

std::string binary_stl(const TriangleList& mesh) {
  std::string bytes(80, ' ');
  const auto append = [&](auto value) {
    std::string raw(sizeof(value), '\0');
    std::memcpy(raw.data(), &value, sizeof(value));
    bytes += raw;
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(0.0f);
    for (const std::uint32_t v : triangle)
      for (const double part : mesh.vertices[v]) append(static_cast<float>(part));
    append(std::uint16_t{0});
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
    nodes += "<node id=\"n" + std::to_string(i) + "\">" + next + next + "</node>";
  }
  nodes += "<node id=\"n" + std::to_string(kDepth) +
           "\"><instance_geometry url=\"#g\"/></node></library_nodes>\n";
  text.insert(text.find("<library_visual_scenes>"), nodes);
  const std::string place = "<instance_geometry url=\"#g\"/></node></visual_scene>";
  text.replace(text.find(place), place.size(),
               "<instance_node url=\"#n0\"/></node></visual_scene>");
  write_whole(folder / "bomb.dae", text);
  EXPECT_THROW(load_mesh(folder / "bomb.dae"), InputError);
  rusage used{};
  ASSERT_EQ(::getrusage(RUSAGE_CHILDREN, &used), 0);
  if (!kIsSanitized) {  // sanitizers take memory of their own
    EXPECT_LT(used.ru_maxrss, 350'000) << "kilobytes";
  }
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
  const std::vector<std::pair<std::string, std::string>> files = {{"a.obj", obj(box())},
                                                                  {"a.ply", ply(box())},
                                                                  {"a.stl", stl(box())},
                                                                  {"b.stl", binary_stl(box())},
                                                                  {"a.dae", dae(box(), "Z_UP")}};
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
