// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "files/text.hpp"
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

constexpr Range kCoordinates = {-1e9, 1e9};  // metres

struct ExportOptions {
  std::string file, json_graph, picture, mesh, what = "graph", colour = "clearance";
  std::vector<std::string> outputs, paths;
  PictureConfig drawn;
  std::vector<Option> of_pictures, of_roadmaps;
};

bool is_page(const std::filesystem::path& file) { return extension_of(file) == ".html"; }

bool is_picture(const std::filesystem::path& file) {
  return extension_of(file) == ".png" || extension_of(file) == ".svg";
}

/// voxblox layers, of a roadmap or of a fused map.
bool is_voxblox_name(const std::filesystem::path& file) {
  return extension_of(file) == ".vxblx" || extension_of(file) == ".voxblox";
}

void require_format(const std::filesystem::path& file, const std::string& what) {
  const std::string extension = extension_of(file);
  const bool known = is_voxblox_name(file) ||
                     (what == "diagram" ? extension == ".ply"
                                        : extension == ".json" || extension == ".graphml" ||
                                              extension == ".ply" || extension == ".pb");
  if (!known && !is_picture(file) && !is_page(file))
    throw InputError(file.string(), "names no format that a " + what + " can be written in",
                     what == "diagram"
                         ? "use .ply, with .vxblx, .png, .svg or .html beside it"
                         : "use .json, .graphml, .ply, .pb, .vxblx, .png, .svg or .html");
  if (is_page(file)) require_page_planner(file.string());
}

/// What a .ply file is to hold says nothing where none is written.
void require_ply(const ExportOptions& options, const std::vector<std::filesystem::path>& files) {
  if (options.what == "diagram" && std::none_of(files.begin(), files.end(), [](const auto& file) {
        return extension_of(file) == ".ply";
      }))
    throw InputError("--what diagram", "is of .ply files, and none is written",
                     "give -o FILE.ply too, or leave it out");
}

/// Of options that would say nothing where no picture is written.
void refuse_picture_options(const ExportOptions& options) {
  for (const Option& option : options.of_pictures)
    if (option.is_given())
      throw InputError(option.name(), "is of pictures, and none is written",
                       "give --picture FILE too, or leave it out");
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
  require_ply(options, files);
  if (std::none_of(files.begin(), files.end(), is_picture)) refuse_picture_options(options);
  std::vector<std::filesystem::path> inputs = {options.file};
  inputs.insert(inputs.end(), options.paths.begin(), options.paths.end());
  require_writable(files, inputs);
  if (!options.json_graph.empty())
    require_extension(options.json_graph, "a graph as JSON", {".json"});
  return files;
}

/// What is drawn of pictures. One path is the path; several are compared, named as their files.
struct Picture {
  PictureConfig config;
  std::vector<Point> path;
};

Picture read_picture(const ExportOptions& options) {
  Picture picture{options.drawn, {}};
  PictureConfig& config = picture.config;
  if (options.colour == "height") config.diagram_colour = DiagramColour::kHeight;
  if (options.colour == "component") config.diagram_colour = DiagramColour::kComponent;
  for (const std::string& file : options.paths)
    config.paths.push_back({std::filesystem::path(file).stem().string(), read_path(file)});
  config.validate();
  if (config.paths.size() == 1) {
    picture.path = std::move(config.paths.front().waypoints);
    config.paths.clear();
  }
  return picture;
}

void write(const Roadmap& roadmap, const Picture& picture, const ExportOptions& options,
           const std::filesystem::path& file) {
  if (file == options.json_graph)
    write_graph_json(roadmap, file);
  else if (is_page(file))
    write_text_file(file, page_with_map(std::filesystem::path(options.file).filename().string(),
                                        read_file(options.file)));
  else if (is_picture(file))
    draw_floor_plan(roadmap, picture.path, file, picture.config);
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

/// Fused maps have neither graph nor pictures.
void refuse_roadmap_options(const ExportOptions& options) {
  refuse_picture_options(options);
  for (const Option& option : options.of_roadmaps)
    if (option.is_given())
      throw InputError(option.name(), "is of roadmaps, and a fused map is written", "leave it out");
}

/// The surface of a fused map.
int run_mesh(const ExportOptions& options, const Globals& globals) {
  if (!options.outputs.empty() || !options.json_graph.empty() || !options.picture.empty())
    throw InputError("--mesh", "shows a fused map, the other outputs show a roadmap",
                     "export the two one after the other");
  refuse_roadmap_options(options);
  const std::filesystem::path file(options.mesh);
  if (extension_of(file) != ".ply")
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
  refuse_roadmap_options(options);
  require_writable(files, {options.file});
  const TsdfMap map = load_tsdf(options.file);
  for (const auto& file : files) write_voxblox(map, file);
  return report(files, globals);
}

int run(const ExportOptions& options, const Globals& globals) {
  if (!options.mesh.empty()) return run_mesh(options, globals);
  if (!options.outputs.empty() && is_tsdf_file(options.file)) return run_fused(options, globals);
  std::vector<std::filesystem::path> files = list_outputs(options);
  // A section may lie outside the map: then nothing has been written.
  std::stable_partition(files.begin(), files.end(), is_picture);
  const Picture picture = read_picture(options);
  const Roadmap roadmap = load_roadmap(options.file);
  for (const auto& file : files) {
    stop_if_interrupted();
    write(roadmap, picture, options, file);
  }
  return report(files, globals);
}

void add_picture_options(Command& command, ExportOptions& options) {
  PictureConfig& drawn = options.drawn;
  options.of_pictures = {
      command.paths(
          "--path", options.paths,
          "Path to draw over pictures, .json or .csv of plan; may be repeated, to compare "
          "up to eight"),
      command.flag("--floors", drawn.floors, "Draw a plan for each storey"),
      command.flag("--sides", drawn.sides, "Draw the map from the front and from a side too"),
      command.number("--section-x", drawn.section_x, kCoordinates,
                     "Draw a section along y at this x, metres"),
      command.number("--section-y", drawn.section_y, kCoordinates,
                     "Draw a section along x at this y, metres"),
      command.choice("--colour", options.colour, {"clearance", "height", "component"},
                     "What the diagram's colours say in pictures; component: what is connected, in "
                     "colours of the graph too"),
      command.flag("--narrow", drawn.narrow_places,
                   "Mark narrow places in pictures, with the radius that fits")};
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
  options->of_roadmaps = {
      command.choice("--what", options->what, {"graph", "diagram"}, "What a .ply file is to hold")};
  command.path("--json-graph", options->json_graph, "Graph as JSON, for networkx");
  command.path("--picture", options->picture, "Map, graph and path from above, .png or .svg");
  add_picture_options(command, *options);
  command.path("--mesh", options->mesh, "Surface of a fused map, .ply");
  command.footer(
      "Examples:\n"
      "  ridgeway export office.ridge --picture office.png --path path.json\n"
      "  ridgeway export office.ridge --picture routes.png --path route-1.json --path "
      "route-2.json\n"
      "  ridgeway export house.ridge --picture house.png --floors --section-y 3 --narrow\n"
      "  ridgeway export office.ridge -o graph.graphml -o graph.ply\n"
      "  ridgeway export office.ridge -o office.html\n"
      "  ridgeway export house.ridge --mesh house.ply");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
