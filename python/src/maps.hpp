// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>

#include "faces.hpp"
#include "ridgeway/formats/load_map.hpp"

namespace ridgeway::python {

MapFace face_of(OccupancyMap map, std::string source = {});

/// Reads a map; what a person should be told becomes a warning of Python.
MapFace load_face(const std::filesystem::path& path, const LoadConfig& config);

}  // namespace ridgeway::python
