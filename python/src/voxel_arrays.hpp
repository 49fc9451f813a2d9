// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "convert.hpp"
#include "lock.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::python {

/// Whether a field's blocks lie one behind the other.
template <typename Value>
bool is_in_one_piece(const VoxelField<Value>& field) {
  const std::size_t blocks = field.size() / kBlockVoxels;
  for (std::size_t slot = 1; slot < blocks; ++slot)
    if (field.block(static_cast<std::uint32_t>(slot)) !=
        field.block(static_cast<std::uint32_t>(slot - 1)) + kBlockVoxels)
      return false;
  return true;
}

/// One block as (8, 8, 8, ...) numbers [x, y, z], a view of the field's memory. `Number`: what a
/// value consists of, `parts` of them.
template <typename Number, typename Value>
py::array block_view(const VoxelField<Value>& field, py::ssize_t slot, py::handle owner) {
  constexpr py::ssize_t step = sizeof(Value), part = sizeof(Number), parts = step / part;
  const auto blocks = static_cast<py::ssize_t>(field.size() / kBlockVoxels);
  if (slot < 0) slot += blocks;
  if (slot < 0 || slot >= blocks)
    throw py::index_error("there are " + std::to_string(blocks) + " blocks");
  std::vector<py::ssize_t> shape = {8, 8, 8}, strides = {step, 8 * step, 64 * step};
  if (parts > 1) {
    shape.push_back(parts);
    strides.push_back(part);
  }
  return view_of(reinterpret_cast<const Number*>(field.block(static_cast<std::uint32_t>(slot))),
                 std::move(shape), std::move(strides), owner);
}

/// The values of all blocks, in one piece, as (blocks, 8, 8, 8, ...) numbers [block, x, y, z].
template <typename Number, typename Value>
py::array blocks_at(const Value* values, std::size_t count, py::handle owner) {
  constexpr py::ssize_t step = sizeof(Value), part = sizeof(Number), parts = step / part;
  const auto blocks = static_cast<py::ssize_t>(count / kBlockVoxels);
  std::vector<py::ssize_t> shape = {blocks, 8, 8, 8},
                           strides = {kBlockVoxels * step, step, 8 * step, 64 * step};
  if (parts > 1) {
    shape.push_back(parts);
    strides.push_back(part);
  }
  if (blocks == 0) return py::array(py::dtype::of<Number>(), std::move(shape));
  return view_of(reinterpret_cast<const Number*>(values), std::move(shape), std::move(strides),
                 owner);
}

/// The same of a copy.
template <typename Number, typename Value>
py::array blocks_copy(std::vector<Value> values) {
  auto* kept = new std::vector<Value>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  return blocks_at<Number>(kept->data(), kept->size(), owner);
}

/// The same of a field: a view where its blocks lie in one piece, else (of live maps) a copy.
template <typename Number, typename Value>
py::array blocks_view(const VoxelField<Value>& field, py::handle owner) {
  if (field.size() == 0 || !is_in_one_piece(field)) return blocks_copy<Number>(field.values());
  return blocks_at<Number>(field.block(0), field.size(), owner);
}

/// Low corners of a layout's blocks, (blocks, 3), metres, world.
template <typename Map>
py::array block_corners(const Map& map) {
  std::vector<Point> corners;
  corners.reserve(map.layout.block_count());
  for (const BlockIndex& block : map.layout.blocks()) {
    const VoxelIndex v = voxel_of(block, 0);
    corners.push_back(to_world(map, Point(v.x, v.y, v.z) * map.voxel_size));
  }
  return array_of(std::move(corners));
}

/// The voxels of the lattice that a dense copy covers: of `bounds` (world), cut to what is known
/// along axes on which those are infinite, or of all that is known.
inline VoxelRange dense_range(py::handle bounds, const VoxelRange& known, double voxel_size) {
  if (bounds.is_none()) return known;
  Box box = box_from(bounds, "bounds");
  for (int axis = 0; axis < 3; ++axis) {
    const auto end = [&](const VoxelIndex& v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
    if (std::isinf(box.min[axis])) box.min[axis] = end(known.min) * voxel_size;
    if (std::isinf(box.max[axis])) box.max[axis] = (end(known.max) + 1) * voxel_size;
  }
  return voxels_overlapping(box, voxel_size);
}

/// The values of a range of the lattice's voxels as a Grid: value(id) of each, id kNoVoxel where
/// none is allocated. Of a planar map those of the robot's layer, whatever the heights. Refused
/// where memory would not do.
template <typename Value, typename Map, typename Get>
py::object dense(const Map& map, VoxelRange range, const Get& value) {
  if (map.planar && !range.empty()) range.min.z = range.max.z = map.origin.z + kPlanarLayer;
  const auto count = [](int first, int last) { return static_cast<py::ssize_t>(last) - first + 1; };
  std::array<py::ssize_t, 3> shape{};
  if (!range.empty())
    shape = {count(range.min.x, range.max.x), count(range.min.y, range.max.y),
             count(range.min.z, range.max.z)};
  require_memory(static_cast<double>(shape[0]) * static_cast<double>(shape[1]) *
                     static_cast<double>(shape[2]) * sizeof(Value),
                 "bounds", "give smaller ones, or look at the blocks one by one");
  py::array_t<Value> values({shape[0], shape[1], shape[2]});
  Value* const first = values.mutable_data();
  const VoxelIndex low = range.min - map.origin;  // the map's own
  {
    const Unlocked unlocked;
    parallel_for_each_index(static_cast<std::size_t>(shape[0]), [&](std::size_t x) {
      VoxelFinder finder(map.layout);
      Value* out = first + static_cast<py::ssize_t>(x) * shape[1] * shape[2];
      for (int y = 0; y < shape[1]; ++y)
        for (int z = 0; z < shape[2]; ++z)
          *out++ = value(finder.find(low + VoxelIndex{static_cast<int>(x), y, z}));
    });
  }
  const Point corner = Point(range.min.x, range.min.y, range.min.z) * map.voxel_size;
  const py::object as_asked = map.planar ? values.reshape({shape[0], shape[1]}) : values;
  return py::module_::import("ridgeway._values")
      .attr("Grid")(as_asked, map.voxel_size, tuple_of(corner));
}

}  // namespace ridgeway::python
