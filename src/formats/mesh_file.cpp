// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mesh_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>

#include "files/read_file.hpp"
#include "mapping/memory_limit.hpp"
#include "mesh_packing.hpp"
#include "ply_cloud.hpp"
#include "ridgeway/common/error.hpp"
#include "run_program.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kFormats = {"ply", "obj", "stl", "dae"};

/// The format that a file's name says, in small letters without the dot.
std::string format_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!extension.empty()) extension.erase(0, 1);
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end())
    throw InputError(file.string(), "names no format of meshes that can be read",
                     "use .ply, .obj, .stl or .dae");
  return extension;
}

/// Beside the program that runs (as in the build folder), where it lies from the folder of programs
/// (so that an installation may be moved), or where it was installed.
fs::path find_reader() {
  if (const char* named = ::secure_getenv("RIDGEWAY_MESH_READER")) return named;
  const fs::path name = "ridgeway-mesh-reader";
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder :
       {beside, beside / RIDGEWAY_READER_FROM_PROGRAMS, fs::path(RIDGEWAY_READER_FOLDER)})
    if (::access((folder / name).c_str(), X_OK) == 0) return folder / name;
  throw InputError(name.string(), "is not found, which reads meshes",
                   "install it, or name it in the variable RIDGEWAY_MESH_READER");
}

/// What reading a file of a size may take. Real files take 10 times their size in memory, and a
/// second for 10 MB; the clock on the wall is given more, as other programs may be at work.
struct ReaderLimits {
  explicit ReaderLimits(std::size_t file_bytes)
      : cpu_seconds(5 + file_bytes / 1'000'000),
        memory_bytes(
            std::min<std::uint64_t>(300'000'000 + 100 * file_bytes, available_memory_bytes())),
        program{60.0 + 10.0 * static_cast<double>(cpu_seconds), memory_bytes} {}

  std::uint64_t cpu_seconds, memory_bytes;
  ProgramLimits program;
};

[[noreturn]] void refuse(const fs::path& file, const std::string& format,
                         const std::string& problem) {
  throw InputError(file.string(), "cannot be read as ." + format + ": " + problem,
                   "repair it, or write it again");
}

MeshReply read_triangles(const fs::path& file, const Progress& progress) {
  const std::string format = format_of(file), bytes = read_file(file);
  if (format == "ply") read_ply(bytes, file.string());  // says best what is wrong
  const ReaderLimits limits(bytes.size());
  const ProgramOutput output =
      run_program(find_reader(),
                  {format, std::to_string(limits.cpu_seconds), std::to_string(limits.memory_bytes),
                   file.string()},
                  limits.program, [&] { return !progress || progress("reading a mesh", 0.0); });
  if (output.end == ProgramOutput::End::kCancelled) throw Cancelled();
  if (output.end == ProgramOutput::End::kTimedOut)
    refuse(
        file, format,
        "it takes longer than " + std::to_string(static_cast<int>(limits.program.seconds)) + " s");
  std::optional<MeshReply> reply = unpack(output.bytes);
  if (!reply) refuse(file, format, "it is damaged");
  if (!reply->problem.empty()) refuse(file, format, reply->problem);
  return *std::move(reply);
}

}  // namespace

std::shared_ptr<const SolidMesh> load_mesh(const fs::path& file, const Progress& progress) {
  const MeshReply all = read_triangles(file, progress);
  try {
    return std::make_shared<const SolidMesh>(all.vertices, all.triangles);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.where(), error.problem(), error.remedy());
  }
}

}  // namespace ridgeway
