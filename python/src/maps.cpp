// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Occupancy maps: from arrays, clouds and files, changed, and back to arrays.
#include "maps.hpp"

#include "config.hpp"
#include "faces.hpp"
#include "long_call.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "state_array.hpp"
#include "voxel_arrays.hpp"

namespace ridgeway::python {
namespace {

/// A UserWarning for each of what a person should be told.
void warn_of(const LoadNotes& notes, const std::string& name) {
  for (const std::string& note : notes.notes)
    py::module_::import("warnings")
        .attr("warn")(text_to_python(std::string(name).append(": ").append(note)),
                      py::handle(PyExc_UserWarning), 1);
}

/// Zeros and ones are often meant as free and occupied.
void warn_if_nothing_is_occupied(const OccupancyMap& map, const py::array& states) {
  const char kind = states.dtype().kind();
  if (kind != 'i' && kind != 'u') return;
  const VoxelCounts counts = count_voxels(map);
  const bool has_zeros = counts.free < static_cast<std::size_t>(states.size());
  if (counts.occupied > 0 || counts.free == 0 || !has_zeros) return;
  LoadNotes notes;
  notes.notes.emplace_back(
      "holds zeros and ones: whole numbers are 0 unknown, 1 free, 2 occupied, so no voxel is "
      "occupied; where 1 is to be occupied and 0 free give states.astype(bool)");
  warn_of(notes, "states");
}

MapFace from_numpy(py::handle states, py::handle voxel_size, py::handle origin,
                   py::handle free_below, py::handle occupied_above) {
  OccupancyMap map = map_of_array(
      states, number_from(voxel_size, "voxel_size"), point_from(origin, "origin"),
      {number_from(free_below, "free_below"), number_from(occupied_above, "occupied_above")});
  warn_if_nothing_is_occupied(map, py::reinterpret_borrow<py::array>(states));
  return face_of(std::move(map));
}

MapFace from_points(py::handle points, py::handle voxel_size, py::handle bounds,
                    py::handle transform) {
  const Doubles array = doubles_from(points, "points", "an (N, 3) array of numbers, metres");
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InputError("points", "is " + describe(points), "give an (N, 3) array of numbers, metres");
  PointCloud cloud;
  CloudMapConfig config;
  config.voxel_size = number_from(voxel_size, "voxel_size");
  validate_voxel_size(config.voxel_size, "voxel_size");
  config.bounds = box_from(bounds, "bounds");
  read(transform, "transform", config.T_map_cloud);
  LoadNotes notes;
  MapFace face = run_stage([&] {
    cloud.points.reserve(static_cast<std::size_t>(array.shape(0)));
    for (py::ssize_t i = 0; i < array.shape(0); ++i) {
      const double* p = array.data() + 3 * i;
      cloud.add(p[0], p[1], p[2]);
    }
    return face_of(map_from_points(cloud, config, "points", &notes));
  });
  warn_of(notes, "points");
  return face;
}

py::object bounds_of(const MapFace& face) {
  const std::optional<Box> box = known_bounds(*face.map);
  return box ? tuple_of(*box) : py::none();
}

VoxelRange known_on_lattice(const OccupancyMap& map) {
  const VoxelRange known = known_range(map);
  return known.empty() ? known : moved(known, map.origin);
}

py::object to_numpy(const MapFace& face, py::handle bounds) {
  const OccupancyMap& map = *face.map;
  return dense<std::uint8_t>(
      map, dense_range(bounds, known_on_lattice(map), map.voxel_size), [&](VoxelId id) {
        return id == kNoVoxel ? std::uint8_t{0} : static_cast<std::uint8_t>(map.state[id]);
      });
}

py::object state_at(const MapFace& face, py::handle points) {
  const OccupancyMap& map = *face.map;
  const OneOrMany asked = one_or_many_from(points, "points");
  std::vector<std::uint8_t> states;
  {
    const Unlocked unlocked;
    for (const Point& place : asked.points) {
      const Point local = to_local(map, place);
      states.push_back(has_voxel(local, map.voxel_size)
                           ? static_cast<std::uint8_t>(map.at(voxel_at(local, map.voxel_size)))
                           : std::uint8_t{0});
    }
  }
  const auto count = static_cast<py::ssize_t>(states.size());
  py::array all = owning_array(std::move(states), {count});
  return asked.is_one ? py::object(all[py::int_(0)]) : std::move(all);
}

py::dict counts_of(const MapFace& face) {
  const VoxelCounts counts = count_voxels(*face.map);
  py::dict dict;
  dict["free"] = counts.free;
  dict["occupied"] = counts.occupied;
  dict["unknown"] = counts.unknown;
  return dict;
}

/// Without what sums of voxels leave in the last digits.
std::string bounds_text(const OccupancyMap& map) {
  const std::optional<Box> box = known_bounds(map);
  if (!box) return "None";
  const auto rounded = [](const Point& p) -> Point {
    return (1e6 * p).array().round() / 1e6 + 0.0;
  };
  return "(" + literal(rounded(box->min)) + ", " + literal(rounded(box->max)) + ")";
}

py::str map_repr(const MapFace& face) {
  const VoxelCounts counts = count_voxels(*face.map);
  return text_to_python("OccupancyMap(voxel_size=" + literal(face.map->voxel_size) +
                        ", free=" + std::to_string(counts.free) + ", occupied=" +
                        std::to_string(counts.occupied) + ", bounds=" + bounds_text(*face.map) +
                        (face.source.empty() ? "" : ", source='" + face.source + "'") + ")");
}

/// A map made of another one.
template <typename Edit>
MapFace edited(const MapFace& face, const Edit& edit) {
  return {run_stage([&] { return std::make_shared<const OccupancyMap>(edit(*face.map)); }),
          face.source};
}

void add_edits(py::class_<MapFace>& type) {
  type.def(
      "resampled",
      [](const MapFace& face, py::handle voxel_size) {
        const double size = number_from(voxel_size, "voxel_size");
        return edited(face, [&](const OccupancyMap& map) { return resample(map, size); });
      },
      py::arg("voxel_size"),
      "resampled(self, voxel_size)\n--\n\n"
      "The same space at a coarser voxel size (metres), without ever losing an obstacle.");
  type.def(
      "cropped",
      [](const MapFace& face, py::handle bounds) {
        const Box box = box_from(bounds, "bounds");
        return edited(face, [&](const OccupancyMap& map) { return crop(map, box); });
      },
      py::arg("bounds"),
      "cropped(self, bounds)\n--\n\n"
      "What lies inside ((x0, y0, z0), (x1, y1, z1)), metres; all else becomes unknown.");
  type.def(
      "with_no_fly",
      [](const MapFace& face, py::handle boxes) {
        std::vector<Box> all;
        read(boxes, "boxes", all);
        return edited(face, [&](const OccupancyMap& map) { return add_no_fly(map, all); });
      },
      py::arg("boxes"),
      "with_no_fly(self, boxes)\n--\n\n"
      "With every voxel that shares volume with one of the boxes occupied.");
  type.def(
      "without_isolated",
      [](const MapFace& face, py::handle min_cluster) {
        int least = 0;
        read(min_cluster, "min_cluster", least);
        return edited(face, [&](const OccupancyMap& map) { return remove_isolated(map, least); });
      },
      py::arg("min_cluster"),
      "without_isolated(self, min_cluster)\n--\n\n"
      "With clusters of fewer occupied voxels free: for noise. Removes small real obstacles too.");
  type.def(
      "without_pockets",
      [](const MapFace& face, py::handle min_volume) {
        const double least = number_from(min_volume, "min_volume");
        return edited(face, [&](const OccupancyMap& map) { return remove_pockets(map, least); });
      },
      py::arg("min_volume"),
      "without_pockets(self, min_volume)\n--\n\n"
      "With clusters of free voxels of fewer cubic metres unknown: for what stray measurements "
      "open behind walls.");
  type.def(
      "flattened",
      [](const MapFace& face, py::handle low, py::handle high) {
        const double from = number_from(low, "low"), to = number_from(high, "high");
        return edited(face, [&](const OccupancyMap& map) { return flatten(map, from, to); });
      },
      py::arg("low"), py::arg("high"),
      "flattened(self, low, high)\n--\n\n"
      "The map of a robot that stays in a plane: one layer of what is between the heights, "
      "metres.");
  type.def(
      "transformed",
      [](const MapFace& face, py::handle transform, py::handle voxel_size) {
        const Eigen::Isometry3d motion = pose_from(transform, "transform");
        const double size =
            voxel_size.is_none() ? face.map->voxel_size : number_from(voxel_size, "voxel_size");
        return edited(face,
                      [&](const OccupancyMap& map) { return transform_map(map, motion, size); });
      },
      py::arg("transform"), py::arg("voxel_size") = py::none(),
      "transformed(self, transform, voxel_size=None)\n--\n\n"
      "Moved by a (4, 4) matrix. No obstacle is lost: they and the unknown grow by up to a voxel's "
      "diagonal.");
}

}  // namespace

MapFace face_of(OccupancyMap map, std::string source) {
  return {std::make_shared<const OccupancyMap>(std::move(map)), std::move(source)};
}

MapFace load_face(const std::filesystem::path& path, const LoadConfig& config) {
  LoadNotes notes;
  MapFace face =
      run_stage([&] { return face_of(load_map(path, config, &notes), path.filename().string()); });
  warn_of(notes, path.string());
  return face;
}

void add_maps(py::module_& module) {
  py::class_<MapFace> type(module, "OccupancyMap",
                           "What is known of each voxel: free, occupied or unknown. Never changes: "
                           "what edits it gives another map.");
  type.def_static(
      "from_numpy", &from_numpy, py::arg("states"), py::arg("voxel_size"),
      py::arg("origin") = py::make_tuple(0.0, 0.0, 0.0), py::arg("free_below") = 0.5,
      py::arg("occupied_above") = 0.5,
      "from_numpy(states, voxel_size, origin=(0.0, 0.0, 0.0), free_below=0.5, "
      "occupied_above=0.5)\n--\n\n"
      "The map of an (nx, ny, nz) array [x, y, z], in any memory order. An (nx, ny) array "
      "gives a planar map,\nof a robot that stays in that layer.\n\n"
      "  states: bool (True: occupied, False: free); whole numbers (0 UNKNOWN, 1 FREE, "
      "2 OCCUPIED); or\n"
      "    floats (32 or 64 bits), the probability of being occupied: free below `free_below`, "
      "occupied above\n    `occupied_above`, else unknown\n"
      "  voxel_size: metres\n"
      "  origin: low corner of the voxel [0, 0, 0], metres; a whole number of voxels\n\n"
      "The array is read once, into the map; no other copy is made. Whole numbers of which none is "
      "OCCUPIED, some UNKNOWN\nand some FREE, give a UserWarning: zeros and ones are often meant "
      "as "
      "free and occupied.");
  type.def_static("from_points", &from_points, py::arg("points"), py::arg("voxel_size"),
                  py::arg("bounds"), py::arg("transform") = py::none(),
                  "from_points(points, voxel_size, bounds, transform=None)\n--\n\n"
                  "The map of a cloud, (N, 3), metres: voxels that hold a point are occupied, the "
                  "others wholly inside\n`bounds` free. Points that are not finite, or "
                  "outside of `bounds`, are left out,\nwith a UserWarning. `transform`: (4, 4) "
                  "from cloud to world.");
  type.def("to_numpy", &to_numpy, py::arg("bounds") = py::none(),
           "to_numpy(self, bounds=None)\n--\n\n"
           "States as a Grid of uint8, (nx, ny, nz): of all that is known, or in "
           "((x0, y0, z0), (x1, y1, z1)).\n`from_numpy(*map.to_numpy())` is the map again.");
  type.def("state_at", &state_at, py::arg("points"),
           "state_at(self, points)\n--\n\n"
           "States of the voxels that hold points (N, 3), world: (N,) uint8; of one point one.");
  type.def_property_readonly(
      "voxel_size", [](const MapFace& face) { return face.map->voxel_size; }, "Metres.");
  type.def_property_readonly(
      "source", [](const MapFace& face) { return text_to_python(face.source); },
      "The file's name, or ''.");
  type.def_property_readonly(
      "planar", [](const MapFace& face) { return face.map->planar; },
      "Whether it is of a robot that stays in a plane.");
  type.def_property_readonly("bounds", &bounds_of,
                             "Box around all known voxels, ((x0, y0, z0), (x1, y1, z1)), metres; "
                             "None where none is known.");
  type.def_property_readonly("counts", &counts_of,
                             "Voxels that are free, occupied, and (in allocated blocks) unknown.");
  type.def_property_readonly(
      "block_corners", [](const MapFace& face) { return block_corners(*face.map); },
      "Low corners of the blocks of 8 x 8 x 8 voxels, (B, 3), metres, world.");
  type.def_property_readonly(
      "block_states",
      [](const py::object& self) {
        return blocks_view<std::uint8_t>(self.cast<const MapFace&>().map->state, self);
      },
      "States by block, (B, 8, 8, 8) uint8 [block, x, y, z]: the map's own memory, read-only.");
  type.def("__repr__", &map_repr);
  add_edits(type);

  const std::string doc = "load_map(path" + load_fields().signature().replace(0, 2, ", *, ") +
                          ")\n--\n\nReads a map: OctoMap .bt and .ot; clouds .pcd, .ply, .xyz; "
                          "meshes .dae, .glb, .obj, .stl, .ply;\nworlds and ROS maps .yaml; "
                          "voxblox layers; MovingAI .3dmap; fused .ridge.\n" +
                          load_fields().docs();
  module.def(
      "load_map",
      [](py::handle path, const py::kwargs& keywords) {
        return load_face(path_from(path, "path"), load_fields().read_all(keywords));
      },
      py::arg("path"), doc.c_str());
}

}  // namespace ridgeway::python
