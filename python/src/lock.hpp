// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <thread>

namespace ridgeway::python {

namespace py = pybind11;

/// Does what may ask for Python's lock. When a program has come to its end, Python ends every other
/// thread that asks where it stands (pthread_exit), which in the middle of C++ aborts the program.
/// Here such a thread waits for ever in place of that, as Python itself has it from version 3.14
/// on.
template <typename Work>
auto unless_python_has_ended(const Work& work) {
  try {
    return work();
  } catch (const abi::__forced_unwind&) {
    for (;;) pause();
  }
}

/// Gives Python's lock to others while it lives.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked() { take_back(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  /// Does what needs the lock, with it. In the thread that gave it, this is by that thread's own
  /// state: another cannot be made once Python has ended.
  template <typename Work>
  auto locked(const Work& work) {
    if (std::this_thread::get_id() != owner_) {
      const py::gil_scoped_acquire acquire;
      return work();
    }
    take_back();
    const GiveAgain again{state_};
    return unless_python_has_ended(work);  // before it is given again
  }

 private:
  struct GiveAgain {
    PyThreadState*& state;
    ~GiveAgain() { state = PyEval_SaveThread(); }
  };
  void take_back() {
    unless_python_has_ended([&] { PyEval_RestoreThread(state_); });
  }

  const std::thread::id owner_ = std::this_thread::get_id();
  PyThreadState* state_;
};

}  // namespace ridgeway::python
