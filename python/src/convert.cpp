// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "convert.hpp"

#include <cmath>
#include <limits>

#include "common/number_text.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"

namespace ridgeway::python {
namespace {

[[noreturn]] void wrong_type(py::handle value, const std::string& name,
                             const std::string& expected) {
  throw py::type_error(name + ": expected " + expected + ", got " + describe(value));
}

[[noreturn]] void wrong_shape(py::handle value, const std::string& name,
                              const std::string& expected) {
  throw InputError(name, "is " + describe(value), "give " + expected);
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

bool is_text(py::handle value) {
  return PyUnicode_Check(value.ptr()) || PyBytes_Check(value.ptr());
}

void require_finite(const Point& point, const std::string& name) {
  if (point.allFinite()) return;
  throw InputError(name,
                   "is (" + number_text(point.x()) + ", " + number_text(point.y()) + ", " +
                       number_text(point.z()) + ")",
                   "give finite numbers, metres");
}

}  // namespace

std::string describe(py::handle value) {
  if (py::isinstance<py::array>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    return "an array of " + std::string(py::str(array.dtype())) + " with shape " +
           shape_text(array);
  }
  if (value.is_none()) return "None";
  const std::string type = py::str(py::type::handle_of(value).attr("__name__"));
  std::string text = py::repr(value);
  constexpr std::size_t kMost = 60;
  std::size_t end = kMost;
  if (text.size() > kMost) {
    while (end > 0 && (text[end] & 0xc0) == 0x80) --end;  // not within a character
    text = text.substr(0, end) + "...";
  }
  return type + " " + text;
}

double number_from(py::handle value, const char* name) {
  if (!is_text(value) && !PyBool_Check(value.ptr())) {  // True is no radius of 1 m
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    const bool is_too_large = PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
    PyErr_Clear();
    if (is_too_large) throw InputError(name, "is " + describe(value), "give a smaller number");
  }
  wrong_type(value, name, "a number");
}

bool flag_from(py::handle value, const char* name) {
  if (value.ptr() == Py_True) return true;
  if (value.ptr() == Py_False) return false;
  // numpy's own truth values are no bool.
  if (std::string(py::str(py::type::handle_of(value).attr("__name__"))).starts_with("bool"))
    return PyObject_IsTrue(value.ptr()) == 1;
  wrong_type(value, name, "True or False");
}

std::int64_t whole_from(py::handle value, const char* name) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) {
    PyErr_Clear();
    wrong_type(value, name, "a whole number");
  }
  const long long number = PyLong_AsLongLong(index.ptr());
  if (number == -1 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw InputError(name, "is " + describe(value), "give a smaller number");
  }
  return number;
}

std::size_t place_from(py::handle index, std::size_t count, const char* what) {
  const std::int64_t given = whole_from(index, "index"), all = static_cast<std::int64_t>(count);
  const std::int64_t place = given < 0 ? given + all : given;
  if (place < 0 || place >= all)
    throw py::index_error("there are " + std::to_string(count) + " " + what);
  return static_cast<std::size_t>(place);
}

py::object iterator_of(const py::object& sequence) {
  if (!PySequence_Check(sequence.ptr())) wrong_type(sequence, "self", "a sequence");
  return py::reinterpret_steal<py::object>(PySeqIter_New(sequence.ptr()));
}

std::string text_from(py::handle value, const char* name) {
  if (!PyUnicode_Check(value.ptr())) wrong_type(value, name, "a string");
  Py_ssize_t size = 0;
  if (const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size))
    return {text, static_cast<std::size_t>(size)};
  PyErr_Clear();
  throw InputError(name, "holds half of a surrogate pair, which is no character",
                   "give text that UTF-8 can hold");
}

py::str text_to_python(const std::string& name) {
  auto text = py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "surrogateescape"));
  if (!text) throw py::error_already_set();
  return text;
}

std::filesystem::path path_from(py::handle value, const char* name) {
  const auto path = py::reinterpret_steal<py::object>(PyOS_FSPath(value.ptr()));
  if (!path) {
    PyErr_Clear();
    wrong_type(value, name, "a path (str or os.PathLike)");
  }
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0) throw py::error_already_set();
  const auto owner = py::reinterpret_steal<py::bytes>(bytes);
  return std::string(owner);
}

std::filesystem::path path_from(py::handle value, const char* name, const char* ending) {
  std::filesystem::path file = path_from(value, name);
  if (extension_of(file) != ending)
    throw InputError(name, "is " + describe(value), std::string("let it end in ") + ending);
  return file;
}

void require_no_mask(py::handle value, const char* name) {
  if (!py::isinstance<py::array>(value) || !py::hasattr(value, "mask")) return;
  if (!py::module_::import("numpy").attr("any")(value.attr("mask")).cast<bool>()) return;
  throw py::type_error(std::string(name) +
                       ": is a masked array, and what is masked has no value; " + "give " + name +
                       ".filled(...) or " + name + ".compressed()");
}

Doubles doubles_from(py::handle value, const char* name, const std::string& expected) {
  require_no_mask(value, name);
  const auto array = py::isinstance<py::array>(value) ? py::reinterpret_borrow<py::array>(value)
                                                      : py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    wrong_type(value, name, expected);
  }
  const char kind = array.dtype().kind();
  if (array.size() > 0 && kind != 'f' && kind != 'i' && kind != 'u')
    wrong_type(value, name, expected);
  return Doubles(array);
}

Point point_from(py::handle value, const char* name) {
  Point point;
  if (PyTuple_CheckExact(value.ptr()) || PyList_CheckExact(value.ptr())) {  // the usual, and quick
    if (PySequence_Fast_GET_SIZE(value.ptr()) != 3)
      wrong_shape(value, name, "three numbers x, y, z, metres");
    for (int i = 0; i < 3; ++i)
      point[i] = number_from(PySequence_Fast_GET_ITEM(value.ptr(), i), name);
  } else {
    const Doubles array = doubles_from(value, name, "three numbers x, y, z, metres");
    if (array.ndim() != 1 || array.shape(0) != 3)
      wrong_shape(value, name, "three numbers x, y, z, metres");
    for (int i = 0; i < 3; ++i) point[i] = array.data()[i];
  }
  require_finite(point, name);
  return point;
}

std::vector<Point> points_from(py::handle value, const char* name) {
  const Doubles array = doubles_from(value, name, "an (N, 3) array of numbers, metres");
  const bool none = array.size() == 0 && array.ndim() <= 2;
  if (!none && (array.ndim() != 2 || array.shape(1) != 3))
    wrong_shape(value, name, "an (N, 3) array of numbers, metres");
  std::vector<Point> points(static_cast<std::size_t>(none ? 0 : array.shape(0)));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = Eigen::Map<const Point>(array.data() + 3 * i);
    if (!points[i].allFinite())
      require_finite(points[i], std::string(name) + "[" + std::to_string(i) + "]");
  }
  return points;
}

OneOrMany one_or_many_from(py::handle value, const char* name) {
  const Doubles array = doubles_from(value, name, "(3,) or (N, 3) numbers, metres");
  if (array.ndim() == 1 && array.size() == 3) return {{point_from(value, name)}, true};
  return {points_from(value, name)};
}

std::vector<VoxelIndex> voxels_from(py::handle value, const char* name) {
  const std::string expected = "an (N, 3) array of whole numbers";
  require_no_mask(value, name);
  const auto array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    wrong_type(value, name, expected);
  }
  if (array.size() == 0) return {};
  if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u') wrong_type(value, name, expected);
  if (array.ndim() != 2 || array.shape(1) != 3) wrong_shape(value, name, expected);
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> whole(array);
  const bool is_unsigned = array.dtype().kind() == 'u';  // 2^64 - 1 came out as -1
  std::vector<VoxelIndex> voxels(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const std::int64_t* v = whole.data() + 3 * i;
    for (int axis = 0; axis < 3; ++axis)
      if (v[axis] < -kMaxVoxelIndex || v[axis] > kMaxVoxelIndex || (is_unsigned && v[axis] < 0))
        throw InputError(std::string(name) + "[" + std::to_string(i) + "]",
                         "is " +
                             (is_unsigned ? std::to_string(static_cast<std::uint64_t>(v[axis]))
                                          : std::to_string(v[axis])) +
                             " along an axis",
                         "give voxels from -1e9 to 1e9");
    voxels[i] = {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
  }
  return voxels;
}

VoxelIndex voxel_from(py::handle value, const char* name) {
  const auto array = py::array::ensure(value);
  if (!array) PyErr_Clear();
  if (!array || array.ndim() != 1 || array.size() != 3)
    wrong_shape(value, name, "three whole numbers x, y, z");
  return voxels_from(array.attr("reshape")(1, 3), name).front();
}

Eigen::Isometry3d pose_from(py::handle value, const char* name) {
  const std::string expected = "a (4, 4) matrix, rotation and translation (metres)";
  const Doubles array = doubles_from(value, name, expected);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
    wrong_shape(value, name, expected);
  using Rows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Rows rows = Eigen::Map<const Rows>(array.data());
  if (!rows.allFinite())
    throw InputError(name, "has entries that are no finite numbers", "give " + expected);
  if (!(rows.row(3) == Eigen::RowVector4d(0, 0, 0, 1)))
    throw InputError(name, "has another last row than 0, 0, 0, 1", "give " + expected);
  Eigen::Isometry3d pose;
  pose.matrix() = rows;
  try {
    validate_transform(pose);
  } catch (const InputError& error) {
    throw InputError(name, error.problem(), error.remedy());
  }
  return pose;
}

Box box_from(py::handle value, const char* name) {
  const std::string expected = "two corners, ((x0, y0, z0), (x1, y1, z1)), metres";
  const Doubles array = doubles_from(value, name, expected);
  const bool is_flat = array.ndim() == 1 && array.shape(0) == 6;
  const bool is_square = array.ndim() == 2 && array.shape(0) == 2 && array.shape(1) == 3;
  if (!is_flat && !is_square) wrong_shape(value, name, expected);
  Box box = {Eigen::Map<const Point>(array.data()), Eigen::Map<const Point>(array.data() + 3)};
  validate_box(box, name);
  return box;
}

py::tuple tuple_of(const Point& p) { return py::make_tuple(p.x(), p.y(), p.z()); }
py::tuple tuple_of(const VoxelIndex& v) { return py::make_tuple(v.x, v.y, v.z); }
py::object tuple_of(const Box& box) { return py::make_tuple(tuple_of(box.min), tuple_of(box.max)); }

py::array array_of(const Eigen::Isometry3d& pose) {
  py::array_t<double> array({4, 4});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.mutable_data()) = pose.matrix();
  return array;
}

py::array array_of(std::vector<Point> points) {
  static_assert(sizeof(Point) == 3 * sizeof(double));
  auto* kept = new std::vector<Point>(std::move(points));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Point>*>(p); });
  return py::array_t<double>({static_cast<py::ssize_t>(kept->size()), py::ssize_t{3}},
                             reinterpret_cast<const double*>(kept->data()), owner);
}

py::array view_of(const std::vector<Point>& points, py::handle owner) {
  return view_of(reinterpret_cast<const double*>(points.data()),
                 {static_cast<py::ssize_t>(points.size()), 3}, {}, owner);
}

}  // namespace ridgeway::python
