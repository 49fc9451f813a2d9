// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Pictures of maps.
#include "config.hpp"
#include "faces.hpp"
#include "long_call.hpp"
#include "plans.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway::python {
namespace {

/// The points of a plan or of an array (N, 3); none for None.
std::vector<Point> waypoints_of(py::handle path, const char* name) {
  constexpr double kStep = 0.05;  // seconds between places of a flight
  if (path.is_none()) return {};
  if (py::hasattr(path, "sample"))  // a Trajectory
    return points_from(path.attr("sample")(kStep).attr("position"), name);
  if (!py::isinstance<PlanFace>(path)) return points_from(path, name);
  const auto& plan = path.cast<const PlanFace&>();
  if (!plan.ok())
    throw InputError(name, "is no path: " + std::string(name_of(plan.status)),
                     "give a plan that is ok");
  return plan.waypoints;
}

void draw(const RoadmapFace& face, py::handle file, py::handle path, const py::object& paths,
          const py::kwargs& keywords) {
  PictureConfig config = picture_fields().read_all(keywords);
  if (py::isinstance<AlternativesFace>(paths)) {
    for (const PlanResult& route : paths.cast<const AlternativesFace&>().routes)
      config.paths.push_back({"route " + std::to_string(config.paths.size() + 1), route.waypoints});
  } else if (!paths.is_none()) {
    if (!py::isinstance<py::dict>(paths))
      throw py::type_error("paths: expected a dict of names and paths, or Alternatives, got " +
                           describe(paths));
    for (const auto& [key, value] : paths.cast<py::dict>()) {
      const std::string name = text_from(key, "paths");
      config.paths.push_back({name, waypoints_of(value, ("paths['" + name + "']").c_str())});
    }
  }
  config.validate();
  const std::vector<Point> waypoints = waypoints_of(path, "path");
  const std::filesystem::path out = path_from(file, "file");
  run_stage([&] {
    draw_floor_plan(*face.roadmap, waypoints, out, config);
    return true;
  });
}

}  // namespace

void add_pictures(py::class_<RoadmapFace>& type) {
  type.def(
      "draw", &draw, py::arg("file"), py::arg("path") = py::none(), py::arg("paths") = py::none(),
      ("draw(self, file, path=None, paths=None, *, " + picture_fields().signature().substr(2) +
       ")\n--\n\nDraws the map from above, with skeleton, graph and paths, as a .png or .svg "
       "file, without matplotlib.\n\n  path: a PlanResult, a Trajectory, or points (N, 3), metres, "
       "world; or None\n  paths: others to compare, {name: path} or Alternatives, at most "
       "eight" +
       picture_fields().docs())
          .c_str());
}

}  // namespace ridgeway::python
