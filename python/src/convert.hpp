// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

/// Between Python's values and the library's. What is of the wrong type throws TypeError, what has
/// the wrong shape or value InputError; both name the argument and what is expected.
namespace ridgeway::python {

namespace py = pybind11;

/// "str 'abc'", "array of float64 with shape (2, 3)", for messages.
std::string describe(py::handle value);

double number_from(py::handle value, const char* name);
bool flag_from(py::handle value, const char* name);
std::int64_t whole_from(py::handle value, const char* name);
/// Which of `count` an index means, as Python counts: from the end where it is below 0. Throws
/// IndexError, naming `what` there are, where it is none of them.
std::size_t place_from(py::handle index, std::size_t count, const char* what);
/// What iter() gives of a value with __getitem__ and __len__.
py::object iterator_of(const py::object& sequence);
/// What sequence[index] gives of `count` items: one(place) of a whole number, a list of a slice.
template <typename One>
py::object item_or_slice(py::handle index, std::size_t count, const One& one) {
  if (!PySlice_Check(index.ptr())) return one(index);
  std::size_t at = 0, stop = 0, step = 0, length = 0;
  if (!py::reinterpret_borrow<py::slice>(index).compute(count, &at, &stop, &step, &length))
    throw py::error_already_set();
  py::list items;
  for (std::size_t i = 0; i < length; ++i, at += step) items.append(one(py::int_(at)));
  return items;
}
std::string text_from(py::handle value, const char* name);
/// Text that may hold the name of a file. Bytes that are no UTF-8 become what os.fsencode() turns
/// back into them.
py::str text_to_python(const std::string& name);
/// str, bytes or os.PathLike.
std::filesystem::path path_from(py::handle value, const char* name);
/// The same of a file to be written, whose name has to end as what is in it does.
std::filesystem::path path_from(py::handle value, const char* name, const char* ending);

/// Three finite numbers, metres.
Point point_from(py::handle value, const char* name);
/// An (N, 3) array of finite numbers, metres, or what numpy makes one of.
std::vector<Point> points_from(py::handle value, const char* name);
/// The same, or one point alone.
struct OneOrMany {
  std::vector<Point> points;
  bool is_one = false;  ///< answers are the item, no array of one
};
OneOrMany one_or_many_from(py::handle value, const char* name);
/// An (N, 3) array of whole numbers within kAllVoxels.
std::vector<VoxelIndex> voxels_from(py::handle value, const char* name);
VoxelIndex voxel_from(py::handle value, const char* name);
/// A 4 x 4 matrix: rotation and translation.
Eigen::Isometry3d pose_from(py::handle value, const char* name);
/// Two corners, (2, 3) or six numbers, the lesser first; infinite ones are no limit.
Box box_from(py::handle value, const char* name);

/// Throws for numpy's masked arrays, of which the rest of this module would see the values alone.
void require_no_mask(py::handle value, const char* name);

/// An array of doubles in C order, of `dimensions` dimensions: `value` itself where it is one.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
Doubles doubles_from(py::handle value, const char* name, const std::string& expected);

py::tuple tuple_of(const Point& point);
py::tuple tuple_of(const VoxelIndex& voxel);
py::object tuple_of(const Box& box);
/// (4, 4).
py::array array_of(const Eigen::Isometry3d& pose);

/// The memory of a vector, or of another plain container, as an array that owns it.
template <typename Value>
py::array owning_array(std::vector<Value> values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<Value>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  return py::array_t<Value>(std::move(shape), kept->data(), owner);
}
/// (N, 3).
py::array array_of(std::vector<Point> points);

/// Somebody's memory as an array that cannot be written to and keeps `owner` alive. Strides in
/// bytes; empty: C order.
template <typename Value>
py::array view_of(const Value* data, std::vector<py::ssize_t> shape,
                  std::vector<py::ssize_t> strides, py::handle owner) {
  py::array array =
      strides.empty()
          ? py::array(py::dtype::of<Value>(), std::move(shape), data, owner)
          : py::array(py::dtype::of<Value>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
/// (N, 3).
py::array view_of(const std::vector<Point>& points, py::handle owner);

}  // namespace ridgeway::python
