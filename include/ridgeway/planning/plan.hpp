// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// Whether there is a path, or the one reason why there is none.
enum class PlanStatus : std::uint8_t {
  kOk,
  kStartOutsideMap,
  kStartUnknown,
  kStartInCollision,  ///< nearer to an obstacle than the radius; PlanConfig::escape may lead out
  kGoalOutsideMap,
  kGoalUnknown,
  kGoalInCollision,
  kNoRoute,  ///< RouteBlocks (planning/blocked_route.hpp) tells what is in the way
  kRadiusTooSmall,
  kTimeout,
  kStartOutsideLimits,  ///< of the flight: PlanConfig::limits, or those of the map
  kGoalOutsideLimits,
};

/// Which structure is searched and how, and which one answered.
enum class Planner : std::uint8_t {
  kGraph,
  kDiagram,
  /// A* over the voxel lattice. What is too long once it is pulled tight is made shorter by the
  /// same searches as a path of kGraph: comparisons with it are with the better of both.
  kEsdf,
  kThetaStar,  ///< lazy Theta*: the same lattice, at any angle
  // By sampling, see sampling/plan_by_sampling.hpp:
  kRrtStar,
  kRrtConnect,
  kBitStar,
  kPrmStar,
  kInformedRrtStar,
  /// None: a path that was given, not planned. Only ever an answer's.
  kGiven,
};
/// Whether it is one of OMPL's.
constexpr bool is_sampling(Planner planner) {
  return planner >= Planner::kRrtStar && planner <= Planner::kInformedRrtStar;
}

/// Names as in the JSON output, "invalid" for what is no enumerator: "ok", "start_outside_map",
/// ...; "graph", "diagram", "esdf", "theta", "rrtstar", "rrtconnect", "bitstar", "prmstar",
/// "informedrrtstar", "given".
std::string_view name_of(PlanStatus status);
std::string_view name_of(Planner planner);  ///< The same of a planner.
/// "obstacle", "ignore" or "free".
std::string_view name_of(UnknownPolicy policy);
/// The planner of a name, or nothing; "given" is none.
std::optional<Planner> planner_named(std::string_view name);
/// Throws InputError where a planner is no enumerator.
void validate_planner(Planner planner);

/// How to plan: for which robot, within which limits, how long to look for something shorter.
struct PlanConfig {
  Planner planner = Planner::kGraph;  ///< the structure to search
  /// Metres; the roadmap's min_clearance when not given.
  std::optional<double> radius = std::nullopt;
  bool shorten = true;  ///< pull the path tight; otherwise as the search found it
  /// Settle for the first route that is hardly longer than may be expected, as it is found over the
  /// tangent graph, or pulled tight over cells, or else for the graph's; no voxels are searched for
  /// a shorter one. Paths are a percent or two longer as a rule, but some are detours. It changes
  /// nothing with `within` or prefer_clearance.
  bool quick = false;
  /// Go on until a short path is at most so many times as long as the bound below which no path can
  /// be (PlanResult::within), or the time limit has passed, or all is searched that there is:
  /// seconds, where the bound is far from what is possible. 0: only as long as that mostly pays.
  double within = 0.0;
  static constexpr double kBestWithin = 1.02;  ///< as near as pays at any price
  /// Seconds, after which the best path that is known is the answer, or PlanStatus::kTimeout where
  /// none is.
  double time_limit = std::numeric_limits<double>::infinity();
  /// What distance from walls is worth: a metre of a path at a distance d from the nearest obstacle
  /// costs 1 + prefer_clearance * (radius / d)^2. At 0 paths are as short as can be; at 1 they keep
  /// some distance where that is cheap; at 10 they follow the middle. The graph's edges count with
  /// their smallest distance. The other planners search for short paths whatever this is: there it
  /// only keeps paths from being pulled towards walls.
  double prefer_clearance = 0.0;
  /// Start and goal may be too close to an obstacle, though not in one: paths then begin and end
  /// with a leg straight to the nearest place where the robot fits. See Escape. Of spheres alone:
  /// not with `robot_height`.
  bool escape = false;
  /// Where the robot's centre may be, world frame; those that the map was built with hold as well.
  FlightLimits limits = {};
  /// Start and goal that cannot be used (unknown, occupied, too close to an obstacle, outside the
  /// limits or the map) are moved to the nearest place within so many metres where the robot fits:
  /// the start to the nearest one at all, the goal to the nearest that can be reached from it. See
  /// PlanResult::moved_start. 0: they are not moved.
  double snap = 0.0;
  /// Above 0 the robot is an upright cylinder of that height, metres, and the radius; its inner
  /// radius, the lesser of radius and half the height, must be the roadmap's min_clearance at
  /// least. See FreeSpace.
  double robot_height = 0.0;

  /// Throws InputError naming the bad field (a radius or time limit not above 0, prefer_clearance
  /// negative or above 1e6, within neither 0 nor 1 and more, NaN anywhere, bad limits, a planner
  /// that samples, `escape` of a cylinder).
  void validate() const;
};

/// Seconds that the parts of a query took.
struct PlanSeconds {
  double attach = 0.0;   ///< from start and goal to the structure that is searched
  double search = 0.0;   ///< for the way between, over corners or the structure that was asked for
  double shorten = 0.0;  ///< to pull it tight, and to look for a shorter one over cells and voxels
  double total = 0.0;    ///< all of the query
};

/// The first or last segment of a path whose start or goal is too close to an obstacle for the
/// radius. It stays in known-free voxels, and its distance to obstacles never falls, by a 64th of a
/// voxel or more, on the way from that end, nor anywhere below what it is there; it is at most two
/// radii long.
struct Escape {
  double length = 0.0;     ///< metres; 0 where there is no such segment
  double clearance = 0.0;  ///< at that end, the smallest on it, metres
};

/// Where a start or goal was moved to.
struct Moved {
  double distance = 0.0;        ///< metres; 0 where it was not
  Point place = Point::Zero();  ///< world
};

/// The robot that a path was planned for, and where it may be.
struct PlannedFor {
  double radius = 0.0;        ///< metres; 0: not said, as of a path of one's own
  double robot_height = 0.0;  ///< as in PlanConfig
  FlightLimits limits = {};   ///< as in PlanConfig
};

/// A path, or the one reason why there is none.
struct PlanResult {
  PlanStatus status = PlanStatus::kNoRoute;          ///< kOk, or why there is no path
  UnknownPolicy unknown = UnknownPolicy::kObstacle;  ///< what unknown space was taken for
  /// The structure that was searched last; kGraph for what corners, cells and voxels answer too
  Planner answered_by = Planner::kGraph;
  /// World frame; start first, goal last: two or more where ok, else none.
  std::vector<Point> waypoints;
  double length = 0.0;  ///< metres
  /// The length is at most so many times that of the shortest path: over a bound that none is
  /// below, the straight line between start and goal. 1: there is no shorter one; infinite where
  /// start and goal are one place and the path leads out of it, as escapes do.
  double within = 1.0;
  /// Smallest distance along the path, without its escapes, to an obstacle, metres: to what is
  /// occupied and, under UnknownPolicy::kObstacle, to what is unknown. How near the path comes to
  /// either of them under any policy: Surroundings (esdf/surroundings.hpp).
  double clearance = 0.0;
  Escape escape_start;     ///< of the first segment
  Escape escape_goal;      ///< of the last one
  Moved moved_start;       ///< by PlanConfig::snap
  Moved moved_goal;        ///< by PlanConfig::snap
  PlanSeconds seconds;     ///< what it took
  PlannedFor planned_for;  ///< what fly_plan and still_safe go by

  /// Whether there is a path.
  bool ok() const { return status == PlanStatus::kOk; }
};

/// Plans from start to goal (metres, world frame) for a sphere of the asked radius. Every segment
/// of the path, but for escapes, has been verified by the free-space predicate
/// (esdf/free_space.hpp), in the map's local frame; the waypoints given back are those moved into
/// the world, which rounds them there (in UTM by a nanometre). The answer is exact on the voxel
/// lattice: a path is found exactly when A* through the ESDF would find one, or the straight line
/// is free. Thread-safe on one roadmap. Throws InputError where the configuration or a point is no
/// number, or the radius is larger than the map knows distances for, and Cancelled where it is part
/// of what was cancelled (with_progress).
PlanResult plan(const Roadmap& roadmap, const Point& start, const Point& goal,
                const PlanConfig& config = {});

/// A path of one's own (world, metres) as a result, to be flown as it is: ok, with its length and
/// clearance, answered by Planner::kGiven; in a planar map at the height of its layer. Whether it
/// is free is not asked. Throws InputError for one without waypoints, or far outside the map.
PlanResult given_plan(const EsdfMap& esdf, std::vector<Point> waypoints);

}  // namespace ridgeway
