// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The program ridgeway-mesh-reader: load_mesh starts it, and reads what it writes
// (mesh_packing.hpp). Assimp 5.2 trusts what files say of themselves; where they lie it crashes,
// hangs, fills memory or writes past the end of its own. So it works here, under limits, and not in
// the library.
#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "files/read_file.hpp"
#include "files/text.hpp"
#include "mesh_packing.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kMostTriangles = 100'000'000;
constexpr const char* kTooLarge = "reading it takes more memory than such a file may";

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

void add_part(const aiMesh& part, const aiMatrix4x4& T_file_part, MeshReply& all) {
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
bool collect(const aiScene& scene, MeshReply& all) {
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

/// No other file is there, whatever this one may name.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// The same as Assimp takes it: it passes over indented lines of .obj files, and knows keywords of
/// .stl files in small letters alone.
std::string as_understood(const std::string& format, std::string bytes) {
  const bool is_text = bytes.find('\0') == std::string::npos;
  if (format == "stl" && is_text) return in_small_letters(std::move(bytes));
  if (format != "obj") return bytes;
  bool begins = true;
  std::erase_if(bytes, [&begins](char c) {
    const bool is_indent = begins && (c == ' ' || c == '\t');
    begins = c == '\n' || is_indent;
    return is_indent;
  });
  return bytes;
}

/// What Assimp calls bytes that it reads from memory is no name for people.
std::string without_its_name(std::string problem) {
  for (const std::string_view name : {" for $$$___magic___$$$.", "$$$___magic___$$$."})
    if (const std::size_t at = problem.find(name); at != std::string::npos) problem.resize(at);
  return problem;
}

MeshReply read_mesh(const std::string& format, const std::string& bytes) {
  Assimp::Importer importer;
  keep_format(format, importer);
  importer.SetIOHandler(new NoFiles);  // it is the importer's
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                     aiProcess_Triangulate, format.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string problem = without_its_name(importer.GetErrorString());
    if (problem.find("bad_alloc") != std::string::npos) return {kTooLarge, {}, {}};
    return {problem.empty() ? "it is damaged" : problem, {}, {}};
  }
  MeshReply all;
  if (!collect(*scene, all)) return {"it has more than 100 million triangles", {}, {}};
  if (all.vertices.empty() || all.triangles.empty()) return {"it has no triangles", {}, {}};
  if (format == "dae" || format == "glb" || format == "gltf")  // handed out in metres with y up
    for (Point& v : all.vertices) v = {v.x(), -v.z(), v.y()};
  return all;
}

std::vector<std::byte> reply_to(const std::string& format, const std::string& file) {
  try {
    return pack(read_mesh(format, as_understood(format, read_file(file))));
  } catch (const std::bad_alloc&) {
    return pack({kTooLarge, {}, {}});
  } catch (const std::exception& error) {
    return pack({error.what(), {}, {}});
  }
}

void limit(decltype(RLIMIT_CPU) what, std::uint64_t most) {
  const rlimit bounds{most, most};
  ::setrlimit(what, &bounds);
}

/// Sanitizers map terabytes. GCC tells of them by a macro, Clang by a feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMapsTerabytes = true;
#elif defined(__has_feature)
constexpr bool kMapsTerabytes = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kMapsTerabytes = false;
#endif

/// No more processor time and memory than that; an end with the thread that waits for the reply; no
/// core files, and no files that the host left open.
void confine(std::uint64_t seconds, std::uint64_t bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::close_range(STDERR_FILENO + 1, std::numeric_limits<unsigned>::max(), 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  if (!kMapsTerabytes) limit(RLIMIT_AS, bytes);
}

bool write_all(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

int run(std::span<char* const> words) {
  if (words.size() != 5) return EXIT_FAILURE;
  const auto seconds = to_number<std::uint64_t>(words[2]),
             bytes = to_number<std::uint64_t>(words[3]);
  if (!seconds || !bytes) return EXIT_FAILURE;
  confine(*seconds, *bytes);
  return write_all(reply_to(words[1], words[4])) ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace ridgeway

int main(int argc, char** argv) {
  return ridgeway::run(std::span<char* const>(argv, static_cast<std::size_t>(argc)));
}
