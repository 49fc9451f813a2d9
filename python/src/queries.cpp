// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Queries on roadmaps.
#include <algorithm>

#include "config.hpp"
#include "long_call.hpp"
#include "plans.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/live/graph_delta.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::python {
namespace {

PlanFace plan_face(const std::shared_ptr<const Roadmap>& roadmap, const Point& start,
                   const Point& goal, const PlanConfig& config, PlanResult plan) {
  PlanFace face{std::move(plan), config};
  if (face.status == PlanStatus::kStartInCollision || face.status == PlanStatus::kGoalInCollision ||
      face.status == PlanStatus::kRadiusTooSmall || face.status == PlanStatus::kNoRoute)
    face.question =
        std::make_shared<const PlanFace::Question>(PlanFace::Question{roadmap, start, goal});
  return face;
}

PlanFace plan_one(const RoadmapFace& face, py::handle start, py::handle goal,
                  const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const Point from = point_from(start, "start"), to = point_from(goal, "goal");
  const auto answer = [&] {
    return plan_face(face.roadmap, from, to, config, plan(*face.roadmap, from, to, config));
  };
  // What may take seconds hears Ctrl-C, for a tenth of a millisecond.
  if (config.within > 0.0 || config.prefer_clearance > 0.0 || config.snap > 0.0 || config.escape ||
      config.planner != Planner::kGraph)
    return run_stage(answer);
  const Unlocked unlocked;
  return answer();
}

/// One place for each of `count` queries.
Point at(const std::vector<Point>& points, std::size_t i) {
  return points.size() == 1 ? points.front() : points[i];
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
  const std::vector<Point> from = one_or_many_from(starts, "starts").points,
                           to = one_or_many_from(goals, "goals").points;
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
  NearestGoal nearest = run_stage([&] { return plan_to_nearest(*face.roadmap, from, to, config); });
  return py::make_tuple(nearest.goal ? py::cast(*nearest.goal) : py::none(),
                        py::cast(PlanFace{std::move(nearest.plan), config}));
}

py::tuple plan_over(const RoadmapFace& face, py::handle places, const py::kwargs& keywords) {
  const PlanConfig config = plan_fields().read_all(keywords);
  const std::vector<Point> points = points_from(places, "places");
  ViaPlan via = run_stage([&] { return plan_via(*face.roadmap, points, config); });
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
  return {run_stage([&] {
            return plan_alternatives(*face.roadmap, from, to, static_cast<std::size_t>(routes),
                                     config);
          }),
          config};
}

/// What a query that found no route asked for, between the places that its ends were moved to.
struct Blocked {
  Point start, goal;
  std::optional<double> radius;
  FlightLimits limits;
};

py::object explained(const RoadmapFace& face, const Blocked& query) {
  std::optional<BlockedRoute> blocked = run_stage([&]() -> std::optional<BlockedRoute> {
    if (plan(*face.roadmap, query.start, query.goal,
             {.radius = query.radius, .limits = query.limits})
            .ok())
      return {};
    return RouteBlocks(*face.roadmap)
        .between(query.start, query.goal, query.radius.value_or(face.roadmap->min_clearance),
                 query.limits);
  });
  if (!blocked) return py::none();
  return py::cast(*std::move(blocked));
}

py::object explain(const RoadmapFace& face, py::handle start, py::handle goal, py::handle radius,
                   py::handle limits) {
  if (!py::isinstance<PlanFace>(start)) {
    Blocked query{point_from(start, "start"), point_from(goal, "goal"), {}, {}};
    read(radius, "radius", query.radius);
    read(limits, "limits", query.limits);
    return explained(face, query);
  }
  if (!goal.is_none() || !radius.is_none() || !limits.is_none())
    throw py::type_error("explain: a PlanResult knows its goal, radius and limits; leave them out");
  const auto& plan = start.cast<const PlanFace&>();
  if (plan.status != PlanStatus::kNoRoute || !plan.question) return py::none();
  const auto place = [](const Moved& moved, const Point& asked) {
    return moved.distance > 0.0 ? moved.place : asked;
  };
  return explained(
      face, {place(plan.moved_start, plan.question->start),
             place(plan.moved_goal, plan.question->goal), plan.config.radius, plan.config.limits});
}

/// A path that was saved, with its escapes, for a robot.
PlanFace read_plan(const RoadmapFace& face, py::handle path, py::handle radius,
                   py::handle robot_height) {
  const std::filesystem::path file = path_from(path, "path");
  PlanConfig robot;
  read(radius, "radius", robot.radius);
  read(robot_height, "robot_height", robot.robot_height);
  robot.validate();
  const Unlocked unlocked;
  const EsdfMap& esdf = face.roadmap->esdf;
  PlanFace plan{given_plan(esdf, read_path(file)), robot};
  const PathEscapes escapes = read_escapes(file);
  std::vector<Point> inner = plan.waypoints;
  const std::size_t ends = (escapes.start.length > 0.0) + (escapes.goal.length > 0.0);
  if (inner.size() <= ends)
    throw InputError(file.string(), "has escapes and nothing between them", "plan it again");
  if (escapes.start.length > 0.0) inner.erase(inner.begin());
  if (escapes.goal.length > 0.0) inner.pop_back();
  plan.clearance = given_plan(esdf, std::move(inner)).clearance;
  plan.escape_start = escapes.start;
  plan.escape_goal = escapes.goal;
  plan.planned_for = {robot.radius.value_or(face.roadmap->min_clearance), robot.robot_height, {}};
  return plan;
}

}  // namespace

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
  type.def(
      "still_safe",
      [](const RoadmapFace& face, const PlanFace& path) {
        const Unlocked unlocked;
        return still_safe(path, *face.roadmap);
      },
      py::arg("path"),
      "still_safe(self, path)\n--\n\n"
      "Whether a PlanResult of an older snapshot still holds, for the robot and the limits that it "
      "was asked for;\nits escapes at the clearance that they had.");
  type.def("distances", &goal_distances, py::arg("start"), py::arg("goals"),
           py::arg("radius") = py::none(),
           "distances(self, start, goals, radius=None)\n--\n\n"
           "Lengths along the graph from start to goals (N, 3): (N,), metres; inf where it has no "
           "way.");
  type.def("explain", &explain, py::arg("start"), py::arg("goal") = py::none(),
           py::arg("radius") = py::none(), py::arg("limits") = py::none(),
           "explain(self, start, goal=None, radius=None, limits=None)\n--\n\n"
           "Why there is no route at a radius (metres), as BlockedRoute: at which there would be "
           "one, and where it\nis too narrow. In place of start and goal: a PlanResult of status "
           "'no_route', with all that it was asked\nfor. None where there is a route (of robots "
           "with a height: for a ball of their radius), or start or goal\nare no place to be. "
           "Takes longer than a plan.");
  type.def("read_plan", &read_plan, py::arg("path"), py::arg("radius") = py::none(),
           py::arg("robot_height") = 0.0,
           "read_plan(self, path, radius=None, robot_height=0.0)\n--\n\n"
           "A path that was saved (.csv or .json), as a PlanResult for a robot: with the escapes "
           "of a .json. Not verified:\nstill_safe() and trajectory() do that.");
}

}  // namespace ridgeway::python
