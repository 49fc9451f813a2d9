// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <filesystem>

#include "plan_options.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::cli {

/// The file of one of several routes, counted from 1: --output with the number in its name.
std::filesystem::path output_of_route(const PlanOptions& options, std::size_t number);

/// Throws InputError where --output names no format, or a mission has no datum, or a datum no
/// mission.
void require_outputs(const PlanOptions& options);

/// As the extension says: a path, or a mission.
void write_output(const PlanOptions& options, const PlanResult& plan,
                  const std::filesystem::path& file);

}  // namespace ridgeway::cli
