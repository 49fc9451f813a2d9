// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// Writes a roadmap to one `.ridge` file, by way of a temporary file in the same folder: on any
/// error an existing file stays as it was. The same roadmap gives the same bytes, whatever the
/// number of threads. The layout of the file is in docs/ridge-format.md.
/// Throws InputError when the file cannot be written, or when the roadmap's parts do not fit each
/// other (a field on another layout, a distance that is not that of its site).
void save_roadmap(const Roadmap& roadmap, const std::filesystem::path& path);

/// Reads a roadmap back; every field is the one that was saved. Throws InputError, with the
/// section's name, for a file that is truncated, damaged, of a newer version or no roadmap, and for
/// one whose content would break a query (an index out of range, a number that is not finite).
Roadmap load_roadmap(const std::filesystem::path& path);

/// A section of a `.ridge` file.
struct RidgeSection {
  std::string name;                    ///< as in docs/ridge-format.md
  std::uint64_t raw_bytes = 0;         ///< of its content
  std::uint64_t compressed_bytes = 0;  ///< that it takes in the file
};

/// What a `.ridge` file says of itself, read without its content.
struct RidgeInfo {
  std::uint32_t version = 0;           ///< of the format
  std::string header;                  ///< JSON text: its keys are in docs/ridge-format.md
  std::vector<RidgeSection> sections;  ///< in the order of the file
};

/// Reads the header alone. Throws InputError as load_roadmap does.
RidgeInfo read_ridge_info(const std::filesystem::path& path);

/// Writes a truncated distance field to a `.ridge` file, whole or not at all. `source`: what it was
/// made from, for people. Throws InputError where the file cannot be written.
void save_tsdf(const TsdfMap& map, const std::string& source, const std::filesystem::path& path);

/// Reads it back, bit for bit. Throws InputError for a file that is truncated, damaged, no
/// truncated distance field, or holds values that are none.
TsdfMap load_tsdf(const std::filesystem::path& path);

/// Whether a file says that it is one; false for files that cannot be read.
bool is_tsdf_file(const std::filesystem::path& path);

}  // namespace ridgeway
