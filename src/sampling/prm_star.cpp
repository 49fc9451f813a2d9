// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "prm_star.hpp"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>

namespace ridgeway::detail {

namespace ob = ompl::base;

ob::PlannerStatus PrmStar::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  bestCost_ = opt_->infiniteCost();
  const ob::State *const start = pis_.nextStart(), *const goal = pis_.nextGoal();
  if (start == nullptr) return ob::PlannerStatus::INVALID_START;  // out of the bounds, say
  if (goal == nullptr) return ob::PlannerStatus::INVALID_GOAL;
  startM_.push_back(addMilestone(si_->cloneState(start)));
  goalM_.push_back(addMilestone(si_->cloneState(goal)));
  const ob::StateSamplerPtr sampler = si_->allocStateSampler();
  ob::ScopedState<> sample(si_);
  ob::PathPtr path;
  const auto look_for_path = [&] { return maybeConstructSolution(startM_, goalM_, path); };

  bool enough = look_for_path();
  const auto& report = pdef_->getIntermediateSolutionCallback();
  for (bool connected = path != nullptr; !enough && !stop; ++iterations_) {
    sampler->sampleUniform(sample.get());
    if (!si_->isValid(sample.get())) continue;
    addMilestone(si_->cloneState(sample.get()));
    if (connected || !sameComponent(startM_[0], goalM_[0])) continue;
    connected = true;
    enough = look_for_path();
    if (report) report(this, {}, bestCost_);
  }
  if (!enough) look_for_path();
  if (path == nullptr) return ob::PlannerStatus::TIMEOUT;
  pdef_->addSolutionPath(path, false, 0.0, getName());
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace ridgeway::detail
