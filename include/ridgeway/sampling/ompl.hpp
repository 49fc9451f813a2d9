// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <functional>
#include <utility>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// The exact free-space predicate for OMPL's planners, for people who run those themselves. The one
/// header of Ridgeway that includes those of OMPL, which come with ridgeway::sampling.

/// From a state of a planner to its place in a map's local frame, metres.
using PlaceOf = std::function<Point(const ompl::base::State*)>;

/// Of states that hold a place of the world, metres: x, y and z are the first numbers of a
/// RealVectorStateSpace, or those of an SE3StateSpace. Throws InputError for other spaces; for
/// these, compound ones among them, write a PlaceOf that ends with to_local(esdf, point).
PlaceOf place_in_world(const ompl::base::StateSpacePtr& space, const EsdfMap& esdf);

/// Says of states whether a sphere of a radius, metres, fits (FreeSpace::is_free); clearance() is
/// FreeSpace::distance(). `free` may be an EsdfMap; what it is a view of must outlive it.
/// Thread-safe.
class FreeStates : public ompl::base::StateValidityChecker {
 public:
  /// Throws InputError where a radius is negative, no number, or larger than the map knows
  /// distances for.
  FreeStates(const ompl::base::SpaceInformationPtr& space, const FreeSpace& free, double radius,
             PlaceOf place_of);

  /// Whether the sphere fits at the state's place.
  bool isValid(const ompl::base::State* state) const override;
  /// The distance from there to the nearest obstacle, metres.
  double clearance(const ompl::base::State* state) const override;

 private:
  const FreeSpace free_;
  const double radius_;
  const PlaceOf place_of_;
};

/// Says whether a sphere can move along the straight line between two states, exactly, not by steps
/// along it. What `free` is a view of must outlive it. Thread-safe: OMPL's counters of motions,
/// which are not, are left alone.
class FreeMotions : public ompl::base::MotionValidator {
 public:
  /// Throws InputError as FreeStates does.
  FreeMotions(const ompl::base::SpaceInformationPtr& space, const FreeSpace& free, double radius,
              PlaceOf place_of);

  /// Whether all of the motion is free.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// `last_valid`: a state up to which the motion is free, at most a voxel short of the last one,
  /// and its share of the way.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  const FreeSpace free_;
  const double radius_;
  const PlaceOf place_of_;
};

/// Gives a planner's space both, for places of the world. The roadmap must outlive the space.
/// Throws InputError as FreeStates and place_in_world do.
void use_roadmap(const ompl::base::SpaceInformationPtr& space, const Roadmap& roadmap,
                 double radius);

}  // namespace ridgeway
