// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/mesh_file.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "files/little_endian.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/files/read_file.hpp"
#include "ridgeway/formats/ply_cloud.hpp"
#include "run_apart.hpp"

namespace ridgeway {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kMostTriangles = 100'000'000;
constexpr std::array<const char*, 4> kFormats = {"ply", "obj", "stl", "dae"};

/// The format that a file's name says, in small letters without the dot.
std::string format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!extension.empty()) extension.erase(0, 1);
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end())
    throw InputError(file.string(), "names no format of meshes that can be read",
                     "use .ply, .obj, .stl or .dae");
  return extension;
}

/// Leaves an importer the one format alone: by itself it tries all that it knows on any bytes.
void keep_format(const std::string& format, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const one = importer.GetImporter(i);
    std::set<std::string> extensions;
    one->GetExtensionList(extensions);
    if (extensions.contains(format)) continue;
    importer.UnregisterLoader(one);
    const std::unique_ptr<Assimp::BaseImporter> removed(one);  // it is ours now
  }
}

struct Triangles {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
};

void add_part(const aiMesh& part, const aiMatrix4x4& T_file_part, Triangles& all) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D v = T_file_part * part.mVertices[i];
    all.vertices.emplace_back(v.x, v.y, v.z);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    Triangle triangle{};
    for (unsigned k = 0; k < 3; ++k) {
      // One that is out of range must not become a vertex of another part.
      const bool is_there = face.mIndices[k] < part.mNumVertices;
      triangle[k] = is_there ? first + face.mIndices[k] : 0xffffffffu;
    }
    all.triangles.push_back(triangle);
  }
}

/// All parts, each as often as it is placed. False if there are too many.
bool collect(const aiScene& scene, Triangles& all) {
  struct Open {
    const aiNode* node;
    aiMatrix4x4 T_file_parent;
  };
  std::vector<Open> open = {{scene.mRootNode, {}}};
  while (!open.empty()) {
    const auto [node, T_file_parent] = open.back();
    open.pop_back();
    const aiMatrix4x4 T_file_node = T_file_parent * node->mTransformation;
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      add_part(*scene.mMeshes[node->mMeshes[i]], T_file_node, all);
      if (std::max(all.vertices.size(), all.triangles.size()) > kMostTriangles) return false;
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i)
      open.push_back({node->mChildren[i], T_file_node});
  }
  return true;
}

// What the reader hands over: 1, two counts, vertices, triangles; or 0 and what is wrong.

template <typename Number>
void append(Bytes& bytes, const Number* numbers, std::size_t count) {
  const std::size_t end = bytes.size(), size = count * sizeof(Number);
  bytes.resize(end + size);
  std::memcpy(bytes.data() + end, numbers, size);
}

Bytes packed(const Triangles& all) {
  const std::array<std::uint64_t, 2> counts = {all.vertices.size(), all.triangles.size()};
  Bytes bytes(1, std::byte{1});
  append(bytes, counts.data(), counts.size());
  append(bytes, all.vertices.front().data(), 3 * all.vertices.size());
  append(bytes, all.triangles.front().data(), 3 * all.triangles.size());
  return bytes;
}

Triangles unpacked(const Bytes& bytes) {
  Triangles all;
  all.vertices.resize(number_at<std::uint64_t>(bytes, 1, 0));
  all.triangles.resize(number_at<std::uint64_t>(bytes, 1, 1));
  const std::size_t first = 1 + 2 * sizeof(std::uint64_t),
                    size = sizeof(Point) * all.vertices.size();
  std::memcpy(all.vertices.front().data(), bytes.data() + first, size);
  std::memcpy(all.triangles.front().data(), bytes.data() + first + size,
              sizeof(Triangle) * all.triangles.size());
  return all;
}

Bytes packed(const std::string& problem) {
  Bytes bytes(1);
  for (const char c : problem.substr(0, 100))
    bytes.push_back(static_cast<std::byte>(c >= ' ' && c <= '~' ? c : ' '));
  return bytes;
}

Bytes read_packed(const std::string& bytes, const std::string& format) {
  Assimp::Importer importer;
  keep_format(format, importer);
  // From memory, so that no other file is opened that this one may name.
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                     aiProcess_Triangulate, format.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) return packed(importer.GetErrorString());
  Triangles all;
  if (!collect(*scene, all)) return packed("it has more than 100 million triangles");
  if (all.vertices.empty() || all.triangles.empty()) return packed("it has no triangles");
  if (format == "dae")  // which Assimp hands out in metres with y up
    for (Point& v : all.vertices) v = {v.x(), -v.z(), v.y()};
  return packed(all);
}

Triangles read_triangles(const std::filesystem::path& file) {
  const std::string format = format_of(file), bytes = read_file(file);
  // Assimp 5.2 trusts what .ply and .dae files say of themselves, and crashes or hangs where it is
  // wrong. Our own reader of .ply files says what is.
  if (format == "ply") read_ply(bytes, file.string());
  const auto seconds = static_cast<unsigned>(5 + bytes.size() / 1'000'000);
  const std::optional<Bytes> read = run_apart([&] { return read_packed(bytes, format); }, seconds);
  if (read && read->front() == std::byte{1}) return unpacked(*read);
  const std::string problem =
      read ? std::string(reinterpret_cast<const char*>(read->data()) + 1, read->size() - 1)
           : "it is damaged";
  throw InputError(file.string(), "cannot be read as ." + format + ": " + problem,
                   "repair it, or write it again");
}

}  // namespace

std::shared_ptr<const SolidMesh> load_mesh(const std::filesystem::path& file) {
  const Triangles all = read_triangles(file);
  try {
    return std::make_shared<const SolidMesh>(all.vertices, all.triangles);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.where(), error.problem(), error.remedy());
  }
}

}  // namespace ridgeway
