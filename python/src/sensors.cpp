// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Cameras, recordings and simulated worlds.
#include "sensors.hpp"

#include <cmath>

#include "config.hpp"
#include "long_call.hpp"
#include "maps.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway::python {
namespace {

py::array image_array(DepthImage image) {
  const py::ssize_t height = image.height, width = image.width;
  return owning_array(std::move(image.depth), {height, width});
}

PinholeCamera make_camera(py::handle width, py::handle height, py::handle fx, py::handle fy,
                          py::handle cx, py::handle cy) {
  PinholeCamera camera;
  read(width, "width", camera.width);
  read(height, "height", camera.height);
  // What is not said is of the middle of the image, and of 90 degrees across.
  const auto read_or = [](py::handle value, const char* name, double otherwise, double& field) {
    field = otherwise;
    if (!value.is_none()) read(value, name, field);
  };
  read_or(fx, "fx", 0.5 * camera.width, camera.fx);
  read_or(fy, "fy", camera.fx, camera.fy);
  read_or(cx, "cx", 0.5 * (camera.width - 1), camera.cx);
  read_or(cy, "cy", 0.5 * (camera.height - 1), camera.cy);
  camera.validate();
  return camera;
}

std::string camera_repr(const PinholeCamera& c) {
  return "PinholeCamera(width=" + literal(c.width) + ", height=" + literal(c.height) +
         ", fx=" + literal(c.fx) + ", fy=" + literal(c.fy) + ", cx=" + literal(c.cx) +
         ", cy=" + literal(c.cy) + ")";
}

py::object frame_of(const DepthSequence& sequence, py::handle index) {
  const DepthFrame& frame = sequence.frames[place_from(index, sequence.frames.size(), "frames")];
  DepthImage image;
  {
    const Unlocked unlocked;
    image = read_frame(sequence, frame);
  }
  return py::make_tuple(image_array(std::move(image)), array_of(frame.T_world_camera));
}

double time_from(py::handle value) {
  const double time = number_from(value, "time");
  if (!std::isfinite(time)) throw InputError("time", "is " + literal(time), "give seconds");
  return time;
}

py::array render(const World& world, const PinholeCamera& camera, py::handle pose,
                 py::handle max_range, py::handle range_sigma, py::handle seed, py::handle time) {
  DepthSensor sensor;
  sensor.camera = camera;
  read(max_range, "max_range", sensor.max_range);
  read(range_sigma, "range_sigma", sensor.range_sigma);
  sensor.validate();
  const Eigen::Isometry3d T_world_camera = pose_from(pose, "T_world_camera");
  const auto number = static_cast<std::uint64_t>(whole_from(seed, "seed"));
  const double now = time_from(time);
  DepthImage image;
  {
    const Unlocked unlocked;
    image = render_depth(world_at(world, now), sensor, T_world_camera, number);
  }
  return image_array(std::move(image));
}

py::array scan(const World& world, const SpinningLidar& lidar, py::handle pose, py::handle seed,
               py::handle time) {
  const Eigen::Isometry3d T_world_sensor = pose_from(pose, "T_world_sensor");
  const auto number = static_cast<std::uint64_t>(whole_from(seed, "seed"));
  const double now = time_from(time);
  std::vector<Point> points;
  {
    const Unlocked unlocked;
    points = scan_with(world_at(world, now), lidar, T_world_sensor, number);
  }
  return array_of(std::move(points));
}

void add_world(py::module_& module) {
  py::class_<World>(module, "World", "A simulated world: a union of solids, metres, z up.")
      .def_readonly("name", &World::name, "As its file has it.")
      .def(
          "occupancy",
          [](const World& world, py::handle voxel_size, py::handle bounds) {
            const double size = number_from(voxel_size, "voxel_size");
            const Box box = box_from(bounds, "bounds");
            return run_stage([&] { return face_of(occupancy_of(world, size, box), world.name); });
          },
          py::arg("voxel_size"), py::arg("bounds"),
          "occupancy(self, voxel_size, bounds)\n--\n\n"
          "The OccupancyMap of who knows all of the world within a box, metres. Solids that come "
          "and go "
          "are in it.")
      .def("render_depth", &render, py::arg("camera"), py::arg("T_world_camera"),
           py::arg("max_range") = 10.0, py::arg("range_sigma") = 0.0, py::arg("seed") = 0,
           py::arg("time") = 0.0,
           "render_depth(self, camera, T_world_camera, max_range=10.0, range_sigma=0.0, seed=0, "
           "time=0.0)\n--\n\nWhat a depth camera sees from a pose (4, 4): (H, W) float32, metres, "
           "0 where nothing is near.\n`time`: seconds, for solids that come and go.")
      .def("scan_with", &scan, py::arg("lidar"), py::arg("T_world_sensor"), py::arg("seed") = 0,
           py::arg("time") = 0.0,
           "scan_with(self, lidar, T_world_sensor, seed=0, time=0.0)\n--\n\n"
           "What a SpinningLidar measures in one turn, from a pose (4, 4) that it has all the "
           "while: points (N, 3),\nmetres, in its frame, without beams that meet nothing in range. "
           "`time`: seconds, for solids that "
           "come and go.")
      .def("__repr__", [](const World& world) {
        return "World(name='" + world.name + "', boxes=" + std::to_string(world.boxes.size()) +
               ", meshes=" + std::to_string(world.meshes.size()) + ")";
      });
  module.def(
      "load_world",
      [](py::handle path) {
        const std::filesystem::path file = path_from(path, "path");
        const Unlocked unlocked;
        return load_world(file);
      },
      py::arg("path"), "load_world(path)\n--\n\nThe World of a .yaml file.");
}

/// No depth camera sees so far; what is farther than a map's range is left out without a word.
void warn_of_millimetres(const DepthImage& image, const char* name) {
  constexpr float kFarthest = 100.0f;
  std::ptrdiff_t far = 0, all = 0;
  for (const float depth : image.depth)
    if (depth > 0.0f && std::isfinite(depth)) {
      ++all;
      far += depth > kFarthest;
    }
  if (2 * far <= all) return;
  py::module_::import("warnings")
      .attr("warn")(std::string(name) +
                        ": most depths are above 100 m; they are metres, millimetres have to be "
                        "divided by 1000",
                    py::handle(PyExc_UserWarning), 1);
}

}  // namespace

DepthImage image_from(py::handle value, const char* name) {
  const std::string expected = "an (H, W) array of depths, metres";
  const Doubles checked = doubles_from(value, name, expected);
  if (checked.ndim() != 2) throw InputError(name, "is " + describe(value), "give " + expected);
  // Millimetres of a file, most likely, of which every one would lie out of range.
  if (py::array::ensure(value).dtype().kind() != 'f')
    throw py::type_error(std::string(name) + ": expected metres as floats, got " + describe(value) +
                         "; divide by the units of a metre: image / 1000.0");
  constexpr py::ssize_t kLongest = 1 << 20;
  if (checked.shape(0) > kLongest || checked.shape(1) > kLongest)
    throw InputError(name, "is " + describe(value), "give a smaller image");
  DepthImage image;
  image.height = static_cast<int>(checked.shape(0));
  image.width = static_cast<int>(checked.shape(1));
  image.depth.reserve(static_cast<std::size_t>(checked.size()));
  for (py::ssize_t i = 0; i < checked.size(); ++i)
    image.depth.push_back(static_cast<float>(checked.data()[i]));
  warn_of_millimetres(image, name);
  return image;
}

void add_sensors(py::module_& module) {
  py::class_<PinholeCamera>(
      module, "PinholeCamera",
      "PinholeCamera(width=320, height=240, fx=None, fy=None, cx=None, cy=None)\n--\n\n"
      "From pixels to rays, without distortion; all in pixels. Its frame: x right, y down, z "
      "forward.\nNone: the middle of the image, 90 degrees across, and as long a focal length "
      "down as across.")
      .def(py::init(&make_camera), py::arg("width") = 320, py::arg("height") = 240,
           py::arg("fx") = py::none(), py::arg("fy") = py::none(), py::arg("cx") = py::none(),
           py::arg("cy") = py::none(),
           "__init__(self, width=320, height=240, fx=None, fy=None, cx=None, cy=None)\n--\n\n")
      .def_readonly("width", &PinholeCamera::width, "Pixels.")
      .def_readonly("height", &PinholeCamera::height, "Pixels.")
      .def_readonly("fx", &PinholeCamera::fx, "Focal length across, pixels.")
      .def_readonly("fy", &PinholeCamera::fy, "Focal length down, pixels.")
      .def_readonly("cx", &PinholeCamera::cx, "Where the optical axis meets the image, pixels.")
      .def_readonly("cy", &PinholeCamera::cy, "Where the optical axis meets the image, pixels.")
      .def("__repr__", &camera_repr);

  py::class_<DepthSequence>(
      module, "DepthSequence",
      "A recording of depth images with poses; sequence[i] is the i-th: (image, T_world_camera).")
      .def_readonly("layout", &DepthSequence::layout, "'tum', '7-scenes' or 'open3d'.")
      .def_readonly("camera", &DepthSequence::camera, "That of all images.")
      .def_readonly("without_pose", &DepthSequence::without_pose,
                    "Images that no pose belongs to, passed over.")
      .def("__len__", [](const DepthSequence& sequence) { return sequence.frames.size(); })
      .def(
          "__getitem__",
          [](const DepthSequence& sequence, py::handle index) {
            return item_or_slice(index, sequence.frames.size(),
                                 [&](py::handle place) { return frame_of(sequence, place); });
          },
          py::arg("index"))
      .def("__iter__", &iterator_of)
      .def("__repr__", [](const DepthSequence& sequence) {
        return "DepthSequence(" + std::to_string(sequence.frames.size()) + " frames, layout='" +
               sequence.layout + "')";
      });
  module.def(
      "open_sequence",
      [](py::handle folder) {
        const std::filesystem::path path = path_from(folder, "folder");
        const Unlocked unlocked;
        return open_sequence(path);
      },
      py::arg("folder"),
      "open_sequence(folder)\n--\n\n"
      "A recording in the layout of TUM RGB-D, 7-Scenes or Open3D: a DepthSequence.");
  add_scans(module);
  add_world(module);
}

}  // namespace ridgeway::python
