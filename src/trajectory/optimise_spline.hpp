// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "spline_objective.hpp"

namespace ridgeway {

struct OptimisationReport {
  CostTerms before, after;
  int evaluations = 0;
  bool converged = false;  ///< otherwise the evaluations ran out, or no step went down any more
};

struct OptimisationResult {
  SpaceSpline spline;  ///< the best that was seen
  OptimisationReport report;
};

/// Lowers the cost of a spline by L-BFGS (NLopt's, Nocedal 1980), from where it stands, with at
/// most `most_evaluations` of the cost. Deterministic. Throws as MinimumSpline does.
OptimisationResult optimise_spline(SpaceSpline spline, const SplineCostConfig& config,
                                   const DistanceField& field, int most_evaluations);

}  // namespace ridgeway
