// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {

/// The library names fields of its configs (min_clearance), the command line has options
/// (--min-clearance): the error in the words of a command that has these options.
InputError with_option_names(const InputError& error, const std::vector<std::string>& options);

/// The same of a note, which names options in brackets: "(option voxel_size)" is "(--voxel-size)".
std::string with_option_names(std::string note);

}  // namespace ridgeway::cli
