// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>

namespace ridgeway::detail {

/// Throws the InputError of a file that could not be used, with the system's reason and what helps
/// against it. `problem`: "cannot be read"; `error`: as errno has it.
[[noreturn]] void fail_file(const std::filesystem::path& file, const std::string& problem,
                            int error);

}  // namespace ridgeway::detail
