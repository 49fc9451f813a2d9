// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "lock.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::python {

namespace py = pybind11;

/// Asks Python, with its lock, whether to go on: not after Ctrl-C, and not where the caller's own
/// function says False or throws.
class Watch {
 public:
  explicit Watch(py::object callback) : callback_(std::move(callback)) {}

  bool go_on(std::string_view stage, double share) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (callback_.is_none()) return true;
      const py::object answer = callback_(py::str(stage.data(), stage.size()), share);
      return !is_false(answer);
    } catch (py::error_already_set& error) {
      error_.emplace(error);
      return false;
    }
  }

  /// What Python threw, if it did; for callers that hold the lock again.
  void rethrow() {
    if (error_) throw py::error_already_set(*error_);
  }

 private:
  /// Python's False, or numpy's; None is what functions return that say nothing.
  static bool is_false(const py::object& answer) {
    if (answer.ptr() == Py_False) return true;
    const std::string type = py::str(py::type::of(answer).attr("__module__"));
    return type == "numpy" &&
           py::str(py::type::of(answer).attr("__name__")).cast<std::string>().starts_with("bool") &&
           !py::bool_(answer);
  }

  py::object callback_;
  std::optional<py::error_already_set> error_;
};

/// Runs work(progress), which asks often whether to go on, on so many threads (0: all) without
/// Python's lock. Ctrl-C, or `callback` (stage, share done) -> False, cancels it.
template <typename Work>
auto run_long(const py::object& callback, int threads, Work&& work) {
  Watch watch(callback);
  try {
    Unlocked unlocked;
    const Progress progress = [&](std::string_view stage, double share) {
      return unlocked.locked([&] { return watch.go_on(stage, share); });
    };
    return with_threads(threads, [&] { return work(progress); });
  } catch (const Cancelled&) {
    watch.rethrow();
    throw;
  }
}

/// Runs work(), which knows nothing of progress and changes nothing that is kept where it does not
/// end, without Python's lock. Ctrl-C cancels it in the middle of its loops.
template <typename Work>
auto run_stage(Work&& work, int threads = 0) {
  return run_long(py::none(), threads, [&](const Progress& progress) {
    return with_progress(progress, "", [&](const Progress&) { return work(); });
  });
}

}  // namespace ridgeway::python
