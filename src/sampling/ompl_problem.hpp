// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <ompl/base/ProblemDefinition.h>

#include <functional>

#include "ompl_process.hpp"
#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"

namespace ridgeway::detail {

/// A query in OMPL's terms: points of the box around the known free voxels, the free-space
/// predicate for places and motions, length as the cost. Once the deadline has passed no motion is
/// free, which ends the loops of planners that look at no limit within a round. `esdf`, `seeds` and
/// `deadline` must outlive it.
struct OmplProblem {
  ompl::base::SpaceInformationPtr space;
  ompl::base::ProblemDefinitionPtr definition;
};
OmplProblem make_problem(const FreeSpace& free, const Point& start, const Point& goal,
                         const SamplingConfig& config, OmplSeeds& seeds, const Deadline& deadline);

Point point_of(const ompl::base::State* state);

/// The waypoints of the best path found; empty where there is none.
std::vector<Point> solution_of(const ompl::base::ProblemDefinition& definition);

}  // namespace ridgeway::detail
