// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "source_facts.hpp"

#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "console.hpp"
#include "files/read_file.hpp"
#include "formats/benchmark_map.hpp"
#include "formats/octomap.hpp"
#include "formats/pcd.hpp"
#include "formats/ply_cloud.hpp"
#include "formats/xyz.hpp"
#include "json.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Cloud {
  const char* format;
  PointCloud points;
};

Cloud read_cloud(std::string_view bytes, const std::string& name) {
  if (is_pcd(bytes)) return {"pcd", read_pcd(bytes, name)};
  if (is_ply(bytes)) return {"ply", read_ply(bytes, name)};
  return {"xyz", read_xyz(bytes, name)};
}

void add_cloud(Json& json, const Cloud& cloud) {
  json["format"] = cloud.format;
  json["points"] = cloud.points.points.size();
  json["skipped_points"] = cloud.points.skipped;
  if (!cloud.points.points.empty())
    json["bounds"] = cli::json_of(extent(cloud.points, Eigen::Isometry3d::Identity()));
}

void add_voxels(Json& json, const char* format, const OccupancyMap& map) {
  const VoxelCounts counts = count_voxels(map);
  json["format"] = format;
  json["voxel_size"] = map.voxel_size;
  if (const auto bounds = known_bounds(map)) json["bounds"] = cli::json_of(*bounds);
  json["voxels"] = {
      {"free", counts.free}, {"occupied", counts.occupied}, {"unknown", counts.unknown}};
  json["allocated_voxels"] = map.layout.voxel_count();
  json["memory_bytes"] = map.layout.memory_bytes() + map.state.memory_bytes();
}

const char* octomap_format(std::string_view bytes, const std::string& name) {
  return read_octomap_header(bytes, name).binary ? "octomap_bt" : "octomap_ot";
}

/// Whether load_map takes the file for a cloud: it then asks for bounds or a voxel size. Throws
/// what it throws for a file that cannot be read at all.
std::optional<OccupancyMap> try_voxels(const std::filesystem::path& file, const Globals& globals) {
  LoadNotes notes;
  try {
    OccupancyMap map = load_map(file, {}, &notes);
    for (const std::string& text : notes.notes) note(globals, text);
    return map;
  } catch (const InputError& error) {
    if (error.remedy().starts_with("give voxel_size")) return std::nullopt;
    throw;
  }
}

}  // namespace

bool is_roadmap_file(const std::filesystem::path& file) {
  constexpr std::string_view kMagic = "RIDGEWAY";
  if (is_tsdf_file(file)) return false;
  if (file.extension() == ".ridge") return true;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return false;  // opening a pipe would wait for ever
  std::string head(kMagic.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == kMagic;
}

Json describe_source(const std::filesystem::path& file, const Globals& globals) {
  const std::optional<OccupancyMap> map = try_voxels(file, globals);
  const std::string bytes = read_file(file), name = file.string();
  Json json = {{"file", name}, {"file_bytes", bytes.size()}};
  if (!map)
    add_cloud(json, read_cloud(bytes, name));
  else
    add_voxels(json,
               is_tsdf_file(file)  ? "tsdf"
               : is_octomap(bytes) ? octomap_format(bytes, name)
                                   : "3dmap",
               *map);
  return json;
}

std::string bounds_text(const Json& box) {
  const auto corner = [&](const char* key) {
    const Json& p = box[key];
    return point_text({p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
  };
  return corner("min") + " to " + corner("max");
}

void print_source(const Json& facts) {
  const auto count = [&](const Json& value) { return count_text(value.get<std::uint64_t>()); };
  print_row("map", facts["file"].get<std::string>() + ", " +
                       bytes_text(facts["file_bytes"].get<std::uint64_t>()));
  print_row("format", facts["format"].get<std::string>());
  if (facts.contains("voxel_size"))
    print_row("voxel size", text_of(facts["voxel_size"].get<double>(), 6) + " m");
  if (facts.contains("bounds")) print_row("bounds", bounds_text(facts["bounds"]));
  if (facts.contains("voxels")) {
    print_row("voxels", count(facts["voxels"]["free"]) + " free, " +
                            count(facts["voxels"]["occupied"]) + " occupied");
    print_row("memory", bytes_text(facts["memory_bytes"].get<std::uint64_t>()));
  } else {
    print_row("points",
              count(facts["points"]) + ", " + count(facts["skipped_points"]) + " not finite");
  }
}

}  // namespace ridgeway::cli
