// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>

#include "json.hpp"
#include "query_file.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"

namespace ridgeway::cli {

using Json = nlohmann::ordered_json;

/// What was planned; of planners that do not sample only the plan.
using Answer = SamplingResult;

/// `reason`: why there is no path.
Json json_of(const EsdfMap& esdf, const Answer& answer, const Query& query,
             const std::string& reason);
void print_result(const EsdfMap& esdf, const Answer& answer, const Query& query,
                  const std::string& reason);
/// One of several plans in a line.
void print_line(const PlanResult& result, const std::string& reason);

}  // namespace ridgeway::cli
