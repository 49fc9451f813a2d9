// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <pybind11/pybind11.h>

namespace ridgeway::python {

namespace py = pybind11;

/// Before Python's lock is taken by a thread that runs C++: ends where Python still takes threads
/// in, else never. When the program has come to its end, Python ends whatever thread asks for the
/// lock where it stands, in the middle of C++, which aborts the program; from version 3.14 on such
/// threads wait for ever, as here.
void wait_where_python_ends();

/// Gives Python's lock to others while it lives.
class Unlocked {
 public:
  Unlocked() = default;
  ~Unlocked() { wait_where_python_ends(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  /// Counts who is without the lock, until it is taken again.
  struct Away {
    Away();
    ~Away();
  };
  Away away_;
  py::gil_scoped_release release_;
};

/// Has wait_where_python_ends() learn when it does.
void watch_for_the_end();

}  // namespace ridgeway::python
