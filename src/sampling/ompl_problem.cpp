// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ompl_problem.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>

namespace ridgeway::detail {
namespace {

namespace ob = ompl::base;

class FreePlaces : public ob::StateValidityChecker {
 public:
  FreePlaces(const ob::SpaceInformationPtr& space, const EsdfMap& esdf, double radius)
      : ob::StateValidityChecker(space), free_(esdf), radius_(radius) {}

  bool isValid(const ob::State* state) const override {
    return free_.is_free(point_of(state), radius_);
  }
  double clearance(const ob::State* state) const override {
    return free_.distance(point_of(state));
  }

 private:
  const FreeSpace free_;
  const double radius_;
};

/// OMPL's counters of motions are left alone: they are not safe between threads.
class FreeMotions : public ob::MotionValidator {
 public:
  FreeMotions(const ob::SpaceInformationPtr& space, const EsdfMap& esdf, double radius)
      : ob::MotionValidator(space), free_(esdf), radius_(radius) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return free_.is_free(point_of(from), point_of(to), radius_);
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    const Point a = point_of(from), b = point_of(to);
    if (free_.is_free(a, b, radius_)) return true;
    const double length = (b - a).norm();
    last_valid.second = length > 0.0 ? free_.free_length(a, b, radius_) / length : 0.0;
    if (last_valid.first != nullptr)
      si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
    return false;
  }

 private:
  const FreeSpace free_;
  const double radius_;
};

/// Length as the cost, with samplers of known seeds.
class PathLength : public ob::PathLengthOptimizationObjective {
 public:
  PathLength(const ob::SpaceInformationPtr& space, OmplSeeds& seeds)
      : ob::PathLengthOptimizationObjective(space), seeds_(seeds) {}

  ob::InformedSamplerPtr allocInformedStateSampler(const ob::ProblemDefinitionPtr& definition,
                                                   unsigned int most_calls) const override {
    return seeds_.seeded([&] {
      return ob::PathLengthOptimizationObjective::allocInformedStateSampler(definition, most_calls);
    });
  }

 private:
  OmplSeeds& seeds_;
};

/// The box around the known free voxels, less what the radius takes off where all around it is an
/// obstacle. A start that is free must exist.
ob::RealVectorBounds sampling_bounds(const EsdfMap& esdf, double radius) {
  VoxelIndex low = voxel_of(esdf.layout.block(0), 0), high = low;
  bool any = false;
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot) {
    const VoxelIndex first = voxel_of(esdf.layout.block(slot), 0),
                     last = voxel_of(esdf.layout.block(slot), kBlockVoxels - 1);
    if (any && first.x >= low.x && first.y >= low.y && first.z >= low.z && last.x <= high.x &&
        last.y <= high.y && last.z <= high.z)
      continue;
    const VoxelState* states = esdf.state.block(slot);
    for (int local = 0; local < kBlockVoxels; ++local) {
      if (states[local] != VoxelState::kFree) continue;
      const VoxelIndex v = voxel_of(esdf.layout.block(slot), local);
      if (!any) low = high = v;
      any = true;
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
  }
  // A little wider, so that places that just fit are not lost to rounding.
  const double margin =
      esdf.unknown == UnknownPolicy::kObstacle ? radius * (1.0 - 1e-6) : -1e-6 * esdf.voxel_size;
  const double s = esdf.voxel_size;
  ob::RealVectorBounds bounds(3);
  bounds.low = {low.x * s + margin, low.y * s + margin, low.z * s + margin};
  bounds.high = {(high.x + 1) * s - margin, (high.y + 1) * s - margin, (high.z + 1) * s - margin};
  return bounds;
}

}  // namespace

Point point_of(const ompl::base::State* state) {
  const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1], values[2]};
}

OmplProblem make_problem(const EsdfMap& esdf, const Point& start, const Point& goal,
                         const SamplingConfig& config, OmplSeeds& seeds) {
  return seeds.seeded([&]() -> OmplProblem {
    const auto points = std::make_shared<ob::RealVectorStateSpace>(3);
    points->setBounds(sampling_bounds(esdf, config.radius));
    points->setStateSamplerAllocator([&seeds](const ob::StateSpace* space) {
      return seeds.seeded([&] { return space->allocDefaultStateSampler(); });
    });
    const auto space = std::make_shared<ob::SpaceInformation>(points);
    space->setStateValidityChecker(std::make_shared<FreePlaces>(space, esdf, config.radius));
    space->setMotionValidator(std::make_shared<FreeMotions>(space, esdf, config.radius));
    space->setup();

    const auto definition = std::make_shared<ob::ProblemDefinition>(space);
    const auto place = [&](const Point& p) {
      ob::ScopedState<ob::RealVectorStateSpace> state(points);
      std::copy(p.begin(), p.end(), state->values);
      return state;
    };
    definition->setStartAndGoalStates(place(start), place(goal));
    const auto length = std::make_shared<PathLength>(space, seeds);
    // Nothing is shorter than the straight line; of first paths any will do.
    length->setCostThreshold(config.first_solution
                                 ? length->infiniteCost()
                                 : ob::Cost((goal - start).norm() * (1.0 + 1e-9)));
    definition->setOptimizationObjective(length);
    return {space, definition};
  });
}

std::vector<Point> solution_of(const ompl::base::ProblemDefinition& definition) {
  std::vector<Point> waypoints;
  if (!definition.hasExactSolution()) return waypoints;
  auto* path = definition.getSolutionPath()->as<ompl::geometric::PathGeometric>();
  for (const ob::State* state : path->getStates()) waypoints.push_back(point_of(state));
  return waypoints;
}

}  // namespace ridgeway::detail
