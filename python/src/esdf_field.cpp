// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Distance fields: distances, gradients, and what is free.
#include <limits>

#include "common/number_text.hpp"
#include "config.hpp"
#include "faces.hpp"
#include "long_call.hpp"
#include "plans.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/distance_field.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/esdf/surroundings.hpp"
#include "voxel_arrays.hpp"

namespace ridgeway::python {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

VoxelRange known_on_lattice(const EsdfMap& esdf) {
  OccupancyMap map;  // which knows how to find it
  map.voxel_size = esdf.voxel_size;
  map.origin = esdf.origin;
  map.layout = esdf.layout;
  map.state = esdf.state.shared();
  const VoxelRange known = known_range(map);
  return known.empty() ? known : moved(known, map.origin);
}

py::object field_distances(const EsdfFace& face, py::handle bounds) {
  const EsdfMap& esdf = *face.esdf;
  const float outside =
      esdf.unknown == UnknownPolicy::kObstacle ? 0.0f : std::numeric_limits<float>::quiet_NaN();
  return dense<float>(
      esdf, dense_range(bounds, known_on_lattice(esdf), esdf.voxel_size), [&](VoxelId id) {
        return id == kNoVoxel ? outside
               : esdf.is_obstacle(id)
                   ? 0.0f
                   : static_cast<float>(std::min(esdf.distance(id), esdf.max_distance));
      });
}

py::object states(const EsdfFace& face, py::handle bounds) {
  const EsdfMap& esdf = *face.esdf;
  return dense<std::uint8_t>(
      esdf, dense_range(bounds, known_on_lattice(esdf), esdf.voxel_size), [&](VoxelId id) {
        return id == kNoVoxel ? std::uint8_t{0} : static_cast<std::uint8_t>(esdf.state[id]);
      });
}

py::tuple distance_at(const EsdfFace& face, py::handle points, py::handle deepest) {
  const OneOrMany asked = one_or_many_from(points, "points");
  const std::vector<Point>& places = asked.points;
  const double depth = number_from(deepest, "deepest");
  if (!(depth >= 0.0))
    throw InputError("deepest", "is " + number_text(depth), "give metres, 0 or more");
  std::vector<double> distance(places.size(), kNaN);
  std::vector<Point> gradient(places.size(), Point::Constant(kNaN));
  {
    const Unlocked unlocked;
    parallel_for_each_index(
        places.size(),
        [&](std::size_t i) {
          if (!has_voxel(places[i], face.esdf->voxel_size)) return;
          const auto found = ridgeway::distance_at(*face.esdf, places[i], depth);
          if (!found) return;
          distance[i] = found->distance;
          gradient[i] = found->gradient;
        },
        256);
  }
  const auto count = static_cast<py::ssize_t>(places.size());
  py::array distances = owning_array(std::move(distance), {count});
  py::array gradients = array_of(std::move(gradient));
  if (asked.is_one) return py::make_tuple(distances[py::int_(0)], gradients[py::int_(0)]);
  return py::make_tuple(distances, gradients);
}

/// Of each point, in the map's frame; places beyond all voxels get `outside`.
template <typename Value, typename Ask>
py::array ask_each(const EsdfFace& face, const std::vector<Point>& places, Value outside,
                   const Ask& ask) {
  std::vector<Value> answers(places.size(), outside);
  {
    const Unlocked unlocked;
    const FreeSpace space(*face.esdf);
    parallel_for_each_index(
        places.size(),
        [&](std::size_t i) {
          const Point local = flight_place(*face.esdf, places[i]);
          if (has_voxel(local, face.esdf->voxel_size)) answers[i] = ask(space, local);
        },
        64);
  }
  const auto count = static_cast<py::ssize_t>(places.size());
  return owning_array(std::move(answers), {count});
}

double radius_from(py::handle value) {
  const double radius = number_from(value, "radius");
  if (!(radius > 0.0 && std::isfinite(radius)))
    throw InputError("radius", "is " + literal(radius), "give a length above 0, metres");
  return radius;
}

py::object is_free(const EsdfFace& face, py::handle points, py::handle radius) {
  const double r = radius_from(radius);
  const OneOrMany asked = one_or_many_from(points, "points");
  const py::array answers = ask_each<std::uint8_t>(
      face, asked.points, 0, [&](const FreeSpace& space, const Point& p) -> std::uint8_t {
        return space.is_free(p, r) ? 1 : 0;
      });
  const py::object free = answers.attr("view")("bool");
  return asked.is_one ? py::object(free[py::int_(0)]) : free;
}

double clearance(const EsdfFace& face, py::handle path) {
  std::vector<Point> local = path_points_from(path, "path");
  if (local.empty()) throw InputError("path", "has no points", "give one or more");
  for (Point& p : local) {
    p = flight_place(*face.esdf, p);
    if (!has_voxel(p, face.esdf->voxel_size)) return 0.0;
  }
  const Unlocked unlocked;
  return FreeSpace(*face.esdf).clearance(local);
}

py::dict surroundings(const EsdfFace& face, py::handle path, py::handle radius) {
  const std::vector<Point> points = path_points_from(path, "path");
  if (points.empty()) throw InputError("path", "has no points", "give one or more");
  const double r = radius_from(radius);
  const PathSurroundings found =
      run_stage([&] { return Surroundings(*face.esdf).along(points, r); });
  py::dict dict;
  dict["known"] = found.known;
  dict["unknown"] = found.unknown;
  dict["unknown_share"] = found.unknown_share;
  dict["unknown_inside"] = found.unknown_inside;
  return dict;
}

bool path_is_free(const EsdfFace& face, py::handle path, py::handle radius) {
  std::vector<Point> local = path_points_from(path, "path");
  if (local.empty()) throw InputError("path", "has no points", "give one or more");
  const double r = radius_from(radius);
  for (Point& p : local) {
    p = flight_place(*face.esdf, p);
    if (!has_voxel(p, face.esdf->voxel_size)) return false;
  }
  const Unlocked unlocked;
  const FreeSpace space(*face.esdf);
  if (local.size() == 1) return space.is_free(local.front(), r);
  for (std::size_t i = 1; i < local.size(); ++i)
    if (!space.is_free(local[i - 1], local[i], r)) return false;
  return true;
}

std::string field_repr(const EsdfFace& face) {
  const EsdfMap& esdf = *face.esdf;
  return "EsdfMap(voxel_size=" + literal(esdf.voxel_size) +
         ", blocks=" + std::to_string(esdf.layout.block_count()) + ", unknown='" +
         std::string(name_of(esdf.unknown)) +
         "', max_distance=" + (std::isinf(esdf.max_distance) ? "inf" : literal(esdf.max_distance)) +
         ")";
}

FlightLimits make_limits(py::handle keep_in, py::handle keep_out) {
  FlightLimits limits;
  if (!keep_in.is_none()) limits.keep_in = box_from(keep_in, "keep_in");
  read(keep_out, "keep_out", limits.keep_out);
  limits.validate();
  return limits;
}

py::list boxes_of(const FlightLimits& limits) {
  py::list boxes;
  for (const Box& box : limits.keep_out) boxes.append(tuple_of(box));
  return boxes;
}

void add_limits(py::module_& module) {
  py::class_<FlightLimits>(
      module, "FlightLimits",
      "FlightLimits(keep_in=None, keep_out=())\n--\n\n"
      "Where the robot's centre may be, boxes ((x0, y0, z0), (x1, y1, z1)), metres, world: in "
      "`keep_in`,\nand in none of `keep_out`. No distance to them is kept.")
      .def(py::init(&make_limits), py::arg("keep_in") = py::none(),
           py::arg("keep_out") = py::make_tuple(),
           "__init__(self, keep_in=None, keep_out=())\n--\n\n")
      .def_property_readonly(
          "keep_in", [](const FlightLimits& limits) { return tuple_of(limits.keep_in); },
          "A box, infinite where nothing limits.")
      .def_property_readonly("keep_out", &boxes_of, "Boxes.")
      .def(
          "__eq__", [](const FlightLimits& a, const FlightLimits& b) { return a == b; },
          py::is_operator())
      .def("__repr__", [](const FlightLimits& limits) {
        return "FlightLimits(keep_in=" + std::string(py::str(tuple_of(limits.keep_in))) +
               ", keep_out=" + std::string(py::str(boxes_of(limits))) + ")";
      });
}

void add_questions(py::class_<EsdfFace>& type) {
  type.def("distances", &field_distances, py::arg("bounds") = py::none(),
           "distances(self, bounds=None)\n--\n\n"
           "Distances at voxel centres as a Grid of float32, (nx, ny, nz), metres: 0 in obstacles, "
           "inf where none is\nnear; outside of the map 0, or NaN where unknown space is no "
           "obstacle. For looking at and for costs:\n`is_free` decides what is safe.")
      .def("states", &states, py::arg("bounds") = py::none(),
           "states(self, bounds=None)\n--\n\nStates as a Grid of uint8, (nx, ny, nz).")
      .def("distance_at", &distance_at, py::arg("points"), py::arg("deepest") = 1.0,
           "distance_at(self, points, deepest=1.0)\n--\n\n"
           "Interpolated signed distances (N,), metres, and their gradients (N, 3), at points "
           "(N, 3), world, or at one;\nNaN where nothing was seen. Negative in obstacles, down to "
           "-deepest.")
      .def("is_free", &is_free, py::arg("points"), py::arg("radius"),
           "is_free(self, points, radius)\n--\n\n"
           "Whether a sphere (radius in metres) fits at points (N, 3), world: (N,) bool, exact; of "
           "one point one bool.")
      .def("path_is_free", &path_is_free, py::arg("path"), py::arg("radius"),
           "path_is_free(self, path, radius)\n--\n\n"
           "Whether a sphere (radius in metres) can move along straight segments (N, 3), world, or "
           "a PlanResult: "
           "exact.")
      .def("clearance", &clearance, py::arg("path"),
           "clearance(self, path)\n--\n\n"
           "Smallest distance to an obstacle along straight segments (N, 3), or a PlanResult, "
           "metres, exact.")
      .def("surroundings", &surroundings, py::arg("path"), py::arg("radius"),
           "surroundings(self, path, radius)\n--\n\n"
           "What straight segments (N, 3), or a PlanResult, run beside, whatever unknown space was "
           "taken for: a dict "
           "of the smallest\ndistances to what is known to be occupied and to something unknown, "
           "metres, and of "
           "the shares of the length that are\nnearer to the unknown than the radius "
           "(unknown_share) and, where unknown space\nis taken for free, in it (unknown_inside; "
           "else "
           "0).");
}

void add_facts(py::class_<EsdfFace>& type) {
  type.def("__repr__", &field_repr)
      .def_property_readonly(
          "voxel_size", [](const EsdfFace& face) { return face.esdf->voxel_size; }, "Metres.")
      .def_property_readonly(
          "unknown", [](const EsdfFace& face) { return std::string(name_of(face.esdf->unknown)); },
          "'obstacle', 'ignore' or 'free'.")
      .def_property_readonly(
          "max_distance", [](const EsdfFace& face) { return face.esdf->max_distance; },
          "Metres; distances stop here.");
}

void add_blocks(py::class_<EsdfFace>& type) {
  type.def_property_readonly(
          "block_corners", [](const EsdfFace& face) { return block_corners(*face.esdf); },
          "Low corners of the blocks, (B, 3), metres, world.")
      .def_property_readonly(
          "block_states",
          [](const py::object& self) {
            return blocks_view<std::uint8_t>(self.cast<const EsdfFace&>().esdf->state, self);
          },
          "(B, 8, 8, 8) uint8 [block, x, y, z], read-only; the map's memory where it is in one "
          "piece.")
      .def_property_readonly(
          "block_squared",
          [](const py::object& self) {
            return blocks_view<std::uint32_t>(self.cast<const EsdfFace&>().esdf->squared, self);
          },
          "(B, 8, 8, 8) uint32: squared distances in half voxels, exact; 2^32 - 1: none is near. "
          "Read-only;\nthe map's memory where it is in one piece.")
      .def_property_readonly(
          "block_sites",
          [](const EsdfFace& self) { return blocks_copy<std::int16_t>(self.esdf->site.values()); },
          "(B, 8, 8, 8, 3) int16: from each voxel to the nearest obstacle, voxels; a copy.")
      .def(
          "block",
          [](const py::object& self, py::ssize_t slot) {
            return block_view<std::uint32_t>(self.cast<const EsdfFace&>().esdf->squared, slot,
                                             self);
          },
          py::arg("slot"),
          "block(self, slot)\n--\n\n"
          "One block of `block_squared`, (8, 8, 8) uint32: the map's memory, always.");
}

void add_compute_esdf(py::module_& module) {
  const std::string doc =
      "compute_esdf(map" + esdf_fields().signature().replace(0, 2, ", *, threads=0, ") +
      ")\n--\n\nThe distance field of an OccupancyMap.\n" + esdf_fields().docs();
  module.def(
      "compute_esdf",
      [](const MapFace& face, const py::object& threads, const py::kwargs& keywords) {
        int count = 0;
        read(threads, "threads", count);
        const EsdfConfig config = esdf_fields().read_all(keywords);
        return run_stage(
            [&] {
              return EsdfFace{std::make_shared<const EsdfMap>(
                  compute_esdf(taken(*face.map, UnknownPolicy::kObstacle), config))};
            },
            count);
      },
      py::arg("map"), py::kw_only(), py::arg("threads") = 0, doc.c_str());
}

}  // namespace

void add_fields(py::module_& module) {
  add_limits(module);
  py::class_<EsdfFace> type(module, "EsdfMap",
                            "Exact Euclidean distances from voxel centres to the nearest "
                            "obstacle's cube.");
  add_questions(type);
  add_facts(type);
  add_blocks(type);
  add_compute_esdf(module);
}

}  // namespace ridgeway::python
