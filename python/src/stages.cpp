// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The stages between distances and graph, one by one.
#include <algorithm>

#include "config.hpp"
#include "faces.hpp"
#include "long_call.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/compute_skeleton.hpp"
#include "voxel_arrays.hpp"

namespace ridgeway::python {
namespace {

/// A stage from a field to a set of its voxels.
template <typename Stage>
MaskFace mask_by(const std::shared_ptr<const EsdfMap>& esdf, const Stage& stage) {
  return {esdf, run_stage([&] { return std::make_shared<const VoxelMask>(stage()); })};
}

/// And to a graph.
template <typename Stage>
GraphFace graph_by(const std::shared_ptr<const EsdfMap>& esdf, const Stage& stage) {
  return {esdf, run_stage([&] { return std::make_shared<const SparseGraph>(stage()); })};
}

bool is_same_lattice(const EsdfMap& a, const EsdfMap& b) {
  return a.voxel_size == b.voxel_size && a.origin == b.origin;
}

/// Whether what was made of one field holds for another.
bool are_alike(const EsdfMap& a, const EsdfMap& b) {
  const Unlocked unlocked;
  const auto has_same_states = [&] {
    for (std::uint32_t slot = 0; slot < a.layout.block_count(); ++slot)
      if (!std::equal(a.state.block(slot), a.state.block(slot) + kBlockVoxels, b.state.block(slot)))
        return false;
    return true;
  };
  return is_same_lattice(a, b) && a.layout == b.layout && a.unknown == b.unknown &&
         a.limits == b.limits && a.obstacle == b.obstacle && has_same_states();
}

void require_same_map(const EsdfFace& esdf, const std::shared_ptr<const EsdfMap>& other,
                      const char* name) {
  if (esdf.esdf.get() != other.get() && !are_alike(*esdf.esdf, *other))
    throw InputError(name, "is of another map than esdf", "give one that was made of this field");
}

/// Of the lattice, in an order that follows from the set alone, not from how a map's blocks lie.
std::vector<VoxelIndex> sorted_voxels(const MaskFace& face) {
  std::vector<VoxelIndex> voxels;
  for (const VoxelId id : face.mask->members(face.esdf->layout))
    voxels.push_back(face.esdf->layout.index_of(id) + face.esdf->origin);
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

bool is_same_set(const MaskFace& a, const MaskFace& b) {
  const Unlocked unlocked;
  return a.esdf->voxel_size == b.esdf->voxel_size && a.mask->count() == b.mask->count() &&
         sorted_voxels(a) == sorted_voxels(b);
}

py::array voxels_of(const MaskFace& face) {
  std::vector<std::int32_t> numbers;
  {
    const Unlocked unlocked;
    const EsdfMap& esdf = *face.esdf;
    numbers.reserve(3 * face.mask->count());
    for (const VoxelId id : face.mask->members(esdf.layout)) {
      const VoxelIndex v = esdf.layout.index_of(id) + esdf.origin;
      numbers.insert(numbers.end(), {v.x, v.y, v.z});
    }
  }
  const auto count = static_cast<py::ssize_t>(numbers.size() / 3);
  return owning_array(std::move(numbers), {count, 3});
}

py::array points_of(const MaskFace& face) {
  std::vector<Point> points;
  {
    const Unlocked unlocked;
    for (const VoxelId id : face.mask->members(face.esdf->layout))
      points.push_back(
          to_world(*face.esdf, centre_of(face.esdf->layout.index_of(id), face.esdf->voxel_size)));
  }
  return array_of(std::move(points));
}

py::array distances_of(const MaskFace& face) {
  std::vector<double> distances;
  {
    const Unlocked unlocked;
    for (const VoxelId id : face.mask->members(face.esdf->layout))
      distances.push_back(face.esdf->distance(id));
  }
  const auto count = static_cast<py::ssize_t>(distances.size());
  return owning_array(std::move(distances), {count});
}

/// The box of blocks around all of a map's.
VoxelRange range_of(const EsdfMap& esdf) {
  VoxelRange range = {{0, 0, 0}, {-1, -1, -1}};
  bool first = true;
  for (const BlockIndex& block : esdf.layout.blocks()) {
    const VoxelIndex low = voxel_of(block, 0), high = voxel_of(block, kBlockVoxels - 1);
    if (first) range = {low, high};
    first = false;
    range.min = {std::min(range.min.x, low.x), std::min(range.min.y, low.y),
                 std::min(range.min.z, low.z)};
    range.max = {std::max(range.max.x, high.x), std::max(range.max.y, high.y),
                 std::max(range.max.z, high.z)};
  }
  return range.empty() ? range : moved(range, esdf.origin);
}

py::object dense_mask(const MaskFace& face, py::handle bounds) {
  const EsdfMap& esdf = *face.esdf;
  py::object grid = dense<std::uint8_t>(
      esdf, dense_range(bounds, range_of(esdf), esdf.voxel_size),
      [&](VoxelId id) -> std::uint8_t { return id != kNoVoxel && face.mask->test(id) ? 1 : 0; });
  return grid.attr("_replace")(py::arg("values") = grid.attr("values").attr("view")("bool"));
}

void add_mask(py::module_& module) {
  py::class_<MaskFace>(module, "VoxelMask", "A set of voxels of a map.")
      .def("__len__", [](const MaskFace& face) { return face.mask->count(); })
      .def_property_readonly("voxels", &voxels_of,
                             "(N, 3) int32, of the lattice: the centre of v is (v + 0.5) * "
                             "voxel_size.")
      .def_property_readonly("points", &points_of, "Their centres, (N, 3), metres, world.")
      .def_property_readonly("distances", &distances_of,
                             "Their distances to the nearest obstacle, (N,), metres.")
      .def("to_numpy", &dense_mask, py::arg("bounds") = py::none(),
           "to_numpy(self, bounds=None)\n--\n\nAs a Grid of bool, (nx, ny, nz).")
      .def("__eq__", &is_same_set, py::is_operator())
      .def("__repr__", [](const MaskFace& face) {
        return "VoxelMask(" + std::to_string(face.mask->count()) +
               " voxels, voxel_size=" + literal(face.esdf->voxel_size) + ")";
      });
}

void add_graph_stages(py::module_& module) {
  module.def(
      "build_graph",
      [](const EsdfFace& esdf, const MaskFace& diagram, const py::kwargs& keywords) {
        require_same_map(esdf, diagram.esdf, "diagram");
        const GraphConfig config = graph_fields().read_all(keywords);
        return graph_by(esdf.esdf, [&] { return build_graph(*esdf.esdf, *diagram.mask, config); });
      },
      py::arg("esdf"), py::arg("diagram"),
      ("build_graph(esdf, diagram, *, " + graph_fields().signature().substr(2) +
       ")\n--\n\nFits a SparseGraph to a diagram: every edge is free along all of it.\n" +
       graph_fields().docs())
          .c_str());
  module.def(
      "simplify_graph",
      [](const EsdfFace& esdf, const GraphFace& graph, const py::kwargs& keywords) {
        require_same_map(esdf, graph.esdf, "graph");
        const SimplifyConfig config = simplify_fields().read_all(keywords);
        return graph_by(esdf.esdf,
                        [&] { return simplify_graph(*esdf.esdf, *graph.graph, config); });
      },
      py::arg("esdf"), py::arg("graph"),
      ("simplify_graph(esdf, graph, *, " + simplify_fields().signature().substr(2) +
       ")\n--\n\nLeaves out what noise and voxels put into a graph; ways around obstacles stay.\n" +
       simplify_fields().docs())
          .c_str());
}

}  // namespace

void add_stages(py::module_& module) {
  add_mask(module);
  module.def(
      "traversable_voxels",
      [](const EsdfFace& face, py::handle radius) {
        const double r = number_from(radius, "radius");
        if (!(r > 0.0 && std::isfinite(r)))
          throw InputError("radius", "is " + literal(r), "give a length above 0, metres");
        return mask_by(face.esdf, [&] { return traversable_voxels(*face.esdf, r); });
      },
      py::arg("esdf"), py::arg("radius"),
      "traversable_voxels(esdf, radius)\n--\n\n"
      "The free voxels at least `radius` metres from every obstacle, a VoxelMask.");
  module.def(
      "compute_gvd",
      [](const EsdfFace& face, const MaskFace& traversable, const py::kwargs& keywords) {
        require_same_map(face, traversable.esdf, "traversable");
        const GvdConfig config = gvd_fields().read_all(keywords);
        return mask_by(face.esdf,
                       [&] { return compute_gvd(*face.esdf, *traversable.mask, config); });
      },
      py::arg("esdf"), py::arg("traversable"),
      ("compute_gvd(esdf, traversable, *, " + gvd_fields().signature().substr(2) +
       ")\n--\n\nVoxels on the generalized Voronoi diagram, a VoxelMask.\n" + gvd_fields().docs())
          .c_str());
  module.def(
      "extract_edges",
      [](const EsdfFace& face, const MaskFace& gvd) {
        require_same_map(face, gvd.esdf, "gvd");
        return mask_by(face.esdf, [&] { return extract_edges(*face.esdf, *gvd.mask); });
      },
      py::arg("esdf"), py::arg("gvd"),
      "extract_edges(esdf, gvd)\n--\n\nThe thick edges of a diagram, where its faces meet.");
  module.def(
      "thin",
      [](const MaskFace& voxels) {
        return mask_by(voxels.esdf, [&] {
          VoxelMask thinned = *voxels.mask;
          thin(voxels.esdf->layout, thinned);
          return thinned;
        });
      },
      py::arg("voxels"),
      "thin(voxels)\n--\n\nThins a set to curves one voxel wide; its topology stays.");
  module.def(
      "compute_skeleton",
      [](const EsdfFace& face, py::handle min_clearance, const py::kwargs& keywords) {
        const GvdConfig config = gvd_fields().read_all(keywords);
        const double clearance = number_from(min_clearance, "min_clearance");
        return mask_by(face.esdf, [&] { return compute_skeleton(*face.esdf, clearance, config); });
      },
      py::arg("esdf"), py::arg("min_clearance") = 0.4,
      ("compute_skeleton(esdf, min_clearance=0.4, *, " + gvd_fields().signature().substr(2) +
       ")\n--\n\nThe whole way from distances to the diagram that a graph is fitted to.\n" +
       gvd_fields().docs())
          .c_str());
  add_graph_stages(module);
}

}  // namespace ridgeway::python
