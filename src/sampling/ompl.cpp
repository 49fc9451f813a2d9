// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sampling/ompl.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <memory>
#include <optional>
#include <string>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway {
namespace {

namespace ob = ompl::base;

/// What flight_place knows of a map, which may be gone when a state is asked for.
struct Frame {
  double voxel_size;
  VoxelIndex origin;
  std::optional<double> height;  // of planar maps
};

double checked_radius(const EsdfMap& esdf, double radius) {
  if (!(radius >= 0.0) || radius > largest_radius(esdf))
    throw InputError(
        "radius", "is " + number_text(radius) + " m",
        "give 0 to " + number_text(largest_radius(esdf)) + " m, for which the map knows distances");
  return radius;
}

}  // namespace

PlaceOf place_in_world(const ob::StateSpacePtr& space, const EsdfMap& esdf) {
  Frame frame{esdf.voxel_size, esdf.origin, {}};
  if (esdf.planar) frame.height = flight_place(esdf, Point::Zero()).z();
  const auto place = [frame](double x, double y, double z) {
    Point local = to_local(frame, Point(x, y, z));
    local.z() = frame.height.value_or(local.z());
    return local;
  };
  if (dynamic_cast<const ob::SE3StateSpace*>(space.get()) != nullptr)
    return [place](const ob::State* state) {
      const auto* pose = state->as<ob::SE3StateSpace::StateType>();
      return place(pose->getX(), pose->getY(), pose->getZ());
    };
  if (dynamic_cast<const ob::RealVectorStateSpace*>(space.get()) != nullptr &&
      space->getDimension() >= 3)
    return [place](const ob::State* state) {
      const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
      return place(values[0], values[1], values[2]);
    };
  throw InputError("state space '" + space->getName() + "'", "holds no place that is known here",
                   "use RealVectorStateSpace(3) or SE3StateSpace, or write a PlaceOf");
}

FreeStates::FreeStates(const ob::SpaceInformationPtr& space, const FreeSpace& free, double radius,
                       PlaceOf place_of)
    : ob::StateValidityChecker(space),
      free_(free),
      radius_(checked_radius(free.map(), radius)),
      place_of_(std::move(place_of)) {}

bool FreeStates::isValid(const ob::State* state) const {
  return free_.is_free(place_of_(state), radius_);
}

double FreeStates::clearance(const ob::State* state) const {
  return free_.distance(place_of_(state));
}

FreeMotions::FreeMotions(const ob::SpaceInformationPtr& space, const FreeSpace& free, double radius,
                         PlaceOf place_of)
    : ob::MotionValidator(space),
      free_(free),
      radius_(checked_radius(free.map(), radius)),
      place_of_(std::move(place_of)) {}

bool FreeMotions::checkMotion(const ob::State* from, const ob::State* to) const {
  return free_.is_free(place_of_(from), place_of_(to), radius_);
}

bool FreeMotions::checkMotion(const ob::State* from, const ob::State* to,
                              std::pair<ob::State*, double>& last_valid) const {
  const Point a = place_of_(from), b = place_of_(to);
  if (free_.is_free(a, b, radius_)) return true;
  const double length = (b - a).norm();
  last_valid.second = length > 0.0 ? free_.free_length(a, b, radius_) / length : 0.0;
  if (last_valid.first != nullptr)
    si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
  return false;
}

void use_roadmap(const ob::SpaceInformationPtr& space, const Roadmap& roadmap, double radius) {
  const PlaceOf place_of = place_in_world(space->getStateSpace(), roadmap.esdf);
  space->setStateValidityChecker(
      std::make_shared<FreeStates>(space, roadmap.esdf, radius, place_of));
  space->setMotionValidator(std::make_shared<FreeMotions>(space, roadmap.esdf, radius, place_of));
}

}  // namespace ridgeway
