// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "faces.hpp"
#include "plans.hpp"
namespace ridgeway::python { void add_flights(py::module_&) {} void add_trajectories(py::class_<RoadmapFace>&) {} }
