// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sampling/plan_by_sampling.hpp"

#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/asking.hpp"
#include "common/number_text.hpp"
#include "ompl_problem.hpp"
#include "paths/deadline.hpp"
#include "paths/shorten.hpp"
#include "planning/query.hpp"
#include "prm_star.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using detail::Deadline;
using detail::seconds_now;

// Of a motion: about the width of a door. First paths of RRT-Connect at 0.5, 1, 3 m took 4.5, 2.0,
// 1.0 ms in the maze (corridors of 2.7 m), and at 1, 3 m 7, 570 ms through a door of fr_079.
constexpr double kRange = 1.0;
constexpr double kRangeVoxels = 10.0;

template <typename Tree>
ob::PlannerPtr make_tree(const ob::SpaceInformationPtr& space, double range) {
  const auto planner = std::make_shared<Tree>(space);
  planner->setRange(range);
  return planner;
}

ob::PlannerPtr make_planner(const ob::SpaceInformationPtr& space, const SamplingConfig& config,
                            double voxel_size) {
  const double range =
      config.range > 0.0 ? config.range : std::max(kRange, kRangeVoxels * voxel_size);
  switch (config.planner) {
    case Planner::kRrtStar:
      return make_tree<og::RRTstar>(space, range);
    case Planner::kInformedRrtStar:
      return make_tree<og::InformedRRTstar>(space, range);
    case Planner::kBitStar:
      return std::make_shared<og::BITstar>(space);
    case Planner::kPrmStar:
      return std::make_shared<detail::PrmStar>(space);
    default:
      return make_tree<og::RRTConnect>(space, range);
  }
}

/// Trees of far smaller steps than a voxel take for ever and find nothing more.
void require_range(const SamplingConfig& config, double voxel_size) {
  constexpr double kLeastVoxels = 0.1 * (1.0 - 1e-9);
  if (config.range == 0.0 || config.range >= kLeastVoxels * voxel_size) return;
  throw InputError("range",
                   "is " + number_text(config.range) + " m, far below the map's voxel size of " +
                       number_text(voxel_size) + " m",
                   "give a voxel's size or more, or leave it out");
}

/// Samples until a path or a limit; the waypoints, empty where there is no path. Points are local.
/// Throws Cancelled.
std::vector<Point> sample(const FreeSpace& space, const Point& start, const Point& goal,
                          const SamplingConfig& config, const Progress& progress,
                          SamplingResult& result) {
  const double began = seconds_now();
  const detail::QuietOmpl quiet;
  detail::OmplSeeds seeds(config.seed);
  const Deadline deadline(config.time_limit);
  const detail::OmplProblem problem =
      detail::make_problem(space, start, goal, config, seeds, deadline);
  const ob::PlannerPtr planner = seeds.seeded([&] {
    ob::PlannerPtr made = make_planner(problem.space, config, space.map().voxel_size);
    made->setProblemDefinition(problem.definition);
    made->setup();
    return made;
  });
  const double ready = seconds_now();
  result.plan.seconds.attach += ready - began;
  problem.definition->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>&, const ob::Cost cost) {
        if (result.first_seconds > 0.0) return;
        result.first_seconds = seconds_now() - ready;
        result.first_length = cost.value();
      });
  detail::Asking asking(progress);
  const auto share_done = [&] {
    const double iterations =
        static_cast<double>(result.iterations) / static_cast<double>(config.iteration_limit);
    return std::min(1.0, std::max((seconds_now() - ready) / config.time_limit, iterations));
  };
  planner->solve(ob::PlannerTerminationCondition([&] {
    if (!asking.may_go_on("sampling", share_done())) return true;
    if (deadline.is_over() || result.iterations >= config.iteration_limit) return true;
    ++result.iterations;
    return false;
  }));
  if (asking.is_cancelled()) throw Cancelled();
  result.plan.seconds.search = seconds_now() - ready;
  return detail::solution_of(*problem.definition);
}

}  // namespace

void SamplingConfig::validate() const {
  validate_planner(planner);
  if (!is_sampling(planner))
    throw InputError("planner", "is " + std::string(name_of(planner)) + ", which does not sample",
                     "call plan");
  if (!(radius > 0.0 && std::isfinite(radius)))
    throw InputError("radius", "is " + number_text(radius),
                     "give the robot's radius in metres, above 0");
  limits.validate();
  detail::validate_robot_height(robot_height);
  if (!(time_limit > 0.0))
    throw InputError("time_limit", "is " + number_text(time_limit), "give seconds above 0");
  if (std::isinf(time_limit) && iteration_limit == std::numeric_limits<std::size_t>::max())
    throw InputError("time_limit", "is infinite, and there is no iteration_limit",
                     "give one of the two");
  if (!(range >= 0.0 && std::isfinite(range)))
    throw InputError("range", "is " + number_text(range),
                     "give metres above 0, or 0 for the default");
}

namespace {

/// plan_by_sampling() between points of the local frame, with waypoints there.
SamplingResult sample_locally(const EsdfMap& esdf, const Point& start, const Point& goal,
                              const SamplingConfig& config, const Progress& progress) {
  config.validate();
  require_range(config, esdf.voxel_size);
  detail::validate_query(esdf, start, goal, config.radius);
  const double began = seconds_now();
  SamplingResult result;
  PlanResult& plan = result.plan;
  plan.answered_by = config.planner;
  plan.unknown = esdf.unknown;
  const auto finish = [&](PlanStatus status) {
    plan.status = status;
    plan.seconds.total = seconds_now() - began;
    return result;
  };
  const FlightLimits limits = detail::limits_of(esdf, config.limits);
  detail::require_height_counts(esdf, config.robot_height);
  const FreeSpace space(esdf, limits, config.radius, config.robot_height);
  const PlanStatus ends = detail::find_ends(space, start, goal, config.radius).status;
  plan.seconds.attach = seconds_now() - began;
  const bool is_refused = ends != PlanStatus::kOk;
  if (is_refused && !detail::may_go_straight(ends, space, start, goal, config.radius))
    return finish(ends);

  const bool is_straight = is_refused || ((config.shorten || start == goal) &&
                                          space.is_free(start, goal, config.radius));
  const std::vector<Point> found = is_straight
                                       ? std::vector<Point>{start, goal}
                                       : sample(space, start, goal, config, progress, result);
  if (found.empty()) return finish(PlanStatus::kTimeout);
  if (result.first_length == 0.0) {  // the planner did not report it: there was but one path
    result.first_seconds = plan.seconds.search;
    result.first_length = length_of(found);
  }
  const auto accept = [&](std::vector<Point> waypoints) {
    plan.waypoints = std::move(waypoints);
    detail::describe(space, {}, plan);
    return detail::is_verified(esdf, space, plan, config.radius);
  };
  if (config.shorten) {
    const double shortening = seconds_now();
    const Deadline deadline(config.time_limit);
    std::vector<Point> tight = detail::shorten(space, found, config.radius, deadline);
    plan.seconds.shorten = seconds_now() - shortening;
    if (accept(std::move(tight))) return finish(PlanStatus::kOk);
  }
  if (accept(found)) return finish(PlanStatus::kOk);
  plan.waypoints.clear();
  return finish(PlanStatus::kTimeout);
}

}  // namespace

SamplingResult plan_by_sampling(const EsdfMap& esdf, const Point& start, const Point& goal,
                                const SamplingConfig& config, const Progress& progress) {
  const Point from = detail::place_in_local(esdf, start, config.radius);
  const Point to = detail::place_in_local(esdf, goal, config.radius);
  SamplingResult result = sample_locally(esdf, from, to, config, progress);
  detail::move_to_world(esdf, start, goal, result.plan);
  result.plan.planned_for = {config.radius, config.robot_height, config.limits};
  return result;
}

}  // namespace ridgeway
