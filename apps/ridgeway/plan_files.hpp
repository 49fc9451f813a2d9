// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <vector>

#include "plan_options.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::cli {

/// The files that `ridgeway plan` writes: of alternatives, which --output names, one for each.
std::vector<std::filesystem::path> outputs_of(const PlanOptions& options);

/// Throws InputError where --output names no format, or a mission has no datum, or a datum no
/// mission.
void require_outputs(const PlanOptions& options);

/// As the extension says: a path, or a mission.
void write_output(const PlanOptions& options, const PlanResult& plan,
                  const std::filesystem::path& file);

}  // namespace ridgeway::cli
