// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>

#include "ridgeway/mapping/tsdf_map.hpp"

namespace ridgeway {

/// Writes a truncated distance field to a `.ridge` file, whole or not at all. `source`: what it was
/// made from, for people. Throws InputError where the file cannot be written.
void save_tsdf(const TsdfMap& map, const std::string& source, const std::filesystem::path& path);

/// Reads it back, bit for bit. Throws InputError for a file that is truncated, damaged, no
/// truncated distance field, or holds values that are none.
TsdfMap load_tsdf(const std::filesystem::path& path);

/// Whether a file says that it is one; false for files that cannot be read.
bool is_tsdf_file(const std::filesystem::path& path);

}  // namespace ridgeway
