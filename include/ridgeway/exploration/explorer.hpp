// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/exploration/frontiers.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/sensing/depth_camera.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// What a level depth sensor sees: a pyramid, or all around.
struct FieldOfView {
  double horizontal = 0.5 * std::numbers::pi;  ///< radians, the whole angle; 2 pi: all around
  double vertical = 1.2;                       ///< radians, the whole angle, in the middle
  double nearest = 0.0;                        ///< metres; what is nearer is not seen
  double range = 7.0;                          ///< metres; what is farther is not counted on

  /// Whether `horizontal` is the whole turn.
  bool is_all_around() const { return horizontal > 6.28; }

  /// Throws InputError naming the bad field.
  void validate() const;
};
/// Of a camera, counting on a share of its range, since rays that meet no surface within it measure
/// nothing. Both throw InputError for a bad sensor, a share outside of (0, 1], a gap of 0 or less.
FieldOfView field_of_view(const DepthSensor& sensor, double share_of_range = 0.7);
/// Of a lidar: all around. So that rows are no farther apart than voxels at its end, `row_gap`
/// metres, if there is one, bounds its range.
FieldOfView field_of_view(const SpinningLidar& lidar, double share_of_range = 0.7,
                          double row_gap = std::numeric_limits<double>::infinity());

/// Where to look from, and which way.
struct Viewpoint {
  Point position = Point::Zero();  ///< metres, world
  double yaw = 0.0;                ///< radians
};

/// How the next viewpoint is chosen.
enum class ExplorationStrategy : std::uint8_t {
  kTour,     ///< the first of a tour over viewpoints that see all frontiers
  kNearest,  ///< the nearest along the roadmap that sees a frontier (Yamauchi 1997)
};

/// The robot, its sensor, and when a look is worth its way.
struct ExplorerConfig {
  MotionLimits motion = {.max_speed = 2.0, .max_acceleration = 2.0};  ///< of the robot
  FieldOfView view = {};  ///< of its sensor, which looks level along the yaw
  /// Voxels of the lattice that are to be explored.
  VoxelRange within = kAllVoxels;
  /// Voxels of a frontier that is worth a look: a smaller one, with all that it is joined to, is
  /// left alone.
  std::size_t least_frontier = 10;
  double spacing = 0.8;                                       ///< metres between viewpoints, about
  int headings = 16;                                          ///< directions that are tried at each
  ExplorationStrategy strategy = ExplorationStrategy::kTour;  ///< how the next viewpoint is chosen
  /// Seconds by which another tour must be shorter for the goal to be given up: what keeps the
  /// robot from turning back and forth between tours that are as good.
  double persistence = 1.5;
  /// The goal is given up once less than this share is left of what was to be seen from there.
  double resolved_below = 0.3;
  std::size_t most_rays = 3000;  ///< cast in one decision; what is left over waits for the next
  /// Of a tour: those that give most for the time (kNearest: the nearest); the others count when
  /// these are seen.
  std::size_t most_stops = 20;
  /// Metres to obstacles and the unknown that the rest of a trajectory must keep, by the newest
  /// map, or another one is looked for at once; 0: the roadmap's min_clearance. Less of it than
  /// that keeps noise on surfaces from stopping the robot.
  double kept_clearance = 0.0;
  /// Looks from different places, each in vain, after which an unknown voxel is left alone. One
  /// from where the robot stood to look at it counts twice; those in flight only from near.
  int most_looks = 6;
  std::optional<Point> home =
      std::nullopt;  ///< world: where to be at the end; none: wherever it ends
  /// Seconds, of the same clock as FlightState::time, until which to be home. Needs `home`.
  double until = std::numeric_limits<double>::infinity();
  /// Seconds from one decision to the next, where they count for `until`; a longer time that has
  /// passed between two counts from then on.
  double period = 0.0;

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// How the robot moves now. Metres, seconds, radians, world frame.
struct FlightState {
  double time = 0.0;                   ///< seconds, of any clock that runs forwards
  Point position = Point::Zero();      ///< metres, world
  Point velocity = Point::Zero();      ///< m/s
  Point acceleration = Point::Zero();  ///< m/s^2
  double yaw = 0.0;                    ///< radians
};

/// What the robot is to do now.
enum class ExplorationStatus : std::uint8_t {
  kFly,        ///< along the trajectory that is given, from now on
  kKeep,       ///< what was given before is as good
  kReturn,     ///< as kFly, home: all is seen, or it is time
  kComplete,   ///< at its end (home): no viewpoint sees a frontier
  kOutOfTime,  ///< home, or at rest, though there are frontiers that can be seen
  kStuck,      ///< at rest, and no way or trajectory leads on, or home
};
/// "fly", "keep", "return", "complete", "out_of_time", "stuck".
std::string_view name_of(ExplorationStatus status);

/// Processor time of the thread that asked.
struct ExplorationSeconds {
  double frontiers = 0.0;   ///< to follow what has changed
  double views = 0.0;       ///< to see what can be seen from where
  double tour = 0.0;        ///< to order the viewpoints
  double trajectory = 0.0;  ///< to plan and verify the flight
  double total = 0.0;       ///< all of these, and what lies between
};

/// What to do next, and what that is based on.
struct ExplorationStep {
  ExplorationStatus status = ExplorationStatus::kKeep;  ///< what the robot is to do
  /// Verified in known-free space, ends at rest; with yaw at a limited rate. Starts with the state
  /// that was given, at time 0. Empty unless kFly or kReturn.
  Trajectory trajectory;
  /// Where the next look is taken; none on the way home and at the end
  std::optional<Viewpoint> goal;
  std::vector<Viewpoint> tour;  ///< the stops that follow now, the goal first
  double tour_seconds = 0.0;    ///< estimate
  /// What was flown before is not free for certain any more. Where no trajectory is given then (and
  /// the robot flies), no verified one leads anywhere, nor to a stop: what is left is to brake by
  /// the robot's own means.
  bool was_in_doubt = false;
  bool is_braking = false;          ///< the trajectory does no more than stop the robot
  std::size_t frontiers = 0;        ///< clusters of the least size or more
  std::size_t frontier_voxels = 0;  ///< in them
  ExplorationSeconds seconds;       ///< what this decision took
};

/// Why a frontier stays as it is.
enum class UnseenReason : std::uint8_t {
  kTooNarrow,     ///< the widest known way there does not let the robot through
  kOutOfView,     ///< no place of the robot has it within range, angle and line of sight
  kLookedInVain,  ///< seen from several places, nothing was measured
  kNotVisited     ///< the exploration has not come to its end, and may see it yet
};
/// "too_narrow", "out_of_view", "looked_in_vain", "not_visited".
std::string_view name_of(UnseenReason reason);

/// What exploration leaves unseen, and why.
struct UnseenFrontier {
  Point centroid = Point::Zero();                  ///< world
  std::size_t voxels = 0;                          ///< free ones of the frontier
  UnseenReason reason = UnseenReason::kOutOfView;  ///< why it was left
  /// Of kTooNarrow: where the widest way there is narrowest.
  std::optional<Point> door = std::nullopt;
  /// Metres: the radius that would fit there, to be held against the roadmap's min_clearance, which
  /// has the margin in it; 0 where it is for another reason.
  double door_radius = 0.0;
};

/// Decides where a robot with a level depth sensor flies to map what it has not seen: from a
/// snapshot of the map, and how it moves now, to the next trajectory. Knows nothing of sensors,
/// clocks and threads; the same calls give the same answers.
///
/// Viewpoints stand on the roadmap's diagram, where clearance and view are widest, at most one in
/// each cube of the side `spacing`; where no diagram passes through a cube its widest traversable
/// voxel is one too, asked only for frontiers that no other sees. What is seen from each is found
/// by rays through known-free voxels; they are kept, and cast again where the map has changed.
/// Of a greedy cover of all frontiers by viewpoints with headings the stops that give most for the
/// time are ordered to a tour (nearest insertion, 2-opt and or-opt): by the mean time until what
/// they give is seen, and a little by the time of all, flown along the roadmap, turning included.
///
/// Complete means: no reachable viewpoint of these, at any heading, sees a target of a frontier of
/// at least the least size, but for targets that were looked at in vain.
class Explorer {
 public:
  explicit Explorer(const ExplorerConfig& config);  ///< Throws InputError naming the bad field.
  ~Explorer();
  Explorer(Explorer&&) noexcept;  ///< The one moved from can only be assigned to or destroyed.
  /// The one moved from can only be assigned to or destroyed.
  Explorer& operator=(Explorer&&) noexcept;

  /// What to do now; to be asked after every scan. `now`: of unknown space as an obstacle; the
  /// robot's radius is its min_clearance. The robot is taken to follow the last trajectory, from
  /// the time on at which that was given; once its end has passed, what was seen there must be in
  /// the map. A speed or acceleration up to a tenth above its limit counts as the limit. Throws
  /// InputError for one above that, a state that is not finite, a time that runs backwards, or a
  /// roadmap of another policy, or whose min_clearance is below kept_clearance.
  ExplorationStep decide(std::shared_ptr<const Roadmap> now, const FlightState& state);

  /// The frontiers of at least the least size that are left, what was looked at in vain too, each
  /// with its reason; looks through the whole map. Doors are looked for with unknown space taken
  /// for free, which what is not seen yet cannot make wider. Throws InputError where memory does
  /// not do for the box around the map.
  std::vector<UnseenFrontier> unseen() const;

  const Frontiers& frontiers() const;  ///< The frontiers of the map that was last decided on.

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ridgeway
