// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "trajectory/optimise_spline.hpp"

namespace ridgeway {

/// Debian has no NLopt for WebAssembly: splines stay as they are, and trajectories of pages that
/// are one file stop at corners (RIDGEWAY_STOP_AND_GO), verified as all are.
OptimisationResult optimise_spline(SpaceSpline spline, const SplineCostConfig& /*config*/,
                                   const DistanceField& /*field*/, int /*most_evaluations*/) {
  return {std::move(spline), {}};
}

}  // namespace ridgeway
