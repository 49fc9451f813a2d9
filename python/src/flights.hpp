// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <pybind11/numpy.h>

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::python {

namespace py = pybind11;

/// States every `step` seconds, and at the end: TrajectorySamples.
py::object samples_of(const Trajectory& trajectory, py::handle step);
/// Of the polynomial pieces, (S,), seconds.
py::array durations_of(const Trajectory& trajectory);
/// (S, 4, 10): x, y, z, yaw by powers of t.
py::array coefficients_of(const Trajectory& trajectory);

}  // namespace ridgeway::python
