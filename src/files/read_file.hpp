// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>

namespace ridgeway {

/// The bytes of a file. Throws InputError where it is missing, empty, no regular file, cannot be
/// read, or does not fit into memory.
std::string read_file(const std::filesystem::path& file);

}  // namespace ridgeway
