// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/graph_export.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/pictures/picture.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "view/page.hpp"

namespace ridgeway::cli {
namespace {

struct ExportOptions {
  std::string file, json_graph, picture, path, mesh, what = "graph";
  std::vector<std::string> outputs;
};

bool is_page(const std::filesystem::path& file) { return file.extension() == ".html"; }

bool is_picture(const std::filesystem::path& file) {
  return file.extension() == ".png" || file.extension() == ".svg";
}

/// voxblox layers, of a roadmap or of a fused map.
bool is_voxblox_name(const std::filesystem::path& file) {
  return file.extension() == ".vxblx" || file.extension() == ".voxblox";
}

void require_format(const std::filesystem::path& file, const std::string& what) {
  const auto extension = file.extension();
  const bool known = is_voxblox_name(file) ||
                     (what == "diagram" ? extension == ".ply"
                                        : extension == ".json" || extension == ".graphml" ||
                                              extension == ".ply" || extension == ".pb");
  if (!known && !is_picture(file) && !is_page(file))
    throw InputError(file.string(), "names no format that a " + what + " can be written in",
                     what == "diagram"
                         ? "use .ply or .vxblx, or .png or .svg for a picture, or .html"
                         : "use .json, .graphml, .ply, .pb, .vxblx, .png, .svg or .html");
  if (is_page(file)) require_page_planner(file.string());
}

/// All that is to be written; problems are found before anything is.
std::vector<std::filesystem::path> list_outputs(const ExportOptions& options) {
  std::vector<std::filesystem::path> files(options.outputs.begin(), options.outputs.end());
  for (const auto& file : files) require_format(file, options.what);
  if (!options.picture.empty()) {
    files.emplace_back(options.picture);
    if (!is_picture(files.back()))
      throw InputError(options.picture, "names no format of pictures", "use .png or .svg");
  }
  if (!options.json_graph.empty()) files.emplace_back(options.json_graph);
  if (files.empty())
    throw InputError("export", "nothing to write was asked for",
                     "give -o FILE, --json-graph FILE, --picture FILE or --mesh FILE");
  std::vector<std::filesystem::path> inputs = {options.file};
  if (!options.path.empty()) inputs.emplace_back(options.path);
  require_writable(files, inputs);
  if (!options.json_graph.empty())
    require_extension(options.json_graph, "a graph as JSON", {".json"});
  return files;
}

void write(const Roadmap& roadmap, const std::vector<Point>& path, const ExportOptions& options,
           const std::filesystem::path& file) {
  if (file == options.json_graph)
    write_graph_json(roadmap, file);
  else if (is_page(file))
    write_text_file(file, page_with_map(std::filesystem::path(options.file).filename().string(),
                                        read_file(options.file)));
  else if (is_picture(file))
    draw_floor_plan(roadmap, path, file);
  else if (is_voxblox_name(file))
    write_voxblox(roadmap, file);
  else if (options.what == "diagram")
    write_diagram_ply(roadmap, file);
  else
    write_graph(roadmap, file);
}

int report(const std::vector<std::filesystem::path>& files, const Globals& globals) {
  nlohmann::ordered_json written = nlohmann::ordered_json::array();
  for (const auto& file : files) {
    const auto bytes = std::filesystem::file_size(file);
    written.push_back({{"file", file.string()}, {"bytes", bytes}});
    if (!globals.json) print_row("written", file.string() + ", " + bytes_text(bytes));
  }
  if (globals.json) print_json({{"written", written}});
  return kExitDone;
}

/// The surface of a fused map.
int run_mesh(const ExportOptions& options, const Globals& globals) {
  if (!options.outputs.empty() || !options.json_graph.empty() || !options.picture.empty())
    throw InputError("--mesh", "shows a fused map, the other outputs show a roadmap",
                     "export the two one after the other");
  const std::filesystem::path file(options.mesh);
  if (file.extension() != ".ply")
    throw InputError(options.mesh, "names no format of meshes", "use .ply");
  require_writable({file}, {options.file});
  const SurfaceMesh mesh = surface_of(load_tsdf(options.file));
  if (mesh.triangles.empty())
    throw InputError(options.file, "holds no surface between known free and known solid voxels",
                     "fuse a recording that sees one");
  write_mesh_ply(mesh, file);
  return report({file}, globals);
}

/// A fused map in the format of others.
int run_fused(const ExportOptions& options, const Globals& globals) {
  const std::vector<std::filesystem::path> files(options.outputs.begin(), options.outputs.end());
  for (const auto& file : files)
    if (!is_voxblox_name(file))
      throw InputError(file.string(), "names no format that a fused map can be written in",
                       "use .vxblx, or --mesh FILE.ply for its surface");
  if (!options.json_graph.empty() || !options.picture.empty())
    throw InputError(options.file, "is a fused map, which has no graph and no picture",
                     "build a roadmap of it, and export that");
  require_writable(files, {options.file});
  const TsdfMap map = load_tsdf(options.file);
  for (const auto& file : files) write_voxblox(map, file);
  return report(files, globals);
}

int run(const ExportOptions& options, const Globals& globals) {
  if (!options.mesh.empty()) return run_mesh(options, globals);
  if (!options.outputs.empty() && is_tsdf_file(options.file)) return run_fused(options, globals);
  const std::vector<std::filesystem::path> files = list_outputs(options);
  const std::vector<Point> path =
      options.path.empty() ? std::vector<Point>{} : read_path(options.path);
  const Roadmap roadmap = load_roadmap(options.file);
  for (const auto& file : files) {
    stop_if_interrupted();
    write(roadmap, path, options, file);
  }
  return report(files, globals);
}

}  // namespace

void add_export_command(Command& program) {
  const auto options = std::make_shared<ExportOptions>();
  Command command =
      program.add("export", "Write a roadmap, or the surface of a fused map, in other formats");
  command.path("roadmap", options->file, "Roadmap or, for --mesh, fused map, .ridge").required();
  command.paths(
      "-o,--output", options->outputs,
      "File to write, by its extension: .json, .graphml, .ply, .pb (voxblox sparse graph), "
      ".vxblx (voxblox ESDF and skeleton; TSDF of a fused map), .png, .svg, or .html, the "
      "page of view as one file that plans by itself; may be repeated");
  command.choice("--what", options->what, {"graph", "diagram"}, "What a .ply file is to hold");
  command.path("--json-graph", options->json_graph, "Graph as JSON, for networkx");
  command.path("--picture", options->picture, "Map, graph and path from above, .png or .svg");
  command.path("--path", options->path, "Path to draw over pictures, .json or .csv of plan");
  command.path("--mesh", options->mesh, "Surface of a fused map, .ply");
  command.footer(
      "Examples:\n"
      "  ridgeway export office.ridge --picture office.png --path path.json\n"
      "  ridgeway export office.ridge -o graph.graphml -o graph.ply\n"
      "  ridgeway export office.ridge -o office.html\n"
      "  ridgeway export house.ridge --mesh house.ply");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
