// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "source_facts.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "console.hpp"
#include "files/read_file.hpp"
#include "files/text.hpp"
#include "formats/benchmark_map.hpp"
#include "formats/map_server.hpp"
#include "formats/mesh_file.hpp"
#include "formats/octomap.hpp"
#include "formats/pcd.hpp"
#include "formats/ply_cloud.hpp"
#include "formats/voxblox.hpp"
#include "formats/voxblox_graph.hpp"
#include "formats/xyz.hpp"
#include "json.hpp"
#include "option_names.hpp"
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

const char* name_of(UpAxis up) { return up == UpAxis::kX ? "x" : up == UpAxis::kY ? "y" : "z"; }

void add_mesh(Json& json, const std::filesystem::path& file, std::string_view bytes,
              const std::string& format) {
  const MeshFrame frame = mesh_frame(format, bytes);
  const TriangleSoup mesh = read_mesh(file, bytes, format, {});
  json["format"] = format;
  json["vertices"] = mesh.vertices.size();
  json["triangles"] = mesh.triangles.size();
  json["metres_a_unit"] = frame.unit ? Json(*frame.unit) : Json();
  json["up"] = frame.up ? Json(name_of(*frame.up)) : Json();
  json["bounds"] = cli::json_of(box_around(mesh, file.string()));
}

void add_graph(Json& json, std::string_view bytes, const std::string& name) {
  const VoxbloxGraph graph = read_voxblox_graph(bytes, name);
  const VoxbloxGraphFaults faults = find_faults(graph);
  json["format"] = "voxblox_graph";
  json["vertices"] = graph.vertices.size();
  json["edges"] = graph.edges.size();
  json["components"] = faults.components;
  json["faults"] = {
      {"self_loops", faults.self_loops},         {"doubled_edges", faults.doubled_edges},
      {"dangling_edges", faults.dangling_edges}, {"unlisted_edges", faults.unlisted_edges},
      {"misplaced_ends", faults.misplaced_ends}, {"lone_vertices", faults.lone_vertices},
      {"doubled_ids", faults.doubled_ids},       {"not_finite", faults.not_finite}};
}

void add_layers(Json& json, std::string_view bytes, const std::string& name) {
  for (const VoxbloxLayer& layer : read_voxblox(bytes, name))
    json["layers"].push_back({{"type", layer.type},
                              {"voxel_size", layer.voxel_size},
                              {"voxels_per_side", layer.side},
                              {"blocks", layer.blocks.size()}});
}

const char* voxel_format(const std::filesystem::path& file, std::string_view bytes,
                         const std::string& name) {
  if (is_tsdf_file(file)) return "tsdf";
  if (is_octomap(bytes)) return octomap_format(bytes, name);
  if (is_voxblox(bytes)) return "voxblox";
  if (is_map_server(bytes)) return "ros_map";
  return extension_of(file) == ".yaml" || extension_of(file) == ".yml" ? "world" : "3dmap";
}

/// Whether load_map takes the file for a cloud: it then asks for bounds or a voxel size. Throws
/// what it throws for a file that cannot be read at all.
std::optional<OccupancyMap> try_voxels(const std::filesystem::path& file, const Globals& globals) {
  LoadNotes notes;
  try {
    OccupancyMap map = load_map(file, {}, &notes);
    for (const std::string& text : notes.notes) note(globals, with_option_names(text));
    return map;
  } catch (const InputError& error) {
    if (error.problem().starts_with("is a point cloud")) return std::nullopt;
    throw;
  }
}

}  // namespace

bool is_roadmap_file(const std::filesystem::path& file) {
  constexpr std::string_view kMagic = "RIDGEWAY";
  if (is_tsdf_file(file)) return false;
  if (extension_of(file) == ".ridge") return true;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return false;  // opening a pipe would wait for ever
  std::string head(kMagic.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == kMagic;
}

Json describe_source(const std::filesystem::path& file, const Globals& globals) {
  const std::string bytes = read_file(file), name = file.string();
  Json json = {{"file", name}, {"file_bytes", bytes.size()}};
  if (const std::string format = mesh_format(bytes, file); !format.empty()) {
    add_mesh(json, file, bytes, format);
    return json;
  }
  if (is_voxblox_graph(bytes)) {
    add_graph(json, bytes, name);
    return json;
  }
  const std::optional<OccupancyMap> map = try_voxels(file, globals);
  if (!map)
    add_cloud(json, read_cloud(bytes, name));
  else
    add_voxels(json, voxel_format(file, bytes, name), *map);
  if (is_voxblox(bytes)) add_layers(json, bytes, name);
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
  if (facts.contains("triangles")) {
    print_row("mesh",
              count(facts["triangles"]) + " triangles, " + count(facts["vertices"]) + " vertices");
    print_row("unit", facts["metres_a_unit"].is_null()
                          ? "not said"
                          : text_of(facts["metres_a_unit"].get<double>(), 6) + " m");
    print_row("up", facts["up"].is_null() ? "not said" : facts["up"].get<std::string>());
    return;
  }
  if (facts.contains("faults")) {
    print_row("graph", count(facts["vertices"]) + " vertices, " + count(facts["edges"]) +
                           " edges, " + count(facts["components"]) + " components");
    for (const auto& [fault, number] : facts["faults"].items())
      if (number.get<std::uint64_t>() > 0) {
        std::string words = fault;
        std::replace(words.begin(), words.end(), '_', ' ');
        // A component may well be a vertex alone: such are worth a look, but nothing is wrong.
        print_row(fault == "lone_vertices" ? "to look at" : "wrong", count(number) + " " + words);
      }
    return;
  }
  if (facts.contains("layers"))
    for (const Json& layer : facts["layers"])
      print_row("layer", layer["type"].get<std::string>() + ", " + count(layer["blocks"]) +
                             " blocks of " + count(layer["voxels_per_side"]) + " voxels a side");
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
