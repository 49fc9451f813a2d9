// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "convert.hpp"
#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway::python {

/// An (H, W) array of depths along the optical axis, metres; 0 and NaN where nothing was measured.
DepthImage image_from(py::handle value, const char* name);

/// Points as a sensor gives them: (N, 3), not all finite.
std::vector<Point> cloud_from(py::handle value);

/// The angles and the range of a sensor as keyword arguments of Explorer.
py::dict dict_of(const FieldOfView& view);

void add_sensors(py::module_& module);
void add_scans(py::module_& module);

}  // namespace ridgeway::python
