// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ompl_problem.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "ridgeway/sampling/ompl.hpp"

namespace ridgeway::detail {
namespace {

namespace ob = ompl::base;

/// FreeMotions until the deadline; no motion is free afterwards.
class TimelyMotions : public FreeMotions {
 public:
  TimelyMotions(const ob::SpaceInformationPtr& space, const FreeSpace& free, double radius,
                const Deadline& deadline)
      : FreeMotions(space, free, radius, point_of), deadline_(deadline) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return !deadline_.is_over() && FreeMotions::checkMotion(from, to);
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (!deadline_.is_over()) return FreeMotions::checkMotion(from, to, last_valid);
    last_valid.second = 0.0;
    if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
    return false;
  }

 private:
  const Deadline& deadline_;
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

/// The free voxels of one layer of a block, a bit each, x fastest.
std::uint64_t free_layer(const EsdfMap& esdf, std::uint32_t slot, int z) {
  // All that is no obstacle is free, unless the unknown is none either.
  if (esdf.unknown == UnknownPolicy::kObstacle)
    return ~esdf.obstacle.block(slot)[static_cast<std::size_t>(z)];
  const VoxelState* states = esdf.state.block(slot) + 64 * z;
  std::uint64_t bits = 0;
  for (int i = 0; i < 64; ++i)
    bits |= static_cast<std::uint64_t>(is_open(states[i], esdf.unknown)) << i;
  return bits;
}

/// The box around the known free voxels, less what the radius takes off where all around it is an
/// obstacle. There must be a free voxel.
ob::RealVectorBounds sampling_bounds(const FreeSpace& free, double radius) {
  const EsdfMap& esdf = free.map();
  constexpr int kMost = std::numeric_limits<int>::max();
  VoxelIndex low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot) {
    const VoxelIndex corner = voxel_of(esdf.layout.block(slot), 0);
    for (int z = 0; z < kBlockSide; ++z) {
      const std::uint64_t layer = free_layer(esdf, slot, z);
      if (layer == 0) continue;
      std::uint64_t row = layer | layer >> 32;  // all rows of it in one
      row |= row >> 16;
      row = (row | row >> 8) & 0xff;
      const VoxelIndex first{std::countr_zero(row), std::countr_zero(layer) / 8, z};
      const VoxelIndex last{63 - std::countl_zero(row), (63 - std::countl_zero(layer)) / 8, z};
      low = {std::min(low.x, corner.x + first.x), std::min(low.y, corner.y + first.y),
             std::min(low.z, corner.z + first.z)};
      high = {std::max(high.x, corner.x + last.x), std::max(high.y, corner.y + last.y),
              std::max(high.z, corner.z + last.z)};
    }
  }
  // A little wider, so that places that just fit are not lost to rounding.
  const double margin = esdf.unknown == UnknownPolicy::kObstacle
                            ? free.inner_radius(radius) * (1.0 - 1e-6)
                            : -1e-6 * esdf.voxel_size;
  const double s = esdf.voxel_size;
  ob::RealVectorBounds bounds(3);
  bounds.low = {low.x * s + margin, low.y * s + margin, low.z * s + margin};
  bounds.high = {(high.x + 1) * s - margin, (high.y + 1) * s - margin, (high.z + 1) * s - margin};
  for (std::vector<double>* corner : {&bounds.low, &bounds.high}) {
    const Point within = free.nearest_within(Point((*corner)[0], (*corner)[1], (*corner)[2]));
    corner->assign(within.begin(), within.end());
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {  // OMPL takes no box without volume
    constexpr double kOnTheFace = 2e-8;           // metres: more than limits allow for rounding
    bounds.low[axis] -= kOnTheFace;
    bounds.high[axis] += kOnTheFace;
  }
  return bounds;
}

}  // namespace

Point point_of(const ompl::base::State* state) {
  const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1], values[2]};
}

OmplProblem make_problem(const FreeSpace& free, const Point& start, const Point& goal,
                         const SamplingConfig& config, OmplSeeds& seeds, const Deadline& deadline) {
  const ob::RealVectorBounds bounds = sampling_bounds(free, config.radius);
  return seeds.seeded([&]() -> OmplProblem {
    const auto points = std::make_shared<ob::RealVectorStateSpace>(3);
    points->setBounds(bounds);
    points->setStateSamplerAllocator([&seeds](const ob::StateSpace* space) {
      return seeds.seeded([&] { return space->allocDefaultStateSampler(); });
    });
    const auto space = std::make_shared<ob::SpaceInformation>(points);
    space->setStateValidityChecker(
        std::make_shared<FreeStates>(space, free, config.radius, point_of));
    space->setMotionValidator(
        std::make_shared<TimelyMotions>(space, free, config.radius, deadline));
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
