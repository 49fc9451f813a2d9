// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Fusion of measurements to truncated distance fields.
#include "config.hpp"
#include "faces.hpp"
#include "lock.hpp"
#include "maps.hpp"
#include "ridgeway/formats/graph_export.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "sensors.hpp"
#include "voxel_arrays.hpp"

namespace ridgeway::python {
namespace {

/// One thread at a time, whoever calls from Python.
class FusionFace {
 public:
  explicit FusionFace(const FusionConfig& config) : fusion_(config) {}

  void integrate_depth(py::handle image, const PinholeCamera& camera, py::handle pose) {
    const DepthImage depth = image_from(image, "image");
    const Eigen::Isometry3d T_world_camera = pose_from(pose, "T_world_camera");
    const Unlocked unlocked;
    const std::scoped_lock lock(mutex_);
    fusion_.integrate(depth, camera, T_world_camera);
    ++frames_;
  }

  void integrate_points(py::handle points, py::handle pose) {
    const std::vector<Point> cloud = cloud_from(points);
    const Eigen::Isometry3d T_world_sensor = pose_from(pose, "T_world_sensor");
    const Unlocked unlocked;
    const std::scoped_lock lock(mutex_);
    fusion_.integrate(cloud, T_world_sensor);
    ++frames_;
  }

  TsdfFace map() {
    const Unlocked unlocked;
    const std::scoped_lock lock(mutex_);
    return {std::make_shared<const TsdfMap>(fusion_.map())};
  }

  std::size_t frames() const { return frames_; }

 private:
  std::mutex mutex_;
  TsdfFusion fusion_;
  std::size_t frames_ = 0;
};

py::object surface(const TsdfFace& face) {
  SurfaceMesh mesh;
  {
    const Unlocked unlocked;
    mesh = surface_of(*face.tsdf);
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  const auto count = static_cast<py::ssize_t>(mesh.triangles.size());
  return py::module_::import("ridgeway._values")
      .attr("Surface")(array_of(std::move(mesh.vertices)), array_of(std::move(mesh.normals)),
                       owning_array(std::move(corners), {count, 3}));
}

void add_tsdf(py::module_& module) {
  py::class_<TsdfFace>(module, "TsdfMap",
                       "Truncated signed distances to measured surfaces, negative behind them.")
      .def_property_readonly(
          "voxel_size", [](const TsdfFace& face) { return face.tsdf->voxel_size; }, "Metres.")
      .def_property_readonly(
          "truncation", [](const TsdfFace& face) { return face.tsdf->truncation; },
          "Metres; distances are known no farther than this.")
      .def_property_readonly(
          "block_corners", [](const TsdfFace& face) { return block_corners(*face.tsdf); },
          "Low corners of the blocks, (B, 3), metres, world.")
      .def_property_readonly(
          "block_distances",
          [](const py::object& self) {
            return blocks_view<float>(self.cast<const TsdfFace&>().tsdf->distance, self);
          },
          "(B, 8, 8, 8) float32 [block, x, y, z], metres; of no meaning where the weight is 0.")
      .def_property_readonly(
          "block_weights",
          [](const py::object& self) {
            return blocks_view<float>(self.cast<const TsdfFace&>().tsdf->weight, self);
          },
          "(B, 8, 8, 8) float32: how well each is known; 0: never seen.")
      .def(
          "occupancy",
          [](const TsdfFace& face) {
            const Unlocked unlocked;
            return face_of(occupancy_of(*face.tsdf));
          },
          "occupancy(self)\n--\n\n"
          "The OccupancyMap: occupied behind surfaces, free before them, unknown where never seen.")
      .def("surface", &surface, "surface(self)\n--\n\nThe zero level as triangles, a Surface.")
      .def(
          "save_surface",
          [](const TsdfFace& face, py::handle path) {
            const std::filesystem::path file = path_from(path, "path", ".ply");
            const Unlocked unlocked;
            write_mesh_ply(surface_of(*face.tsdf), file);
          },
          py::arg("path"), "save_surface(self, path)\n--\n\nWrites that surface as a .ply mesh.")
      .def(
          "export_voxblox",
          [](const TsdfFace& face, py::handle path) {
            const std::filesystem::path file = path_from(path, "path", ".vxblx");
            const Unlocked unlocked;
            write_voxblox(*face.tsdf, file);
          },
          py::arg("path"),
          "export_voxblox(self, path)\n--\n\nWrites it as a TSDF layer of voxblox, .vxblx.")
      .def(
          "save",
          [](const TsdfFace& face, py::handle path, py::handle source) {
            const std::filesystem::path file = path_from(path, "path");
            const std::string text = text_from(source, "source");
            const Unlocked unlocked;
            save_tsdf(*face.tsdf, text, file);
          },
          py::arg("path"), py::arg("source") = "",
          "save(self, path, source='')\n--\n\nWrites a .ridge file that build and load_map read.")
      .def("__repr__", [](const TsdfFace& face) {
        return "TsdfMap(voxel_size=" + literal(face.tsdf->voxel_size) +
               ", blocks=" + std::to_string(face.tsdf->layout.block_count()) + ")";
      });
  module.def(
      "load_tsdf",
      [](py::handle path) {
        const std::filesystem::path file = path_from(path, "path");
        const Unlocked unlocked;
        return TsdfFace{std::make_shared<const TsdfMap>(load_tsdf(file))};
      },
      py::arg("path"), "load_tsdf(path)\n--\n\nThe TsdfMap of a .ridge file.");
}

}  // namespace

std::vector<Point> cloud_from(py::handle value) {
  const std::string expected = "an (N, 3) array of numbers, metres";
  const Doubles array = doubles_from(value, "points", expected);
  const bool none = array.size() == 0 && array.ndim() <= 2;
  if (!none && (array.ndim() != 2 || array.shape(1) != 3))
    throw InputError("points", "is " + describe(value), "give " + expected);
  std::vector<Point> points(static_cast<std::size_t>(none ? 0 : array.shape(0)));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Eigen::Map<const Point>(array.data() + 3 * i);
  return points;  // fusion passes over those that are not finite
}

void add_fusion(py::module_& module) {
  add_sensors(module);
  add_tsdf(module);
  const std::string signature = fusion_fields().signature().substr(2);
  py::class_<FusionFace>(
      module, "TsdfFusion",
      ("TsdfFusion(*, " + signature +
       ")\n--\n\nFuses depth images and point clouds with known poses.\n" + fusion_fields().docs())
          .c_str())
      .def(py::init([](const py::kwargs& keywords) {
             return std::make_unique<FusionFace>(fusion_fields().read_all(keywords));
           }),
           ("__init__(self, *, " + signature + ")\n--\n\n").c_str())
      .def("integrate_depth", method(&FusionFace::integrate_depth), py::arg("image"),
           py::arg("camera"), py::arg("T_world_camera"),
           "integrate_depth(self, image, camera, T_world_camera)\n--\n\n"
           "Depths along the optical axis (H, W), metres, 0 or NaN where nothing was measured; a "
           "PinholeCamera;\nits pose (4, 4). Where it throws, the map is as before.")
      .def("integrate_points", method(&FusionFace::integrate_points), py::arg("points"),
           py::arg("T_world_sensor"),
           "integrate_points(self, points, T_world_sensor)\n--\n\n"
           "Points (N, 3) in the sensor's frame, metres, and its pose (4, 4). Those not finite are "
           "passed over.")
      .def("map", method(&FusionFace::map),
           "map(self)\n--\n\nAll that was fused so far, a TsdfMap.")
      .def("__len__", method(&FusionFace::frames))
      .def("__repr__", [](const FusionFace& face) {
        return "TsdfFusion(" + std::to_string(face.frames()) + " measurements)";
      });
}

}  // namespace ridgeway::python
