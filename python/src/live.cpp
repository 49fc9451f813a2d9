// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Roadmaps of maps that change.
#include "config.hpp"
#include "faces.hpp"
#include "long_call.hpp"
#include "maps.hpp"
#include "plans.hpp"
#include "ridgeway/live/graph_delta.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "sensors.hpp"

namespace ridgeway::python {
namespace {

py::dict dict_of(const UpdateReport& report) {
  py::dict dict;
  dict["frame"] = report.frame;
  dict["version"] = report.version;
  dict["has_roadmap"] = report.has_roadmap;
  dict["in_batch"] = report.in_batch;
  dict["changed_voxels"] = report.changed_voxels;
  dict["flipped_voxels"] = report.flipped_voxels;
  dict["added_blocks"] = report.added_blocks;
  dict["waiting_voxels"] = report.waiting_voxels;
  dict["fused_again"] = report.fused_again;
  dict["changed_distances"] = report.changed_distances;
  dict["seconds"] = report.seconds;
  dict["fusion_seconds"] = report.fusion_seconds;
  return dict;
}

std::vector<VoxelChange> changes_from(py::handle voxels, py::handle states) {
  const std::vector<VoxelIndex> places = voxels_from(voxels, "voxels");
  require_no_mask(states, "states");
  const auto array = py::array_t<std::int64_t, py::array::forcecast>::ensure(states);
  if (places.empty() && array && array.size() == 0) return {};
  const char kind = array ? py::array::ensure(states).dtype().kind() : 'O';
  if (kind == 'O') {
    PyErr_Clear();
    throw py::type_error("states: expected one state, or (N,) of them, got " + describe(states));
  }
  if (kind != 'i' && kind != 'u')
    throw py::type_error("states: expected whole numbers (0 unknown, 1 free, 2 occupied), got " +
                         describe(states));
  const bool is_one = array.ndim() == 0;
  if (!is_one && (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != places.size()))
    throw InputError(
        "states", "is " + describe(states),
        "give one state, or as many as there are voxels: " + std::to_string(places.size()));
  std::vector<VoxelChange> changes;
  changes.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int64_t state = is_one ? *array.data() : array.at(static_cast<py::ssize_t>(i));
    if (state < 0 || state > 2)
      throw InputError(is_one ? "states" : "states[" + std::to_string(i) + "]",
                       "is " + std::to_string(state), "give 0 (unknown), 1 (free) or 2 (occupied)");
    changes.push_back({places[i], static_cast<VoxelState>(state)});
  }
  return changes;
}

std::vector<PoseCorrection> corrections_from(const py::dict& poses) {
  std::vector<PoseCorrection> corrections;
  for (const auto& [frame, pose] : poses) {
    const std::int64_t number = whole_from(frame, "poses: frame");
    if (number < 1)
      throw InputError("poses: frame " + std::to_string(number), "is none", "frames count from 1");
    corrections.push_back({static_cast<std::uint64_t>(number), pose_from(pose, "poses")});
  }
  return corrections;
}

class LiveFace {
 public:
  explicit LiveFace(const LiveConfig& config) : live_(config) {}

  py::dict integrate_depth(py::handle image, const PinholeCamera& camera, py::handle pose) {
    const DepthImage depth = image_from(image, "image");
    const Eigen::Isometry3d T_world_camera = pose_from(pose, "T_world_camera");
    return update([&] { return live_.integrate(depth, camera, T_world_camera); });
  }
  py::dict integrate_points(py::handle points, py::handle pose) {
    const std::vector<Point> cloud = cloud_from(points);
    const Eigen::Isometry3d T_world_sensor = pose_from(pose, "T_world_sensor");
    return update([&] { return live_.integrate(cloud, T_world_sensor); });
  }
  py::dict set_voxels(py::handle voxels, py::handle states) {
    const std::vector<VoxelChange> changes = changes_from(voxels, states);
    return update([&] { return live_.set_voxels(changes); });
  }
  py::dict correct_poses(const py::dict& poses) {
    const std::vector<PoseCorrection> corrections = corrections_from(poses);
    return update([&] { return live_.correct_poses(corrections); });
  }
  void begin_correcting(const py::dict& poses) {
    const std::vector<PoseCorrection> corrections = corrections_from(poses);
    const Unlocked unlocked;
    live_.begin_correcting(corrections);
  }
  bool is_correction_ready() {
    const Unlocked unlocked;
    return live_.is_correction_ready();
  }
  py::dict finish_correcting() {
    return update([&] { return live_.finish_correcting(); });
  }
  py::dict catch_up() {
    return update([&] { return live_.catch_up(); });
  }

  py::object snapshot() const { return face(live_.snapshot()); }
  py::object settled() {
    return face(run_stage([&] { return live_.settled(); }));
  }
  MapFace map() {
    const Unlocked unlocked;
    return face_of(live_.map());
  }

 private:
  template <typename Work>
  py::dict update(const Work& work) {
    UpdateReport report;
    {
      const Unlocked unlocked;
      report = work();
    }
    return dict_of(report);
  }
  static py::object face(std::shared_ptr<const Roadmap> roadmap) {
    if (!roadmap) return py::none();
    return py::cast(RoadmapFace{std::move(roadmap)});
  }

  LiveRoadmap live_;
};

void add_deltas(py::module_& module) {
  py::class_<GraphDelta>(module, "GraphDelta", "What is different between two snapshots.")
      .def_property_readonly("is_empty", method(&GraphDelta::is_empty), "Whether nothing is.")
      .def_property_readonly(
          "counts",
          [](const GraphDelta& delta) {
            py::dict counts;
            counts["came_vertices"] = delta.came_vertices.size();
            counts["gone_vertices"] = delta.gone_vertices.size();
            counts["changed_vertices"] = delta.changed_vertices.size();
            counts["came_edges"] = delta.came_edges.size();
            counts["gone_edges"] = delta.gone_edges.size();
            counts["changed_edges"] = delta.changed_edges.size();
            counts["closed"] = delta.closed.size();
            return counts;
          },
          "How many vertices, edges and voxels came, went, changed or closed.")
      .def(
          "may_invalidate",
          [](const GraphDelta& delta, py::handle path, py::handle radius) {
            if (radius.is_none() && py::isinstance<PlanFace>(path))
              return may_be_invalid(path.cast<const PlanFace&>(), delta);
            return may_be_invalid(path_points_from(path, "path"), number_from(radius, "radius"),
                                  delta);
          },
          py::arg("path"), py::arg("radius") = py::none(),
          "may_invalidate(self, path, radius=None)\n--\n\n"
          "Whether a path (N, 3), or a PlanResult, for which no radius need be given, that was "
          "free "
          "may not be so any\nmore; False is certain. Then ask Roadmap.still_safe of the new "
          "snapshot, or EsdfMap.path_is_free.")
      .def("__repr__", [](const GraphDelta& delta) {
        return "GraphDelta(came_edges=" + std::to_string(delta.came_edges.size()) +
               ", gone_edges=" + std::to_string(delta.gone_edges.size()) +
               ", closed=" + std::to_string(delta.closed.size()) + ")";
      });
  module.def(
      "delta_between",
      [](const RoadmapFace& before, const RoadmapFace& now) {
        const Unlocked unlocked;
        return delta_between(*before.roadmap, *now.roadmap);
      },
      py::arg("before"), py::arg("now"),
      "delta_between(before, now)\n--\n\nThe GraphDelta of two roadmaps of one map.");
}

}  // namespace

void add_live(py::module_& module) {
  add_deltas(module);
  const std::string signature = live_fields().signature().substr(2);
  py::class_<LiveFace>(
      module, "LiveRoadmap",
      ("LiveRoadmap(*, " + signature +
       ")\n--\n\nA roadmap that follows its map while that is made. After every update a snapshot "
       "is what `build` would\nmake of the map. Any thread may ask for snapshots and plan on them. "
       "Updates give a dict of what changed.\n" +
       live_fields().docs())
          .c_str())
      .def(py::init([](const py::kwargs& keywords) {
             LiveConfig config = live_fields().read_all(keywords);
             config.record = record_of(config.build, config.fusion.voxel_size);
             return std::make_unique<LiveFace>(config);
           }),
           ("__init__(self, *, " + signature + ")\n--\n\n").c_str())
      .def("integrate_depth", method(&LiveFace::integrate_depth), py::arg("image"),
           py::arg("camera"), py::arg("T_world_camera"),
           "integrate_depth(self, image, camera, T_world_camera)\n--\n\n"
           "Depths along the optical axis (H, W), metres, 0 or NaN where nothing was measured; a "
           "PinholeCamera;\nits pose (4, 4).")
      .def("integrate_points", method(&LiveFace::integrate_points), py::arg("points"),
           py::arg("T_world_sensor"),
           "integrate_points(self, points, T_world_sensor)\n--\n\n"
           "Points (N, 3) in the sensor's frame, metres, and its pose (4, 4).")
      .def("set_voxels", method(&LiveFace::set_voxels), py::arg("voxels"), py::arg("states"),
           "set_voxels(self, voxels, states)\n--\n\n"
           "Voxels of the lattice (N, 3), whole numbers (v holds the points from v * voxel_size to "
           "(v + 1) *\nvoxel_size), and the states (N,), or one, that they now have.")
      .def("correct_poses", method(&LiveFace::correct_poses), py::arg("poses"),
           "correct_poses(self, poses)\n--\n\n"
           "Fuses frames again with other poses: {frame, counted from 1: (4, 4)}. Needs "
           "log_folder.")
      .def("begin_correcting", method(&LiveFace::begin_correcting), py::arg("poses"),
           "begin_correcting(self, poses)\n--\n\n"
           "Begins the same in a thread of its own and returns at once: scans may be fused "
           "meanwhile.")
      .def("is_correction_ready", method(&LiveFace::is_correction_ready),
           "is_correction_ready(self)\n--\n\n"
           "Whether finish_correcting would not wait for that thread.")
      .def("finish_correcting", method(&LiveFace::finish_correcting),
           "finish_correcting(self)\n--\n\n"
           "Waits for that thread and updates the roadmap.")
      .def("catch_up", method(&LiveFace::catch_up),
           "catch_up(self)\n--\n\nFollows what waits outside of the window.")
      .def("snapshot", method(&LiveFace::snapshot),
           "snapshot(self)\n--\n\n"
           "The Roadmap after the last update, which stays as it is; None while nothing is "
           "traversable.")
      .def("settled", method(&LiveFace::settled),
           "settled(self)\n--\n\n"
           "The same with shortcuts around corners, which takes as long as many updates.")
      .def("map", method(&LiveFace::map),
           "map(self)\n--\n\nThe OccupancyMap after the last update.")
      .def("__repr__", [](const LiveFace& face) {
        const py::object snapshot = face.snapshot();
        return "LiveRoadmap(snapshot=" + std::string(py::repr(snapshot)) + ")";
      });
}

}  // namespace ridgeway::python
