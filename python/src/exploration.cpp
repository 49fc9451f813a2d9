// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// What a robot does to see what it has not seen.
#include <cmath>
#include <mutex>

#include "config.hpp"
#include "faces.hpp"
#include "flights.hpp"
#include "long_call.hpp"
#include "ridgeway/exploration/explorer.hpp"
#include "sensors.hpp"

namespace ridgeway::python {
namespace {

/// Decisions come one after the other, whoever asks from Python.
class ExplorerFace {
 public:
  explicit ExplorerFace(const ExplorerConfig& config) : explorer_(config) {}

  ExplorationStep decide(const RoadmapFace& roadmap, py::handle time, py::handle position,
                         py::handle velocity, py::handle acceleration, py::handle yaw) {
    FlightState state;
    state.time = number_from(time, "time");
    state.position = point_from(position, "position");
    state.velocity = point_from(velocity, "velocity");
    state.acceleration = point_from(acceleration, "acceleration");
    state.yaw = number_from(yaw, "yaw");
    const Unlocked unlocked;
    const std::scoped_lock lock(mutex_);
    ExplorationStep step = explorer_.decide(roadmap.roadmap, state);
    roadmap_ = roadmap.roadmap;
    return step;
  }

  py::list unseen() {
    const std::vector<UnseenFrontier> left = run_stage([&] {
      const std::scoped_lock lock(mutex_);
      return explorer_.unseen();
    });
    py::list list;
    for (const UnseenFrontier& frontier : left) {
      py::dict dict;
      dict["centroid"] = tuple_of(frontier.centroid);
      dict["voxels"] = frontier.voxels;
      dict["reason"] = std::string(name_of(frontier.reason));
      dict["door"] = frontier.door ? py::object(tuple_of(*frontier.door)) : py::none();
      dict["door_radius"] = frontier.door_radius;
      list.append(dict);
    }
    return list;
  }

  py::list frontiers() {
    std::vector<FrontierCluster> clusters;
    std::shared_ptr<const Roadmap> roadmap;
    {
      const Unlocked unlocked;
      const std::scoped_lock lock(mutex_);
      const auto all = explorer_.frontiers().clusters();
      clusters.assign(all.begin(), all.end());
      roadmap = roadmap_;
    }
    py::list list;
    for (const FrontierCluster& cluster : clusters) {
      py::dict dict;
      dict["centroid"] = tuple_of(to_world(roadmap->esdf, cluster.centroid));
      dict["voxels"] = cluster.voxels;
      dict["normal"] = tuple_of(Point(cluster.normal));
      list.append(dict);
    }
    return list;
  }

 private:
  std::mutex mutex_;
  Explorer explorer_;
  std::shared_ptr<const Roadmap> roadmap_;  ///< that was decided on last
};

py::tuple viewpoint_tuple(const Viewpoint& view) {
  return py::make_tuple(view.position.x(), view.position.y(), view.position.z(), view.yaw);
}

py::array tour_of(const ExplorationStep& step) {
  std::vector<double> numbers;
  for (const Viewpoint& view : step.tour)
    numbers.insert(numbers.end(),
                   {view.position.x(), view.position.y(), view.position.z(), view.yaw});
  return owning_array(std::move(numbers), {static_cast<py::ssize_t>(step.tour.size()), 4});
}

py::dict step_seconds(const ExplorationStep& step) {
  py::dict seconds;
  seconds["frontiers"] = step.seconds.frontiers;
  seconds["views"] = step.seconds.views;
  seconds["tour"] = step.seconds.tour;
  seconds["trajectory"] = step.seconds.trajectory;
  seconds["total"] = step.seconds.total;
  return seconds;
}

void add_step(py::module_& module) {
  py::class_<ExplorationStep>(module, "ExplorationStep",
                              "What a robot is to do now: true where it has a new trajectory.")
      .def_property_readonly(
          "status", [](const ExplorationStep& step) { return std::string(name_of(step.status)); },
          "'fly', 'keep', 'return', 'complete', 'out_of_time' or 'stuck'.")
      .def("__bool__",
           [](const ExplorationStep& step) { return !step.trajectory.segments.empty(); })
      .def_property_readonly(
          "duration", [](const ExplorationStep& step) { return step.trajectory.duration(); },
          "Of the trajectory, seconds.")
      .def_property_readonly(
          "durations", [](const ExplorationStep& step) { return durations_of(step.trajectory); },
          "Of its polynomial pieces, (S,), seconds.")
      .def_property_readonly(
          "coefficients",
          [](const ExplorationStep& step) { return coefficients_of(step.trajectory); },
          "Of the pieces, (S, 4, 10): x, y, z (metres), yaw (radians) by powers of t (seconds).")
      .def(
          "sample",
          [](const ExplorationStep& step, py::handle between) {
            return samples_of(step.trajectory, between);
          },
          py::arg("step") = 0.05,
          "sample(self, step=0.05)\n--\n\nStates of the trajectory every `step` seconds from now, "
          "and at the end, as TrajectorySamples.")
      .def_property_readonly(
          "goal",
          [](const ExplorationStep& step) {
            return step.goal ? py::object(viewpoint_tuple(*step.goal)) : py::none();
          },
          "Where the next look is taken, (x, y, z, yaw), metres, radians; or None.")
      .def_property_readonly("tour", &tour_of,
                             "The looks that follow, the goal first, (N, 4): x, y, z, yaw.")
      .def_readonly("tour_seconds", &ExplorationStep::tour_seconds, "That they take, about.")
      .def_readonly("was_in_doubt", &ExplorationStep::was_in_doubt,
                    "What was flown before is not free for certain any more.")
      .def_readonly("is_braking", &ExplorationStep::is_braking,
                    "The trajectory does no more than stop the robot.")
      .def_readonly("frontiers", &ExplorationStep::frontiers, "How many there are.")
      .def_readonly("frontier_voxels", &ExplorationStep::frontier_voxels, "In them.")
      .def_property_readonly("seconds", &step_seconds,
                             "Of frontiers, views, tour, trajectory, and in total.")
      .def("__repr__", [](const ExplorationStep& step) {
        return "ExplorationStep(status='" + std::string(name_of(step.status)) +
               "', duration=" + literal(step.trajectory.duration()) +
               ", frontiers=" + std::to_string(step.frontiers) + ")";
      });
}

/// The angles and the range of a camera as keyword arguments of Explorer.
py::dict view_of_camera(const PinholeCamera& camera, py::handle min_range, py::handle max_range,
                        py::handle share_of_range) {
  DepthSensor sensor;
  sensor.camera = camera;
  read(min_range, "min_range", sensor.min_range);
  read(max_range, "max_range", sensor.max_range);
  const double share = number_from(share_of_range, "share_of_range");
  return dict_of(field_of_view(sensor, share));
}

}  // namespace

py::dict dict_of(const FieldOfView& view) {
  py::dict dict;
  dict["horizontal"] = view.horizontal;
  dict["vertical"] = view.vertical;
  dict["nearest"] = view.nearest;
  dict["range"] = view.range;
  return dict;
}

void add_exploration(py::module_& module) {
  add_step(module);
  const std::string signature = explorer_fields().signature().substr(2);
  py::class_<ExplorerFace>(
      module, "Explorer",
      ("Explorer(*, " + signature +
       ")\n--\n\nDecides where a robot with a level depth sensor flies to map what it has not "
       "seen. Knows nothing of\nsensors, clocks and threads; the same calls give the same "
       "answers.\n" +
       explorer_fields().docs())
          .c_str())
      .def(py::init([](const py::kwargs& keywords) {
             return std::make_unique<ExplorerFace>(explorer_fields().read_all(keywords));
           }),
           ("__init__(self, *, " + signature + ")\n--\n\n").c_str())
      .def(
          "decide", method(&ExplorerFace::decide), py::arg("roadmap"), py::arg("time"),
          py::arg("position"), py::arg("velocity") = py::make_tuple(0.0, 0.0, 0.0),
          py::arg("acceleration") = py::make_tuple(0.0, 0.0, 0.0), py::arg("yaw") = 0.0,
          "decide(self, roadmap, time, position, velocity=(0.0, 0.0, 0.0), acceleration=(0.0, 0.0, "
          "0.0), yaw=0.0)\n--\n\n"
          "What to do now, an ExplorationStep; to be asked after every scan, with the snapshot of "
          "a LiveRoadmap and\nhow the robot moves: seconds, metres, radians, world.")
      .def("unseen", method(&ExplorerFace::unseen),
           "unseen(self)\n--\n\n"
           "The frontiers that are left, dicts of centroid, voxels, reason ('too_narrow', "
           "'out_of_view',\n'looked_in_vain' or 'not_visited'), door (where it is too narrow, or "
           "None) and "
           "door_radius.")
      .def("frontiers", method(&ExplorerFace::frontiers),
           "frontiers(self)\n--\n\n"
           "Where what is known ended at the last decision: dicts of centroid (metres, world), "
           "voxels, and normal\n(towards the unknown).")
      .def("__repr__", [](const ExplorerFace&) { return "Explorer()"; });
  module.def("field_of_view", &view_of_camera, py::arg("camera"), py::arg("min_range") = 0.0,
             py::arg("max_range") = 10.0, py::arg("share_of_range") = 0.7,
             "field_of_view(camera, min_range=0.0, max_range=10.0, share_of_range=0.7)\n--\n\n"
             "What a PinholeCamera sees, as keyword arguments of Explorer; counting on a share of "
             "its range, since rays\nthat meet nothing within it measure nothing.");
}

}  // namespace ridgeway::python
