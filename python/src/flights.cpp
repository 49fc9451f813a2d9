// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Trajectories.
#include "flights.hpp"

#include <algorithm>
#include <cmath>

#include "config.hpp"
#include "faces.hpp"
#include "lock.hpp"
#include "plans.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway::python {
namespace {

/// A trajectory and the path that it follows.
struct FlightFace {
  PlanResult path;
  TrajectoryResult result;
};

std::string reason_of(TrajectoryStatus status) {
  switch (status) {
    case TrajectoryStatus::kOk:
      return "";
    case TrajectoryStatus::kPathNotFree:
      return "the path is not free at the radius";
    case TrajectoryStatus::kCannotStopInTime:
      return "from this motion neither the path can be followed nor is braking free";
  }
  return "invalid";
}

/// What is not said of the robot and its limits is as the path was asked for.
TrajectoryConfig config_for(const PlanConfig& plan, const RoadmapFace& face, py::handle radius,
                            const py::kwargs& keywords) {
  TrajectoryConfig config = trajectory_fields().read_all(keywords);
  config.radius = radius.is_none() ? plan.radius.value_or(face.roadmap->min_clearance)
                                   : number_from(radius, "radius");
  if (config.robot_height == 0.0) config.robot_height = plan.robot_height;
  if (!keywords.contains("limits") || keywords["limits"].is_none()) config.limits = plan.limits;
  config.validate();
  return config;
}

/// A plan with its escapes, or a path of points.
FlightFace fly(const RoadmapFace& face, py::handle path, py::handle radius,
               const py::kwargs& keywords) {
  const bool is_plan = py::isinstance<PlanFace>(path);
  TrajectoryConfig config = config_for(is_plan ? path.cast<const PlanFace&>().config : PlanConfig{},
                                       face, radius, keywords);
  FlightFace flight;
  if (is_plan) {
    const auto& plan = path.cast<const PlanFace&>();
    flight.path = static_cast<const PlanResult&>(plan);
    flight.path.planned_for = {};  // `config` has it, or what was said in its place
    config.via.insert(config.via.end(), plan.via.begin(), plan.via.end());
    if (!flight.path.ok())
      throw InputError("path", "is no path: " + std::string(name_of(flight.path.status)),
                       "give a plan that is ok");
  } else {
    flight.path = given_plan(face.roadmap->esdf, points_from(path, "path"));
  }
  const Unlocked unlocked;
  const EsdfMap& esdf = face.roadmap->esdf;
  flight.result = is_plan ? fly_plan(esdf, flight.path, config)
                          : plan_trajectory(esdf, flight.path.waypoints, config);
  return flight;
}

void require_ok(const FlightFace& flight) {
  if (!flight.result.ok())
    throw InputError("trajectory", "is none: " + std::string(name_of(flight.result.status)),
                     "ask for its status first");
}

std::string flight_repr(const FlightFace& flight) {
  const TrajectoryResult& result = flight.result;
  if (!result.ok()) return "Trajectory(status='" + std::string(name_of(result.status)) + "')";
  return "Trajectory(status='ok', duration=" + literal(result.duration) +
         ", clearance=" + shown(result.clearance) + ", max_speed=" + literal(result.peaks.speed) +
         ", segments=" + std::to_string(result.trajectory.segments.size()) + ")";
}

py::object arrays_of(const std::vector<TrajectoryState>& states) {
  std::vector<double> time, yaw, yaw_rate;
  std::vector<Point> position, velocity, acceleration;
  for (const TrajectoryState& s : states) {
    time.push_back(s.time);
    position.push_back(s.position);
    velocity.push_back(s.velocity);
    acceleration.push_back(s.acceleration);
    yaw.push_back(s.yaw);
    yaw_rate.push_back(s.yaw_rate);
  }
  const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(time.size())};
  return py::module_::import("ridgeway._values")
      .attr("TrajectorySamples")(
          owning_array(std::move(time), shape), array_of(std::move(position)),
          array_of(std::move(velocity)), array_of(std::move(acceleration)),
          owning_array(std::move(yaw), shape), owning_array(std::move(yaw_rate), shape));
}

}  // namespace

py::object samples_of(const Trajectory& trajectory, py::handle step) {
  const double seconds = number_from(step, "step");
  std::vector<TrajectoryState> states;
  {
    const Unlocked unlocked;
    states = trajectory.sample(seconds);
  }
  return arrays_of(states);
}

py::object states_at(const Trajectory& trajectory, py::handle times) {
  const std::string expected = "a time, or (N,) of them, seconds";
  const Doubles array = doubles_from(times, "times", expected);
  if (array.ndim() > 1) throw InputError("times", "is " + describe(times), "give " + expected);
  const std::vector<double> all(array.data(), array.data() + array.size());
  if (!std::all_of(all.begin(), all.end(), [](double time) { return std::isfinite(time); }))
    throw InputError("times", "has one that is not finite", "give " + expected);
  std::vector<TrajectoryState> states;
  {
    const Unlocked unlocked;
    for (const double time : all) states.push_back(trajectory.at(time));
  }
  py::object arrays = arrays_of(states);
  if (array.ndim() > 0) return arrays;
  py::list of_one;
  for (const py::handle& values : arrays) of_one.append(values[py::int_(0)]);
  return py::type::of(arrays)(*of_one);
}

py::array durations_of(const Trajectory& trajectory) {
  std::vector<double> seconds;
  for (const TrajectorySegment& segment : trajectory.segments) seconds.push_back(segment.duration);
  const auto count = static_cast<py::ssize_t>(seconds.size());
  return owning_array(std::move(seconds), {count});
}

py::array coefficients_of(const Trajectory& trajectory) {
  std::vector<double> numbers;
  for (const TrajectorySegment& segment : trajectory.segments)
    for (int output = 0; output < kFlatOutputs; ++output)
      for (int k = 0; k < kCoefficients; ++k) numbers.push_back(segment.coefficients(output, k));
  return owning_array(std::move(numbers), {static_cast<py::ssize_t>(trajectory.segments.size()),
                                           kFlatOutputs, kCoefficients});
}

void add_flights(py::module_& module) {
  py::class_<FlightFace>(module, "Trajectory",
                         "A verified motion in time along a path, or the reason why there is none: "
                         "true where there is one.")
      .def_property_readonly(
          "status",
          [](const FlightFace& flight) { return std::string(name_of(flight.result.status)); },
          "'ok', 'path_not_free' or 'cannot_stop_in_time'.")
      .def_property_readonly(
          "reason", [](const FlightFace& flight) { return reason_of(flight.result.status); },
          "The status in words; '' where ok.")
      .def_property_readonly(
          "ok", [](const FlightFace& flight) { return flight.result.ok(); },
          "Whether there is one.")
      .def("__bool__", [](const FlightFace& flight) { return flight.result.ok(); })
      .def_property_readonly(
          "duration", [](const FlightFace& flight) { return flight.result.duration; }, "Seconds.")
      .def_property_readonly(
          "clearance", [](const FlightFace& flight) { return flight.result.clearance; },
          "Smallest distance to an obstacle all along, metres.")
      .def_property_readonly(
          "max_speed", [](const FlightFace& flight) { return flight.result.peaks.speed; },
          "Certified, metres a second.")
      .def_property_readonly(
          "max_acceleration",
          [](const FlightFace& flight) { return flight.result.peaks.acceleration; },
          "Certified, metres a second^2.")
      .def_property_readonly(
          "max_jerk", [](const FlightFace& flight) { return flight.result.peaks.jerk; },
          "Certified, metres a second^3.")
      .def_property_readonly(
          "max_yaw_rate", [](const FlightFace& flight) { return flight.result.peaks.yaw_rate; },
          "Certified, radians a second.")
      .def_property_readonly(
          "stops", [](const FlightFace& flight) { return flight.result.stops; },
          "Between start and goal.")
      .def_property_readonly(
          "step", [](const FlightFace& flight) { return std::string(name_of(flight.result.step)); },
          "How it came about: 'smooth', 'pushed', 'inserted', 'with_stops' or 'stop_and_go'.")
      .def_property_readonly(
          "durations",
          [](const FlightFace& flight) { return durations_of(flight.result.trajectory); },
          "Of the polynomial pieces, (S,), seconds.")
      .def_property_readonly(
          "coefficients",
          [](const FlightFace& flight) { return coefficients_of(flight.result.trajectory); },
          "Of the pieces, (S, 4, 10): x, y, z (metres), yaw (radians) by powers "
          "of t (seconds).")
      .def(
          "sample",
          [](const FlightFace& flight, py::handle step) {
            return samples_of(flight.result.trajectory, step);
          },
          py::arg("step") = 0.05,
          "sample(self, step=0.05)\n--\n\nStates every `step` seconds, and at the end, as "
          "TrajectorySamples.")
      .def(
          "at",
          [](const FlightFace& flight, py::handle times) {
            require_ok(flight);
            return states_at(flight.result.trajectory, times);
          },
          py::arg("times"),
          "at(self, times)\n--\n\nStates at times (N,), seconds, as TrajectorySamples; at one time "
          "each of them is of that alone, as\na position (3,). Before the start and after the end "
          "they are those of the ends.")
      .def(
          "save",
          [](const FlightFace& flight, py::handle path, py::handle step) {
            require_ok(flight);
            const std::filesystem::path file = path_from(path, "path");
            const double seconds = number_from(step, "step");
            const Unlocked unlocked;
            write_trajectory(flight.path, flight.result, file, seconds);
          },
          py::arg("path"), py::arg("step") = 0.01,
          "save(self, path, step=0.01)\n--\n\nAs .csv, .json, or .yaml (polynomials).")
      .def("__repr__", &flight_repr);
}

void add_trajectories(py::class_<RoadmapFace>& type) {
  type.def("trajectory", &fly, py::arg("path"), py::arg("radius") = py::none(),
           ("trajectory(self, path, radius=None, *, " + trajectory_fields().signature().substr(2) +
            ")\n--\n\nA verified Trajectory along a path: a PlanResult, or points (N, 3), metres, "
            "world.\n\n  radius: of the robot, metres; None: that which the plan was asked for, of "
            "points the "
            "roadmap's;\n    limits and robot_height are the plan's, too, unless given "
            "(FlightLimits(): none)" +
            trajectory_fields().docs())
               .c_str());
}

}  // namespace ridgeway::python
