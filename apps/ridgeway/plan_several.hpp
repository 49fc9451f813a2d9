// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "commands.hpp"
#include "plan_options.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::cli {

// Forms of `ridgeway plan` that answer with more than one path, or choose among goals. Each prints
// and returns the exit code.

int run_alternatives(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals);
int run_goals(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals);
int run_nearest(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals);

}  // namespace ridgeway::cli
