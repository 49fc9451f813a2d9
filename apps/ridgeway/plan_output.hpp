// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>

#include "json.hpp"
#include "query_file.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"
#include "roadmap_facts.hpp"

namespace ridgeway::cli {

using Json = nlohmann::ordered_json;

/// What was planned; of planners that do not sample only the plan.
using Answer = SamplingResult;

/// `reason`: why there is no path.
Json json_of(AnswerFacts& facts, const Answer& answer, const Query& query);
void print_result(AnswerFacts& facts, const Answer& answer, const Query& query);
/// One of several plans in a line.
void print_line(const PlanResult& result, const std::string& reason);

}  // namespace ridgeway::cli
