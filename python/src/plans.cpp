// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Queries on roadmaps and their answers.
#include "plans.hpp"

#include <cmath>
#include <map>

#include "config.hpp"
#include "long_call.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::python {
namespace {

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
      return "no route joins start and goal at this radius (Roadmap.explain tells why)";
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

/// Of an end that is too near to an obstacle, where it lies in one: which snap would help.
std::string reason_of(const PlanFace& plan) {
  const bool is_start = plan.status == PlanStatus::kStartInCollision;
  if (!plan.question || !(is_start || plan.status == PlanStatus::kGoalInCollision))
    return reason_of(plan.status);
  const auto& [roadmap, start, goal] = *plan.question;
  const EsdfMap& esdf = roadmap->esdf;
  if (FreeSpace(esdf).distance(flight_place(esdf, is_start ? start : goal)) > 0.0)
    return reason_of(plan.status);
  const double radius = plan.config.radius.value_or(roadmap->min_clearance);
  std::string text = std::string(is_start ? "the start" : "the goal") + " lies in an obstacle";
  const Unlocked unlocked;
  const std::optional<double> snap =
      smallest_snap(*roadmap, start, goal, 16.0 * radius, plan.config);
  if (!snap) return text;
  return text + " (snap=" + literal(std::ceil(*snap * 1000.0 - 1e-6) / 1000.0) +
         " moves it to where the robot fits)";
}

PlanFace plan_face(const std::shared_ptr<const Roadmap>& roadmap, const Point& start,
                   const Point& goal, const PlanConfig& config, PlanResult plan) {
  PlanFace face{std::move(plan), config};
  if (face.status == PlanStatus::kStartInCollision || face.status == PlanStatus::kGoalInCollision)
    face.question =
        std::make_shared<const PlanFace::Question>(PlanFace::Question{roadmap, start, goal});
  return face;
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

PlanFace plan_one(const RoadmapFace& face, py::handle start, py::handle goal,
                  const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const Point from = point_from(start, "start"), to = point_from(goal, "goal");
  const Unlocked unlocked;
  return plan_face(face.roadmap, from, to, config, plan(*face.roadmap, from, to, config));
}

/// One place for each of `count` queries.
Point at(const std::vector<Point>& points, std::size_t i) {
  return points.size() == 1 ? points.front() : points[i];
}

std::vector<Point> one_or_many(py::handle value, const char* name) {
  const Doubles array = doubles_from(value, name, "(3,) or (N, 3) numbers, metres");
  if (array.ndim() == 1 && array.size() == 3) return {point_from(value, name)};
  return points_from(value, name);
}

/// Runs `count` pieces of work on so many threads; Ctrl-C ends it after those under way.
template <typename Work>
void run_many(int threads, std::size_t count, const Work& work) {
  run_stage(
      [&] {
        parallel_for_each_index(count, [&](std::size_t i) {
          detail::stop_if_cancelled();
          work(i);
        });
        return true;
      },
      threads);
}

py::list list_of(std::vector<PlanFace> plans) {
  py::list list;
  for (PlanFace& plan : plans) list.append(py::cast(std::move(plan)));
  return list;
}

py::list plan_many(const RoadmapFace& face, py::handle starts, py::handle goals, py::handle threads,
                   const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const std::vector<Point> from = one_or_many(starts, "starts"), to = one_or_many(goals, "goals");
  if (from.size() != to.size() && from.size() != 1 && to.size() != 1)
    throw InputError("starts and goals",
                     "are " + std::to_string(from.size()) + " and " + std::to_string(to.size()),
                     "give as many of both, or one of either");
  int count = 0;
  read(threads, "threads", count);
  const std::size_t queries = from.empty() || to.empty() ? 0 : std::max(from.size(), to.size());
  std::vector<PlanFace> plans(queries);
  run_many(count, queries, [&](std::size_t i) {
    plans[i] = plan_face(face.roadmap, at(from, i), at(to, i), config,
                         plan(*face.roadmap, at(from, i), at(to, i), config));
  });
  return list_of(std::move(plans));
}

py::array goal_distances(const RoadmapFace& face, py::handle start, py::handle goals,
                         py::handle radius) {
  const Point from = point_from(start, "start");
  const std::vector<Point> to = points_from(goals, "goals");
  std::optional<double> r;
  read(radius, "radius", r);
  std::vector<double> lengths;
  {
    const Unlocked unlocked;
    lengths = distances_to_goals(*face.roadmap, from, to, r);
  }
  return owning_array(std::move(lengths), {static_cast<py::ssize_t>(to.size())});
}

py::tuple plan_nearest(const RoadmapFace& face, py::handle start, py::handle goals,
                       const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const Point from = point_from(start, "start");
  const std::vector<Point> to = points_from(goals, "goals");
  NearestGoal nearest;
  {
    const Unlocked unlocked;
    nearest = plan_to_nearest(*face.roadmap, from, to, config);
  }
  return py::make_tuple(nearest.goal ? py::cast(*nearest.goal) : py::none(),
                        py::cast(PlanFace{std::move(nearest.plan), config}));
}

py::tuple plan_over(const RoadmapFace& face, py::handle places, const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const std::vector<Point> points = points_from(places, "places");
  ViaPlan via;
  {
    const Unlocked unlocked;
    via = plan_via(*face.roadmap, points, config);
  }
  const py::object leg = via.plan.ok() ? py::none() : py::cast(via.leg);
  return py::make_tuple(
      py::cast(PlanFace{std::move(via.plan), config, {points.begin() + 1, points.end() - 1}}), leg);
}

AlternativesFace alternatives(const RoadmapFace& face, py::handle start, py::handle goal,
                              py::handle count, const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const Point from = point_from(start, "start"), to = point_from(goal, "goal");
  int routes = 0;
  read(count, "count", routes);
  if (routes == 0) throw InputError("count", "is 0", "ask for at least one route");
  const Unlocked unlocked;
  return {plan_alternatives(*face.roadmap, from, to, static_cast<std::size_t>(routes), config),
          config};
}

py::object explain(const RoadmapFace& face, py::handle start, py::handle goal, py::handle radius,
                   py::handle limits) {
  const Point from = point_from(start, "start"), to = point_from(goal, "goal");
  std::optional<double> given;
  read(radius, "radius", given);
  FlightLimits flight;
  read(limits, "limits", flight);
  std::optional<BlockedRoute> blocked = run_stage([&] {
    return RouteBlocks(*face.roadmap)
        .between(from, to, given.value_or(face.roadmap->min_clearance), flight);
  });
  if (!blocked) return py::none();
  return py::cast(*std::move(blocked));
}

void add_results(py::module_& module) {
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
      .def_readonly("length", &PlanFace::length, "Metres.")
      .def_readonly("clearance", &PlanFace::clearance,
                    "Smallest distance to an obstacle along the path, metres.")
      .def_readonly("within", &PlanFace::within,
                    "The path is at most so many times as long as the shortest.")
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
          py::arg("path"), "save(self, path)\n--\n\nAs .csv or .json, as the command line does.")
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
          py::arg("path"), py::arg("latitude"), py::arg("longitude"), py::arg("altitude") = 0.0,
          py::arg("x_heading") = 90.0,
          "save_mission(self, path, latitude, longitude, altitude=0.0, x_heading=90.0)\n--\n\n"
          "As a .plan of QGroundControl: latitude and longitude of the world's zero, degrees (WGS "
          "84), its altitude,\nmetres above the sea, and where its x axis points, degrees "
          "clockwise "
          "from north.")
      .def("__repr__", [](const PlanFace& plan) { return plan_repr(plan); });

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
            return PlanFace{all.routes[place_from(index, all.routes.size(), "routes")], all.config};
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

void add_plans(py::module_& module) { add_results(module); }

void add_queries(py::class_<RoadmapFace>& type) {
  const std::string fields = plan_fields().signature(), docs = plan_fields().docs();
  const std::string keywords = ", *, " + fields.substr(2);
  type.def("plan", &plan_one, py::arg("start"), py::arg("goal"),
           ("plan(self, start, goal" + keywords +
            ")\n--\n\nThe path from start to goal, (x, y, z), metres, world: a PlanResult. Every "
            "segment is verified.\n" +
            docs)
               .c_str());
  type.def("plan_many", &plan_many, py::arg("starts"), py::arg("goals"), py::kw_only(),
           py::arg("threads") = 0,
           ("plan_many(self, starts, goals, *, threads=0" + fields +
            ")\n--\n\nThe paths from each start to each goal, (N, 3), or one of either for all: a "
            "list of PlanResult,\nthe same as `plan` gives. On so many threads (0: all). Ctrl-C "
            "stops it.\n" +
            docs)
               .c_str());
  type.def("plan_nearest", &plan_nearest, py::arg("start"), py::arg("goals"),
           ("plan_nearest(self, start, goals" + keywords +
            ")\n--\n\nThe nearest of goals (N, 3): its index (None where none can be reached) and "
            "its PlanResult.\n" +
            docs)
               .c_str());
  type.def("plan_via", &plan_over, py::arg("places"),
           ("plan_via(self, places" + keywords +
            ")\n--\n\nA path over places (N, 3): a PlanResult, and the leg that has none, or "
            "None. Its `trajectory` passes\nthem.\n" +
            docs)
               .c_str());
  type.def(
      "alternatives", &alternatives, py::arg("start"), py::arg("goal"), py::arg("count") = 3,
      ("alternatives(self, start, goal, count=3" + keywords +
       ")\n--\n\nUp to `count` routes on different sides of obstacles, as Alternatives.\n" + docs)
          .c_str());
  type.def("distances", &goal_distances, py::arg("start"), py::arg("goals"),
           py::arg("radius") = py::none(),
           "distances(self, start, goals, radius=None)\n--\n\n"
           "Lengths along the graph from start to goals (N, 3): (N,), metres; inf where it has no "
           "way.");
  type.def("explain", &explain, py::arg("start"), py::arg("goal"), py::arg("radius") = py::none(),
           py::arg("limits") = py::none(),
           "explain(self, start, goal, radius=None, limits=None)\n--\n\n"
           "Why there is no route at a radius (metres), as BlockedRoute: at which there would be "
           "one, and where it\nis too narrow. None where start or goal themselves are no place to "
           "be. Takes longer than a plan.");
}

}  // namespace ridgeway::python
