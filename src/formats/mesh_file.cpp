// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mesh_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "files/little_endian.hpp"
#include "files/read_file.hpp"
#include "files/text.hpp"
#include "mapping/memory_limit.hpp"
#include "mesh_packing.hpp"
#include "mesh_wholeness.hpp"
#include "ply_cloud.hpp"
#include "ridgeway/common/error.hpp"
#include "run_program.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kFormats = {"ply", "obj", "stl", "dae", "glb", "gltf"};

/// extension_of() without its dot.
std::string ending_of(const fs::path& file) {
  std::string extension = extension_of(file);
  if (!extension.empty()) extension.erase(0, 1);
  return extension;
}

/// The format that a file's name says.
std::string format_of(const fs::path& file) {
  std::string extension = ending_of(file);
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end())
    throw InputError(file.string(), "names no format of meshes that can be read",
                     "use .ply, .obj, .stl, .dae or .glb");
  return extension;
}

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < kStlHeader) return false;
  const auto count = number_at<std::uint32_t>(std::as_bytes(std::span(bytes)), kStlHeader - 4);
  return bytes.size() == kStlHeader + kStlTriangle * std::size_t{count};
}

/// The value of an attribute in the first element of a name, or its text; nothing where it is not
/// there. Enough for the two facts that the head of a COLLADA file is asked for.
std::optional<std::string_view> xml_value(std::string_view xml, std::string_view element,
                                          std::string_view attribute) {
  const std::size_t at = xml.find(std::string("<").append(element));
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t end = xml.find('>', at);
  if (end == std::string_view::npos) return std::nullopt;
  if (attribute.empty()) return xml.substr(end + 1, xml.find('<', end) - end - 1);
  const std::string_view tag = xml.substr(at, end - at);
  std::size_t value = tag.find(std::string(" ").append(attribute).append("="));
  if (value == std::string_view::npos) return std::nullopt;
  value += attribute.size() + 3;
  return value <= tag.size()
             ? std::optional(tag.substr(value, tag.find_first_of("\"'", value) - value))
             : std::nullopt;
}

/// Takes vectors of a frame with that axis up to one with z up, by a quarter turn.
Eigen::Matrix3d z_up_from(UpAxis up) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (up == UpAxis::kY) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::kX) turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return turn;
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

MeshReply read_triangles(const fs::path& file, std::string_view bytes, const std::string& format,
                         const Progress& progress) {
  if (format == "ply") read_ply(bytes, file.string());  // says best what is wrong
  require_read_whole(bytes, format, file.string());
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

/// By how much coordinates of single precision may be off, also those that a file's own transforms
/// were applied to. Vertices of no triangle, often far away, do not count.
double rounding_of(const MeshReply& mesh, const std::string& format) {
  double largest = 0.0;
  for (const auto& triangle : mesh.triangles)
    for (const auto corner : triangle)
      if (const Point& v = mesh.vertices[corner]; v.allFinite())
        largest = std::max(largest, v.cwiseAbs().maxCoeff());
  const bool is_placed = format == "dae" || format == "glb" || format == "gltf";
  return (is_placed ? 4.0 : 0.5) * std::numeric_limits<float>::epsilon() * largest;
}

}  // namespace

bool is_text_stl(std::string_view bytes) {
  const std::string head = in_small_letters(std::string(bytes.substr(0, 4096)));
  return head.starts_with("solid") && head.find("facet") != std::string::npos;
}

std::string mesh_format(std::string_view bytes, const fs::path& file) {
  const std::string_view head = bytes.substr(0, 4096);
  const std::string extension = ending_of(file);
  if (bytes.starts_with("glTF")) return "glb";
  if (head.find("<COLLADA") != std::string_view::npos) return "dae";
  if (is_ply(bytes)) return has_ply_faces(bytes, file.string()) ? "ply" : "";
  if (is_text_stl(bytes) || is_binary_stl(bytes)) return "stl";
  const bool is_named = extension == "obj" || extension == "gltf" || extension == "stl" ||
                        extension == "dae" || extension == "glb";
  return is_named ? extension : "";
}

MeshFrame mesh_frame(const std::string& format, std::string_view bytes) {
  if (format == "glb" || format == "gltf") return {1.0, UpAxis::kY};
  MeshFrame frame;
  if (format != "dae") return frame;
  const std::string_view head = bytes.substr(0, 65536);
  frame.unit = 1.0;  // unless it says another: COLLADA 1.4.1
  if (const auto meters = xml_value(head, "unit", "meter"))
    frame.unit = to_number<double>(*meters).value_or(1.0);
  const std::string_view up = xml_value(head, "up_axis", "").value_or("Y_UP");
  frame.up = up.find("Z_UP") != std::string_view::npos   ? UpAxis::kZ
             : up.find("X_UP") != std::string_view::npos ? UpAxis::kX
                                                         : UpAxis::kY;
  return frame;
}

TriangleSoup read_mesh(const fs::path& file, std::string_view bytes, const std::string& format,
                       const MeshFrame& given, const Progress& progress) {
  MeshReply reply = read_triangles(file, bytes, format, progress);
  const MeshFrame own = mesh_frame(format, bytes);
  // What the reader made of the file is in the frame that the file names, if it names one.
  double scale = given.unit.value_or(own.unit.value_or(1.0));
  if (own.unit) scale /= *own.unit > 0.0 ? *own.unit : 1.0;
  Eigen::Matrix3d turn = z_up_from(given.up.value_or(own.up.value_or(UpAxis::kZ)));
  if (own.up) turn = turn * z_up_from(*own.up).transpose();
  const double off = scale * rounding_of(reply, format);
  if (scale != 1.0 || !turn.isIdentity(0.0))
    for (Point& v : reply.vertices) v = scale * (turn * v);
  return {std::move(reply.vertices), std::move(reply.triangles), off};
}

std::shared_ptr<const SolidMesh> load_mesh(const fs::path& file, const Progress& progress) {
  const std::string format = format_of(file), bytes = read_file(file);
  const MeshReply all = read_triangles(file, bytes, format, progress);
  try {
    return std::make_shared<const SolidMesh>(all.vertices, all.triangles);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.where(), error.problem(), error.remedy());
  }
}

}  // namespace ridgeway
