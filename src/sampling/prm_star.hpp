// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <ompl/geometric/planners/prm/PRMstar.h>

namespace ridgeway::detail {

/// PRM* (Karaman and Frazzoli 2011) on OMPL's roadmap: uniform samples, each joined to its k(n)
/// nearest. OMPL's own loop alternates with expansion steps by the clock and looks for a path in a
/// second thread, so that no run of it repeats; this one does neither.
class PrmStar : public ompl::geometric::PRMstar {
 public:
  using ompl::geometric::PRMstar::PRMstar;
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;
};

}  // namespace ridgeway::detail
