// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "faces.hpp"
namespace ridgeway::python { void add_fusion(py::module_&) {} void add_live(py::module_&) {} }
