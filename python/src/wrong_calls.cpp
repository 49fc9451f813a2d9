// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Calls that fit no signature. pybind11 would tell of them by the C++ types that it takes, most of
// which are "handle". So each function gets a last overload that takes anything, and refuses it in
// Python's own words, by the signature that the docstring begins with.
#include "convert.hpp"
#include "faces.hpp"

namespace ridgeway::python {
namespace {

/// "Roadmap, int, radius=str".
std::string types_of(const py::args& arguments, const py::kwargs& keywords) {
  std::string text;
  const auto add = [&](const std::string& before, py::handle value) {
    text += (text.empty() ? "" : ", ") + before +
            std::string(py::str(py::type::handle_of(value).attr("__name__")));
  };
  for (const py::handle value : arguments) add("", value);
  for (const auto& [key, value] : keywords) add(std::string(py::str(key)) + "=", value);
  return text;
}

/// "(start, goal, ...)": what a call has to name, without the many that are keywords alone.
std::string outline_of(py::handle signature, bool is_constructor) {
  std::string text;
  for (const py::handle parameter : signature.attr("parameters").attr("values")()) {
    if (is_constructor && py::str(parameter.attr("name")).equal(py::str("self"))) continue;
    if (parameter.attr("kind").cast<int>() > 1)
      return "(" + text + (text.empty() ? "name=value, ...)" : ", ...)");
    text += (text.empty() ? "" : ", ") + std::string(py::str(parameter));
  }
  return "(" + text + ")";
}

/// ": what it takes, in the first sentence of its docstring.", or nothing.
std::string first_sentence(py::handle function) {
  const py::object doc = py::module_::import("inspect").attr("getdoc")(function);
  if (doc.is_none()) return "";
  const std::string text = py::str(py::str(" ").attr("join")(doc.attr("split")()));
  const std::size_t end = text.find(". ");
  return ": " + (end == std::string::npos ? text : text.substr(0, end + 1));
}

/// `call` is the function of `owner`, as a person would write it; `self` comes first in methods,
/// but not in constructors.
[[noreturn]] void refuse_call(py::handle owner, const std::string& name, const std::string& call,
                              const py::args& arguments, const py::kwargs& keywords) {
  const bool is_constructor = name == "__init__";
  const py::object signature =
      py::module_::import("inspect").attr("signature")(owner.attr(name.c_str()));
  std::string problem = "cannot take " + types_of(arguments, keywords), meaning;
  try {
    const py::tuple self = is_constructor ? py::make_tuple(py::none()) : py::tuple();
    signature.attr("bind")(*self, *arguments, **keywords);
    if (!is_constructor) meaning = first_sentence(owner.attr(name.c_str()));
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError)) throw;
    problem = py::str(error.value());
  }
  throw py::type_error(call + "(): " + problem + "; it is " + call +
                       outline_of(signature, is_constructor) + meaning);
}

/// How else a value of a class is made that no call of the class makes.
[[noreturn]] void refuse_making(const std::string& name, const std::vector<std::string>& makers) {
  std::string text = name + ": is not made by calling it";
  for (const std::string& maker : makers)
    text += (&maker == &makers.front() ? "; use " : " or ") + (name + "." + maker);
  throw py::type_error(text);
}

void add_to_function(py::handle owner, const std::string& name, const std::string& call,
                     bool is_method) {
  const auto refuse = [owner, name, call](const py::args& arguments, const py::kwargs& keywords) {
    refuse_call(owner, name, call, arguments, keywords);
  };
  const py::object before = owner.attr(name.c_str());
  // Appended to the function that is there, which stays where it is.
  if (is_method)
    py::cpp_function(refuse, py::name(name.c_str()), py::is_method(owner), py::sibling(before));
  else
    py::cpp_function(refuse, py::name(name.c_str()), py::scope(owner), py::sibling(before));
}

/// Of an object whose __init__ was not called, or has thrown, pybind11 would hand out memory that
/// holds nothing: it asks this for it.
void refuse_unmade_objects(py::handle type) {
  py::detail::type_info* info =
      py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(type.ptr()));
  if (info == nullptr) return;
  info->operator_new = [](std::size_t) -> void* {
    throw py::type_error("the object was not made: its __init__ was not called, or has failed");
  };
}

void add_to_constructor(py::handle type, const std::string& name,
                        const std::vector<std::string>& makers) {
  const auto add = [&](const auto& refuse, const auto&... before) {
    return py::cpp_function(refuse, py::name("__init__"), py::is_method(type), before...,
                            py::detail::is_new_style_constructor());
  };
  const py::object own = type.attr("__init__");
  // Classes that are not made by calling them have pybind11's, which is no method.
  if (PyInstanceMethod_Check(py::dict(type.attr("__dict__"))["__init__"].ptr()))
    add(
        [type, name](py::detail::value_and_holder&, const py::args& arguments,
                     const py::kwargs& keywords) {
          refuse_call(type, "__init__", name, arguments, keywords);
        },
        py::sibling(own));
  else
    type.attr("__init__") = add([name, makers](py::detail::value_and_holder&, const py::args&,
                                               const py::kwargs&) { refuse_making(name, makers); });
}

void add_to_class(py::handle type) {
  refuse_unmade_objects(type);
  const std::string name = py::str(type.attr("__name__"));
  std::vector<std::string> makers;
  const py::dict members(type.attr("__dict__"));  // a copy, as members are added
  for (const auto& [key, member] : members) {
    const std::string function = py::str(key);
    const bool is_static = PyObject_TypeCheck(member.ptr(), &PyStaticMethod_Type) != 0;
    if (is_static) makers.push_back(function);
    if (function.starts_with("__") || !(is_static || PyInstanceMethod_Check(member.ptr())))
      continue;
    add_to_function(type, function, name + "." + function, !is_static);
  }
  add_to_constructor(type, name, makers);
}

}  // namespace

void add_words_for_wrong_calls(py::module_& module) {
  const py::dict members(module.attr("__dict__").attr("copy")());
  for (const auto& [key, member] : members) {
    const std::string name = py::str(key);
    if (PyCFunction_Check(member.ptr()))
      add_to_function(module, name, name, false);
    else if (py::isinstance<py::type>(member) && !PyExceptionClass_Check(member.ptr()))
      add_to_class(member);
  }
}

}  // namespace ridgeway::python
