// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The answers to queries.
#include "plans.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "config.hpp"
#include "esdf/widest_place.hpp"
#include "lock.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/blocked_route.hpp"

namespace ridgeway::python {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A status in words.
std::string reason_of(PlanStatus status) {
  switch (status) {
    case PlanStatus::kOk:
      return "";
    case PlanStatus::kStartOutsideMap:
      return "the start is outside of the map";
    case PlanStatus::kStartUnknown:
      return "the start is in unknown space";
    case PlanStatus::kStartInCollision:
      return "the start is nearer to an obstacle than the radius (escape=True may lead out)";
    case PlanStatus::kGoalOutsideMap:
      return "the goal is outside of the map";
    case PlanStatus::kGoalUnknown:
      return "the goal is in unknown space";
    case PlanStatus::kGoalInCollision:
      return "the goal is nearer to an obstacle than the radius (snap=METRES moves it)";
    case PlanStatus::kNoRoute:
      return "no route joins start and goal at this radius (roadmap.explain(plan) tells why)";
    case PlanStatus::kRadiusTooSmall:
      return "the radius is smaller than the roadmap was built for";
    case PlanStatus::kTimeout:
      return "the time limit has passed";
    case PlanStatus::kStartOutsideLimits:
      return "the start is outside of the flight's limits";
    case PlanStatus::kGoalOutsideLimits:
      return "the goal is outside of the flight's limits";
  }
  return "invalid";
}

std::string too_small(const PlanFace& plan, const Roadmap& roadmap) {
  const double radius = plan.config.radius.value_or(roadmap.min_clearance);
  const double inner = 0.5 * plan.config.robot_height;
  const std::string least = " (min_clearance=" + literal(roadmap.min_clearance) + ")";
  if (inner > 0.0 && inner < radius)
    return "the largest ball in a robot of that height has a radius of " + literal(inner) +
           ", less than the roadmap was built for" + least;
  return "the radius, " + literal(radius) + ", is smaller than the roadmap was built for" + least;
}

/// Whether the obstacle that is nearest to a place, within a radius, is unknown space.
bool is_unknown_nearest(const EsdfMap& esdf, const Point& place, double radius) {
  if (esdf.unknown != UnknownPolicy::kObstacle) return false;
  const PathSurroundings found = Surroundings(esdf).along(std::array{place, place}, radius);
  return found.unknown < found.known;
}

/// Where an end is too near to an obstacle, by how much and what would help.
std::string reason_of(const PlanFace& plan) {
  if (!plan.question) return reason_of(plan.status);
  const auto& [roadmap, start, goal] = *plan.question;
  if (plan.status == PlanStatus::kRadiusTooSmall) return too_small(plan, *roadmap);
  const bool is_start = plan.status == PlanStatus::kStartInCollision;
  if (!is_start && plan.status != PlanStatus::kGoalInCollision) return reason_of(plan.status);
  const std::string end = is_start ? "the start" : "the goal";
  if (plan.config.robot_height > 0.0)
    return end + " has no room for a robot of that radius and height";
  const EsdfMap& esdf = roadmap->esdf;
  const double radius = plan.config.radius.value_or(roadmap->min_clearance);
  const Unlocked unlocked;
  const Point& place = is_start ? start : goal;
  const double distance = FreeSpace(esdf).distance(flight_place(esdf, place));
  const bool is_unknown = is_unknown_nearest(esdf, place, radius);
  if (distance > 0.0) {
    const auto widest = detail::widest_place(esdf);
    return widest && widest->clearance < radius
               ? "no place of the map has room for a radius of " + literal(radius) +
                     ": the widest has " + shown(widest->clearance)
           : is_unknown ? end + " is " + literal(std::floor(distance * 1000.0 + 1e-6) / 1000.0) +
                              " m from what the map does not know, less than the radius"
                        : reason_of(plan.status);
  }
  std::string text =
      end + " lies " + (is_unknown ? "beside what the map does not know" : "in an obstacle");
  const std::optional<double> snap =
      smallest_snap(*roadmap, start, goal, 16.0 * radius, plan.config);
  if (!snap) return text;
  return text + " (snap=" + literal(std::ceil(*snap * 1000.0 - 1e-6) / 1000.0) +
         " moves it to where the robot fits)";
}

std::string plan_repr(const PlanResult& plan) {
  if (!plan.ok()) return "PlanResult(status='" + std::string(name_of(plan.status)) + "')";
  return "PlanResult(status='ok', length=" + literal(plan.length) +
         ", clearance=" + shown(plan.clearance) +
         ", waypoints=" + std::to_string(plan.waypoints.size()) + ", answered_by='" +
         std::string(name_of(plan.answered_by)) + "')";
}

py::dict plan_seconds(const PlanFace& plan) {
  py::dict seconds;
  seconds["attach"] = plan.seconds.attach;
  seconds["search"] = plan.seconds.search;
  seconds["shorten"] = plan.seconds.shorten;
  seconds["total"] = plan.seconds.total;
  return seconds;
}

void add_plan_result(py::module_& module) {
  py::class_<PlanFace>(module, "PlanResult",
                       "A path, or the one reason why there is none: true where there is one.")
      .def_property_readonly(
          "status", [](const PlanFace& plan) { return std::string(name_of(plan.status)); },
          "'ok', or why there is no path: 'no_route', 'start_in_collision', ...")
      .def_property_readonly(
          "reason", [](const PlanFace& plan) { return reason_of(plan); },
          "The status in words; '' where ok.")
      .def_property_readonly(
          "ok", [](const PlanFace& plan) { return plan.ok(); }, "Whether there is a path.")
      .def("__bool__", [](const PlanFace& plan) { return plan.ok(); })
      .def_property_readonly(
          "waypoints",
          [](const py::object& self) {
            return view_of(self.cast<const PlanFace&>().waypoints, self);
          },
          "Start first, goal last, (N, 3), metres, world; (0, 3) where there is no path. "
          "Read-only.")
      .def_property_readonly(
          "length", [](const PlanFace& plan) { return plan.ok() ? plan.length : kInfinity; },
          "Metres; inf where there is no path.")
      .def_property_readonly(
          "clearance", [](const PlanFace& plan) { return plan.ok() ? plan.clearance : kNoNumber; },
          "Smallest distance to an obstacle along the path, escapes left out, metres; nan where "
          "there is no path.")
      .def_property_readonly(
          "within", [](const PlanFace& plan) { return plan.ok() ? plan.within : kInfinity; },
          "The path is at most so many times as long as the shortest; inf where there is no path.")
      .def_property_readonly(
          "answered_by",
          [](const PlanFace& plan) { return std::string(name_of(plan.answered_by)); },
          "'graph', 'diagram', 'esdf' or 'theta'.")
      .def_property_readonly(
          "unknown", [](const PlanFace& plan) { return std::string(name_of(plan.unknown)); },
          "What unknown space was taken for: 'obstacle', 'ignore' or 'free'.")
      .def_property_readonly("seconds", &plan_seconds, "Of attach, search, shorten, and in total.")
      .def_property_readonly(
          "escape_start", [](const PlanFace& plan) { return plan.escape_start.length; },
          "Length of the first segment where it leads out of a collision, metres; else 0.")
      .def_property_readonly(
          "escape_goal", [](const PlanFace& plan) { return plan.escape_goal.length; },
          "Length of the last segment where it leads into one, metres; else 0.")
      .def_property_readonly(
          "moved_start", [](const PlanFace& plan) { return plan.moved_start.distance; },
          "How far the start was moved (snap), metres.")
      .def_property_readonly(
          "moved_goal", [](const PlanFace& plan) { return plan.moved_goal.distance; },
          "How far the goal was moved (snap), metres.")
      .def(
          "save",
          [](const PlanFace& plan, py::handle path) {
            const std::filesystem::path file = path_from(path, "path");
            const Unlocked unlocked;
            write_plan(plan, file);
          },
          py::arg("path"),
          "save(self, path)\n--\n\nAs .csv or .json, as the command line does; a plan without a "
          "path as .json only.")
      .def(
          "save_mission",
          [](const PlanFace& plan, py::handle path, py::handle latitude, py::handle longitude,
             py::handle altitude, py::handle x_heading) {
            const Datum datum{.latitude = number_from(latitude, "latitude"),
                              .longitude = number_from(longitude, "longitude"),
                              .altitude = number_from(altitude, "altitude"),
                              .x_heading = number_from(x_heading, "x_heading")};
            const std::filesystem::path file = path_from(path, "path");
            const Unlocked unlocked;
            write_mission(plan, datum, file);
          },
          py::arg("path"), py::arg("latitude"), py::arg("longitude"), py::arg("altitude"),
          py::arg("x_heading") = 90.0,
          "save_mission(self, path, latitude, longitude, altitude, x_heading=90.0)\n--\n\n"
          "As a .plan of QGroundControl: latitude and longitude of the world's zero, degrees (WGS "
          "84), its altitude,\nmetres above the sea, and where its x axis points, degrees "
          "clockwise "
          "from north.")
      .def("__repr__", [](const PlanFace& plan) { return plan_repr(plan); });
}

void add_alternatives(py::module_& module) {
  py::class_<AlternativesFace>(module, "Alternatives",
                               "Routes on other sides of obstacles, shortest first; a sequence of "
                               "PlanResult.")
      .def_property_readonly(
          "status", [](const AlternativesFace& all) { return std::string(name_of(all.status)); },
          "'ok', or why there is no route.")
      .def_property_readonly(
          "reason", [](const AlternativesFace& all) { return reason_of(all.status); },
          "The status in words; '' where ok.")
      .def_readonly("complete", &AlternativesFace::complete, "Whether more would find no more.")
      .def_readonly("seconds", &AlternativesFace::seconds, "In all.")
      .def("__len__", [](const AlternativesFace& all) { return all.routes.size(); })
      .def(
          "__getitem__",
          [](const AlternativesFace& all, py::handle index) {
            return item_or_slice(index, all.routes.size(), [&](py::handle place) {
              return py::cast(
                  PlanFace{all.routes[place_from(place, all.routes.size(), "routes")], all.config});
            });
          },
          py::arg("index"))
      .def("__iter__", &iterator_of)
      .def("__repr__", [](const AlternativesFace& all) {
        std::string text =
            "Alternatives(status='" + std::string(name_of(all.status)) + "', lengths=[";
        for (std::size_t i = 0; i < all.routes.size(); ++i)
          text += (i == 0 ? "" : ", ") + literal(all.routes[i].length);
        return text + "], complete=" + literal(all.complete) + ")";
      });
}

void add_blocked_route(py::module_& module) {
  py::class_<BlockedRoute>(module, "BlockedRoute", "Why there is no route at a radius.")
      .def_readonly("radius", &BlockedRoute::radius,
                    "Largest radius at which there is a way, metres; 0: there is none at all.")
      .def_property_readonly(
          "place",
          [](const BlockedRoute& blocked) -> py::object {
            return blocked.place ? py::object(tuple_of(*blocked.place)) : py::none();
          },
          "Where that way is narrowest, (x, y, z), metres; or None.")
      .def_property_readonly(
          "map_end",
          [](const BlockedRoute& blocked) -> py::object {
            return blocked.map_end ? py::object(tuple_of(*blocked.map_end)) : py::none();
          },
          "Where obstacles part start and goal right across the map: a place, (x, y, z), at which "
          "the only other way\nleads beyond where the map ends; or None.")
      .def_property_readonly(
          "by", [](const BlockedRoute& blocked) { return std::string(name_of(blocked.by)); },
          "What is nearest there: 'obstacle', 'unknown' or 'limits'.")
      .def("__repr__", [](const BlockedRoute& blocked) {
        return "BlockedRoute(radius=" + literal(blocked.radius) + ", place=" +
               (blocked.place ? std::string(py::str(tuple_of(*blocked.place))) : "None") +
               ", by='" + std::string(name_of(blocked.by)) + "')";
      });
}

}  // namespace

std::vector<Point> path_points_from(py::handle path, const char* name) {
  if (py::isinstance<PlanFace>(path)) return path.cast<const PlanFace&>().waypoints;
  return points_from(path, name);
}

void add_plans(py::module_& module) {
  add_plan_result(module);
  add_alternatives(module);
  add_blocked_route(module);
  module.def(
      "read_path",
      [](py::handle path) {
        const std::filesystem::path file = path_from(path, "path");
        std::vector<Point> points;
        {
          const Unlocked unlocked;
          points = read_path(file);
        }
        return array_of(std::move(points));
      },
      py::arg("path"),
      "read_path(path)\n--\n\nThe points (N, 3), metres, of a path that was saved, or of any .csv "
      "with columns x, y, z or .json list\nof [x, y, z].");
}

}  // namespace ridgeway::python
