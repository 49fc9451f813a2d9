// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The Python module: a file a topic, no logic of its own.
#include <cerrno>
#include <exception>
#include <filesystem>

#include "convert.hpp"
#include "faces.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/version.hpp"

namespace ridgeway::python {
namespace {

PyObject* input_error = nullptr;  // the class, as long as the module

/// An InputError of Python with what the library's has.
void raise(const InputError& error) {
  const py::object value = py::handle(input_error)(text_to_python(error.what()));
  value.attr("where") = text_to_python(error.where());
  value.attr("problem") = text_to_python(error.problem());
  value.attr("remedy") = text_to_python(error.remedy());
  PyErr_SetObject(input_error, value.ptr());
}

void raise(const std::filesystem::filesystem_error& error) {
  const py::object value = py::handle(PyExc_OSError)(error.code().value(), error.code().message(),
                                                     text_to_python(error.path1().string()));
  PyErr_SetObject(PyExc_OSError, value.ptr());
}

}  // namespace

void add_errors(py::module_& module) {
  const py::module_ values = py::module_::import("ridgeway._values");
  for (const char* name : {"InputError", "Cancelled"}) module.attr(name) = values.attr(name);
  input_error = module.attr("InputError").ptr();
  static PyObject* const cancelled = module.attr("Cancelled").ptr();
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(std::move(pointer));
    } catch (const InputError& error) {
      raise(error);
    } catch (const Cancelled& error) {
      PyErr_SetString(cancelled, error.what());
    } catch (const std::filesystem::filesystem_error& error) {
      raise(error);
    }
  });
}

/// What never changes is its own copy, a deep one too.
static void add_copies(py::module_& module) {
  for (const char* name : {"Alternatives", "BlockedRoute", "DepthSequence", "EsdfMap",
                           "ExplorationStep", "FlightLimits", "GraphDelta", "OccupancyMap",
                           "PinholeCamera", "PlanResult", "Roadmap", "ScanSequence", "SparseGraph",
                           "SpinningLidar", "Trajectory", "TsdfMap", "VoxelMask", "World"}) {
    const py::object type = module.attr(name);
    const auto itself = [of = py::handle(type)](const py::object& self, const py::args&) {
      if (!py::isinstance(self, of)) throw py::type_error("copies an object of another type");
      return self;
    };
    for (const char* method : {"__copy__", "__deepcopy__"})
      type.attr(method) = py::cpp_function(itself, py::is_method(type));
  }
}

static void add_all(py::module_& module) {
  // Docstrings begin with signatures of ours, which inspect.signature reads.
  py::options options;
  options.disable_function_signatures();
  module.doc() = "The compiled part of ridgeway.";
  module.attr("__version__") = kVersion;
  add_errors(module);
  add_maps(module);
  add_fields(module);
  add_stages(module);
  add_graph(module);
  add_plans(module);
  add_roadmap(module);
  add_flights(module);
  add_fusion(module);
  add_live(module);
  add_exploration(module);
  add_copies(module);
  add_words_for_wrong_calls(module);
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>())
    if (py::isinstance<py::type>(value)) value.attr("__module__") = "ridgeway";
}

}  // namespace ridgeway::python

PYBIND11_MODULE(_core, module) { ridgeway::python::add_all(module); }
