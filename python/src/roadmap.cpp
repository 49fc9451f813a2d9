// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Roadmaps: built, saved, loaded, looked at.
#include <array>
#include <nlohmann/json.hpp>

#include "config.hpp"
#include "faces.hpp"
#include "formats/build_record.hpp"
#include "long_call.hpp"
#include "maps.hpp"
#include "plans.hpp"
#include "ridgeway/formats/graph_export.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/components.hpp"

namespace ridgeway::python {

std::string record_of(const BuildConfig& config, double voxel_size) {
  return build_record(config, voxel_size).dump();
}

namespace {

RoadmapFace build_from(OccupancyMap map, const std::string& source, const BuildConfig& config,
                       const py::object& progress, int threads) {
  const double voxel_size = map.voxel_size;
  BuildResult built = run_long(progress, threads, [&](const Progress& report) {
    return build_roadmap(std::move(map), config, report);
  });
  built.roadmap.source = source;
  built.roadmap.config = record_of(config, voxel_size);
  return {std::make_shared<const Roadmap>(std::move(built.roadmap)), built.report};
}

/// A map, or the file of one, with its own keyword arguments.
RoadmapFace build(py::handle map, const py::object& progress, py::handle threads,
                  py::kwargs keywords) {
  int count = 0;
  read(threads, "threads", count);
  if (py::isinstance<MapFace>(map)) {
    const BuildConfig config = build_fields().read_all(keywords);
    const auto& face = map.cast<const MapFace&>();
    return build_from(taken(*face.map, config.unknown), face.source, config, progress, count);
  }
  if (py::isinstance<py::array>(map))
    throw py::type_error(
        "map: expected an OccupancyMap or a path, got " + describe(map) +
        "; use ridgeway.build(ridgeway.OccupancyMap.from_numpy(states, voxel_size), ...)");
  const LoadConfig loading = load_fields().take(keywords);
  loading.validate();
  const BuildConfig config = build_fields().read_all(keywords, load_fields().names());
  MapFace face = load_face(path_from(map, "map"), loading);
  OccupancyMap taken_over = taken(*face.map, config.unknown);
  face.map.reset();
  return build_from(std::move(taken_over), face.source, config, progress, count);
}

RoadmapFace load(py::handle path) {
  const std::filesystem::path file = path_from(path, "path");
  return {run_stage([&] { return std::make_shared<const Roadmap>(load_roadmap(file)); })};
}

void save(const RoadmapFace& face, py::handle path) {
  const std::filesystem::path file = path_from(path, "path");
  if (file.extension() != ".ridge")
    throw InputError("path", "is '" + file.string() + "'", "give a name that ends in .ridge");
  const Unlocked unlocked;
  save_roadmap(*face.roadmap, file);
}

py::object report_of(const RoadmapFace& face) {
  if (!face.report) return py::none();
  const BuildReport& report = *face.report;
  const BuildSeconds& s = report.seconds;
  py::dict seconds;
  for (const auto& [name, value] :
       {std::pair("esdf", s.esdf), std::pair("gvd", s.gvd), std::pair("edges", s.edges),
        std::pair("thin", s.thin), std::pair("kernel", s.kernel), std::pair("graph", s.graph),
        std::pair("attach", s.attach), std::pair("tangents", s.tangents),
        std::pair("total", s.total)})
    seconds[name] = value;
  py::dict dict;
  dict["free"] = report.voxels.free;
  dict["occupied"] = report.voxels.occupied;
  dict["unknown"] = report.voxels.unknown;
  dict["allocated_voxels"] = report.allocated_voxels;
  dict["traversable_voxels"] = report.traversable_voxels;
  dict["traversable_components"] = report.traversable_components;
  dict["gvd_voxels"] = report.gvd_voxels;
  dict["edge_voxels"] = report.edge_voxels;
  dict["kernel_voxels"] = report.kernel_voxels;
  dict["diagram_voxels"] = report.diagram_voxels;
  dict["graph_components"] = report.graph_components;
  dict["seconds"] = seconds;
  return dict;
}

py::list components_of(const RoadmapFace& face) {
  const ComponentReport report = run_stage([&] { return report_components(*face.roadmap); });
  py::list parts;
  for (const Component& component : report.components) {
    py::dict part;
    part["voxels"] = component.voxels;
    part["volume"] = component.volume;
    part["widest"] = tuple_of(component.widest);
    part["clearance"] = component.clearance;
    parts.append(part);
  }
  return parts;
}

/// Of two components: where a smaller robot would find them one.
py::dict dict_of(const ComponentJoin& join) {
  py::dict dict;
  dict["component"] = join.b;
  dict["radius"] = join.radius;
  dict["place"] = tuple_of(join.place);
  dict["by"] = std::string(name_of(join.by));
  return dict;
}

py::dict describe_point(const RoadmapFace& face, py::handle point) {
  const Point place = point_from(point, "point");
  const PlaceFacts facts = run_stage([&] { return describe_place(*face.roadmap, place); });
  constexpr std::array<const char*, 3> kStates = {"unknown", "free", "occupied"};
  py::dict dict;
  dict["status"] = std::string(name_of(facts.status));
  dict["state"] = kStates[static_cast<std::size_t>(facts.state)];
  dict["clearance"] = facts.clearance;
  const bool fits = facts.status == PlanStatus::kOk;
  dict["component"] = fits ? py::object(py::cast(facts.component)) : py::none();
  py::list ways;
  for (const ComponentJoin& join : facts.ways) ways.append(dict_of(join));
  dict["ways"] = ways;
  return dict;
}

py::dict dict_of(const Spread& spread) {
  py::dict dict;
  dict["median"] = spread.median;
  dict["p95"] = spread.p95;
  dict["p99"] = spread.p99;
  dict["max"] = spread.max;
  return dict;
}

py::dict check(const RoadmapFace& face, py::handle queries, py::handle seed,
               const py::object& progress, const py::kwargs& keywords) {
  CheckConfig config = check_fields().read_all(keywords);
  read(queries, "queries", config.queries);
  config.seed = static_cast<std::uint64_t>(whole_from(seed, "seed"));
  const CheckReport report = run_long(progress, 0, [&](const Progress& go_on) {
    return check_roadmap(*face.roadmap, config, go_on);
  });
  py::dict dict;
  dict["edges"] = report.edges;
  dict["edges_below_clearance"] = report.edges_below_clearance;
  dict["queries"] = report.queries;
  dict["graph_ok"] = report.graph_ok;
  dict["esdf_ok"] = report.esdf_ok;
  dict["disagreements"] = report.disagreements;
  dict["paths_below_clearance"] = report.paths_below_clearance;
  dict["fallbacks"] = report.fallbacks;
  dict["length_ratio"] = dict_of(report.length_ratio);
  dict["microseconds"] = dict_of(report.microseconds);
  dict["clean"] = report.is_clean();
  return dict;
}

py::str roadmap_repr(const RoadmapFace& face) {
  const Roadmap& roadmap = *face.roadmap;
  return text_to_python("Roadmap(min_clearance=" + literal(roadmap.min_clearance) +
                        ", voxel_size=" + literal(roadmap.esdf.voxel_size) +
                        ", vertices=" + std::to_string(roadmap.graph.vertices.size()) +
                        ", edges=" + std::to_string(roadmap.graph.edges.size()) +
                        (roadmap.source.empty() ? "" : ", source='" + roadmap.source + "'") + ")");
}

void add_parts(py::class_<RoadmapFace>& type) {
  type.def_property_readonly(
          "esdf",
          [](const RoadmapFace& face) {
            return EsdfFace{{face.roadmap, &face.roadmap->esdf}};
          },
          "The distance field, an EsdfMap; not a copy.")
      .def_property_readonly(
          "diagram",
          [](const RoadmapFace& face) {
            return MaskFace{{face.roadmap, &face.roadmap->esdf},
                            {face.roadmap, &face.roadmap->diagram.voxels}};
          },
          "The skeleton: its voxels, a VoxelMask; not a copy.")
      .def_property_readonly(
          "graph",
          [](const RoadmapFace& face) {
            return GraphFace{{face.roadmap, &face.roadmap->esdf},
                             {face.roadmap, &face.roadmap->graph}};
          },
          "The SparseGraph; not a copy.")
      .def_property_readonly(
          "min_clearance", [](const RoadmapFace& face) { return face.roadmap->min_clearance; },
          "Smallest robot radius that may be asked for, metres.")
      .def_property_readonly(
          "voxel_size", [](const RoadmapFace& face) { return face.roadmap->esdf.voxel_size; },
          "Metres.")
      .def_property_readonly(
          "is_settled", [](const RoadmapFace& face) { return face.roadmap->is_settled; },
          "False: a live snapshot without its shortcuts around corners.")
      .def_property_readonly(
          "source", [](const RoadmapFace& face) { return text_to_python(face.roadmap->source); },
          "Name of the map's file, or ''.")
      .def_property_readonly(
          "config",
          [](const RoadmapFace& face) -> py::object {
            if (face.roadmap->config.empty()) return py::dict();
            return py::module_::import("json").attr("loads")(face.roadmap->config);
          },
          "What it was built with, a dict.")
      .def_property_readonly("report", &report_of,
                             "Counts and seconds of the build, a dict; None where it was loaded.");
}

}  // namespace

void add_roadmap(py::module_& module) {
  py::class_<RoadmapFace> type(module, "Roadmap",
                               "What queries need: distance field, skeleton, graph. Never changes; "
                               "any number of threads may plan on one.");
  add_parts(type);
  add_queries(type);
  add_trajectories(type);
  add_pictures(type);
  type.def("save", &save, py::arg("path"),
           "save(self, path)\n--\n\n"
           "Writes a .ridge file, whole or not at all. The same roadmap gives the same bytes.")
      .def(
          "export_graph",
          [](const RoadmapFace& face, py::handle path) {
            const std::filesystem::path file = path_from(path, "path");
            const Unlocked unlocked;
            write_graph(*face.roadmap, file);
          },
          py::arg("path"),
          "export_graph(self, path)\n--\n\n"
          "Writes the graph as .json, .graphml, .ply, or .pb (voxblox's sparse graph).")
      .def(
          "export_voxblox",
          [](const RoadmapFace& face, py::handle path) {
            const std::filesystem::path file = path_from(path, "path", ".vxblx");
            const Unlocked unlocked;
            write_voxblox(*face.roadmap, file);
          },
          py::arg("path"),
          "export_voxblox(self, path)\n--\n\nWrites the field and the diagram as layers of "
          "voxblox, .vxblx.")
      .def(
          "describe", &describe_point, py::arg("point"),
          "describe(self, point)\n--\n\n"
          "What the smallest robot finds at a place, (x, y, z), metres, world: a dict of status "
          "('ok', or why it cannot\nbe there), state of the voxel, clearance (metres), component "
          "(as in `components`, or None) and ways to\nother components: dicts of component, radius "
          "(at which they would be one), place and what is there (by).")
      .def("components", &components_of,
           "components(self)\n--\n\n"
           "Connected parts of traversable space, largest first: dicts of voxels, volume (m^3), "
           "widest (place)\nand clearance (there, metres). Takes about as long as a build's half.")
      .def("check", &check, py::arg("queries") = 0, py::arg("seed") = 1,
           py::arg("progress") = py::none(),
           ("check(self, queries=0, seed=1, progress=None, *, " +
            check_fields().signature().substr(2) +
            ")\n--\n\nVerifies every edge, and random queries against A* through the distance "
            "field: a dict of counts, of\nlengths over the shorter of both, and of the roadmap's "
            "times; `clean` says that nothing was wrong.\n" +
            check_fields().docs())
               .c_str())
      .def("__repr__", &roadmap_repr);

  const std::string parameters =
      "\n  progress: called with a stage and the share done, 0 to 1; False cancels"
      "\n  threads: 0 for all of the machine's; the result does not depend on it";
  const std::string doc =
      "build(map, *, progress=None, threads=0" + build_fields().signature() +
      ", **loading)\n--\n\nThe Roadmap of an OccupancyMap, or of the file of one: then with the "
      "keyword arguments of load_map\ntoo. Ctrl-C and `progress` cancel it anywhere.\n" +
      parameters + build_fields().docs();
  module.def("build", &build, py::arg("map"), py::kw_only(), py::arg("progress") = py::none(),
             py::arg("threads") = 0, doc.c_str());
  module.def("load", &load, py::arg("path"), "load(path)\n--\n\nThe Roadmap of a .ridge file.");
}

}  // namespace ridgeway::python
