// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "readers.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "formats/benchmark_map.hpp"
#include "formats/benchmark_scenarios.hpp"
#include "formats/grey_image.hpp"
#include "formats/map_server.hpp"
#include "formats/mesh_file.hpp"
#include "formats/mesh_packing.hpp"
#include "formats/octomap.hpp"
#include "formats/pcd.hpp"
#include "formats/ply_cloud.hpp"
#include "formats/voxblox.hpp"
#include "formats/voxblox_graph.hpp"
#include "formats/xyz.hpp"
#include "recordings/depth_png.hpp"
#include "recordings/pose_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "unpacked_ridge.hpp"

namespace ridgeway {

/// Worlds name meshes, which are read by a program of its own: not while fuzzing.
std::shared_ptr<const SolidMesh> load_mesh(const std::filesystem::path& file, const Progress&) {
  throw InputError(file.string(), "is not read here", "fuzz mesh_reply");
}

namespace fuzz {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "fuzz";

/// A folder for readers that want files, in memory where there is such a place.
class Folder {
 public:
  Folder() {
    std::string name = (fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path()) /
                       fs::path("ridgeway-fuzz-XXXXXX");
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

fs::path in_folder(const char* name) {
  static const Folder folder;
  return folder.path() / name;
}

fs::path written(std::string_view bytes, const char* name) {
  fs::path file = in_folder(name);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  return file;
}

/// Large maps must not make a fuzzer slow: a few blocks around the origin.
VoxelPlacement near_origin() { return {.motion = {}, .clip = {{-32, -32, -32}, {31, 31, 31}}}; }

void make_map(const PointCloud& cloud) {
  if (cloud.points.empty()) return;
  map_from_points(cloud, {.voxel_size = 0.5, .bounds = {Point::Constant(-4), Point::Constant(4)}},
                  kName);
}

void read_scenes(std::string_view bytes) {
  const std::size_t cut = std::min(bytes.find("\n%%\n"), bytes.size());
  written(bytes.substr(0, cut), "depth.txt");
  written(bytes.substr(std::min(cut + 4, bytes.size())), "groundtruth.txt");
  open_sequence(in_folder(""));
}

/// Whether a PNG's chunks are whole is of no interest: their checksums are set right.
void read_png(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and checksum of a chunk
  std::string png(bytes);
  const auto number_at = [&](std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
      number = number << 8 | static_cast<std::uint8_t>(png[at + i]);
    return number;
  };
  for (std::size_t at = kSignature; at + kFrame <= png.size();) {
    const std::size_t length = number_at(at);
    if (length > png.size() - at - kFrame) break;
    std::uint32_t sum = 0xffffffffu;
    for (const char c : std::string_view(png).substr(at + 4, 4 + length)) {
      sum ^= static_cast<std::uint8_t>(c);
      for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0u);
    }
    for (std::size_t i = 0; i < 4; ++i)
      png[at + 8 + length + i] = static_cast<char>(~sum >> (24 - 8 * i) & 255);
    at += kFrame + length;
  }
  read_depth_png(written(png, "a.png"), 1000.0);
}

void read_poses(std::string_view bytes) {
  for_each_row(written(bytes, "rows.txt"), [](const TextRow& row) {
    if (row.words.size() > 7) pose_in_row(row, 1, "correct it");
  });
}

/// The folder of a scan list holds no clouds: the names in it are looked for, not read.
void read_scans(std::string_view bytes) {
  fs::create_directory(in_folder("scans"));
  written(bytes, "scans/poses.txt");
  open_scans(in_folder("scans"));
}

void read_registration(std::string_view bytes) {
  fs::create_directory(in_folder("registration"));
  written(bytes, "registration/registration_metrics.json");
  open_scans(in_folder("registration"));
}

void read_log(std::string_view bytes) {
  fs::create_directories(in_folder("open3d/depth"));
  written(bytes, "open3d/trajectory.log");
  open_sequence(in_folder("open3d"));
}

void read_layers(std::string_view bytes) {
  if (!is_voxblox(bytes)) return;
  const auto layers = read_voxblox(bytes, kName);
  voxblox_bytes(layers);
  map_of_layer(map_layer(layers, kName), kName);
}

void read_graph(std::string_view bytes) {
  is_voxblox_graph(bytes);
  const VoxbloxGraph graph = read_voxblox_graph(bytes, kName);
  voxblox_graph_bytes(graph);
  find_faults(graph);
}

void read_ridge(std::string_view bytes) {
  const fs::path file = in_folder("a.ridge");
  pack_ridge(bytes, file);
  read_ridge_info(file);
  load_roadmap(file);
}

void read_tsdf(std::string_view bytes) {
  const fs::path file = in_folder("a.ridge");
  pack_ridge(bytes, file);
  load_tsdf(file);
}

constexpr std::array kReaders = {
    Reader{"3dmap", [](std::string_view b) { read_benchmark_map(b, kName, 1.0, near_origin()); }},
    Reader{"3dscen", [](std::string_view b) { read_benchmark_scenarios(b, kName); }},
    Reader{"depth_png", read_png},
    Reader{"grey_image", [](std::string_view b) { read_grey_image(b, kName); }},
    Reader{"map_server", [](std::string_view b) { read_map_server(b, kName); }},
    Reader{"mesh_reply", [](std::string_view b) { unpack(std::as_bytes(std::span(b))); }},
    Reader{"open3d", read_log},
    Reader{"octomap", [](std::string_view b) { read_octomap(b, kName, near_origin()); }},
    Reader{"path_csv", [](std::string_view b) { read_path(written(b, "a.csv")); }},
    Reader{"path_json", [](std::string_view b) { read_path(written(b, "a.json")); }},
    Reader{"pcd", [](std::string_view b) { make_map(read_pcd(b, kName)); }},
    Reader{"ply", [](std::string_view b) { make_map(read_ply(b, kName)); }},
    Reader{"poses", read_poses},
    Reader{"registration", read_registration},
    Reader{"ridge", read_ridge},
    Reader{"ridge_bytes", [](std::string_view b) { load_roadmap(written(b, "b.ridge")); }},
    Reader{"scans", read_scans},
    Reader{"tsdf", read_tsdf},
    Reader{"tum", read_scenes},
    Reader{"voxblox", read_layers},
    Reader{"voxblox_graph", read_graph},
    Reader{"world", [](std::string_view b) { load_world(written(b, "a.yaml")); }},
    Reader{"xyz", [](std::string_view b) { make_map(read_xyz(b, kName)); }}};

}  // namespace

std::span<const Reader> all_readers() { return kReaders; }

}  // namespace fuzz
}  // namespace ridgeway
