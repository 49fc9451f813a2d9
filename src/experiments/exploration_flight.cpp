// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration_flight.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/number_text.hpp"
#include "common/random.hpp"
#include "next_best_view.hpp"
#include "offline_tour.hpp"
#include "ridgeway/common/error.hpp"
#include "sensing/poses.hpp"
#include "viewable.hpp"

namespace ridgeway {
namespace {

constexpr double kPathStep = 0.02;  // seconds between places that are held against the world
constexpr double kAheadStep = 0.2;  // seconds between places that are shown

/// Voxels whose centres are in a ball.
std::vector<VoxelChange> free_ball(const Point& centre, double radius, double voxel_size) {
  const VoxelIndex low = voxel_at(centre - Point::Constant(radius), voxel_size);
  const VoxelIndex high = voxel_at(centre + Point::Constant(radius), voxel_size);
  std::vector<VoxelChange> changes;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if ((centre_of({x, y, z}, voxel_size) - centre).norm() <= radius)
          changes.push_back({{x, y, z}, VoxelState::kFree});
  return changes;
}

Box bounds_of(const World& world, const ExplorationFlightConfig& config) {
  if (config.bounds) return *config.bounds;
  const PoseSampling inside = sampling_inside(world);
  return {inside.low, inside.high};
}

void require_start(const World& world, const ExplorationFlightConfig& config, const Box& bounds) {
  const auto text_of = [](const Point& p) {
    return number_text(p.x()) + "," + number_text(p.y()) + "," + number_text(p.z());
  };
  const std::string place = "start " + text_of(config.start);
  constexpr double kFarthest = 4e8;  // voxels; places of maps are exact up to 5e8
  if (config.start.cwiseAbs().maxCoeff() > kFarthest * config.voxel_size)
    throw InputError(place, "is farther than 4e8 voxels from zero",
                     "move the world nearer to zero, or take larger voxels");
  if (!((config.start.array() >= bounds.min.array()).all() &&
        (config.start.array() <= bounds.max.array()).all()))
    throw InputError(place, "is outside of what is to be mapped",
                     "give a start between " + text_of(bounds.min) + " and " + text_of(bounds.max));
  const double room = surface_distance(world_at(world, 0.0), config.start).distance;
  const auto metres = [](double length) {
    return number_text(std::round(1e3 * length) / 1e3) + " m";
  };
  if (room < config.radius)
    throw InputError(
        place, room <= 0.0 ? "is inside an obstacle" : "is " + metres(room) + " from an obstacle",
        "give a start farther from obstacles than the radius, " + metres(config.radius));
  if (room >= config.free_radius()) return;
  const double least = std::ceil(100.0 * config.least_start_radius()) / 100.0;
  throw InputError(place,
                   "has " + metres(room) + " of free space around it, not the " +
                       metres(config.free_radius()) + " that are taken for free",
                   room < least
                       ? "give a start with more room: with this radius, margin and voxel size " +
                             metres(least) + " at least"
                       : "give a start with more room, a start radius from " + metres(least) +
                             " to " + metres(room) + ", or smaller voxels");
}

/// Images as a recording holds them: depths in steps of a fifth of a millimetre.
void round_depths(DepthImage& image) {
  for (float& depth : image.depth) depth = std::round(depth * 5000.0f) / 5000.0f;
}

class ExplorationRun {
 public:
  ExplorationRun(const World& world, const ExplorationFlightConfig& config, const Box& bounds,
                 const OnImage& on_image, const OnScan& on_scan)
      : world_(world),
        config_(config),
        on_image_(on_image),
        on_scan_(on_scan),
        within_(voxels_inside(bounds, config.voxel_size)),
        live_(live_config(config, !world.timed.empty())),
        viewable_(world_at(world, 0.0), config.voxel_size, within_, config.start,
                  config.clearance(), config.whole_view()),
        explorer_(explorer_config()),
        next_best_(explorer_config(), config.seed) {
    live_.set_voxels(free_ball(config.start, config.free_radius(), config.voxel_size));
    TrajectorySegment stand;
    stand.coefficients.col(0) << config.start, config.start_yaw;
    flying_.segments.push_back(stand);
    flight_.viewable_volume = viewable_.volume();
    if (flight_.viewable_volume == 0.0)
      throw InputError("bounds", "hold nothing that the sensor could see from where the drone fits",
                       "give larger bounds, or a sensor that reaches farther");
    if (config.planner == ExplorationPlanner::kOffline)
      offline_.emplace(world_at(world, 0.0), config.voxel_size, within_, config.clearance(),
                       config.max_distance, config.start, config.view(), config.explorer.motion,
                       viewable_);
  }

  ExplorationFlight run(const Progress& progress, const OnMoment& on_moment) {
    const double step = 1.0 / config_.scan_rate;
    for (std::size_t scan = 0; flight_.end == ExplorationStatus::kKeep; ++scan) {
      const double time = static_cast<double>(scan) * step;
      if (time > config_.longest) break;
      const FlightState state = state_at(time);
      look(state, scan);
      decide(state);
      if (on_moment)
        on_moment({live_.snapshot(), scan + 1, flight_.samples.back(), places_ahead(time)});
      if (progress && !progress(label(), flight_.samples.back().mapped)) throw Cancelled();
      if (flight_.end == ExplorationStatus::kKeep) follow(time, time + step);
    }
    finish();
    return std::move(flight_);
  }

 private:
  static LiveConfig live_config(const ExplorationFlightConfig& config, bool is_changing) {
    return {.fusion = {.voxel_size = config.voxel_size,
                       .min_range = std::max(0.1, config.min_range()),
                       .max_range = config.max_range(),
                       .forget_after = config.forget_after.value_or(is_changing ? 8 : 0)},
            .build = {.min_clearance = config.clearance(), .max_distance = config.max_distance},
            .origin = VoxelIndex{}};
  }

  ExplorerConfig explorer_config() const {
    ExplorerConfig explorer = config_.explorer;
    explorer.view = config_.view();
    explorer.within = within_;
    explorer.kept_clearance = config_.radius + 0.5 * (config_.clearance() - config_.radius);
    if (config_.come_back) explorer.home = config_.start;
    explorer.until = config_.budget;
    explorer.period = 1.0 / config_.scan_rate;
    explorer.strategy = config_.planner == ExplorationPlanner::kFrontier
                            ? ExplorationStrategy::kNearest
                            : ExplorationStrategy::kTour;
    return explorer;
  }

  FlightState state_at(double time) const {
    const TrajectoryState at = flying_.at(time - since_);
    return {time, at.position, at.velocity, at.acceleration, at.yaw};
  }

  std::vector<Point> places_ahead(double time) const {
    std::vector<Point> places;
    const double end = since_ + flying_.duration();
    for (double t = time; t < end; t += kAheadStep) places.push_back(state_at(t).position);
    places.push_back(state_at(std::max(time, end)).position);
    return places;
  }

  std::string label() const {
    const ExplorationSample& last = flight_.samples.back();
    return "explore " + std::to_string(static_cast<int>(last.state.time)) + " s, " +
           std::to_string(last.frontiers) + " frontiers";
  }

  void look(const FlightState& state, std::size_t scan) {
    const UpdateReport report = config_.lidar ? scan_around(state, scan) : take_image(state, scan);
    ExplorationSample sample;
    sample.state = state;
    sample.update_seconds = report.seconds;
    flight_.samples.push_back(sample);
  }

  UpdateReport take_image(const FlightState& state, std::size_t scan) {
    Eigen::Isometry3d pose = level_pose(state.position, state.yaw);
    pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
    DepthImage image = render_depth(world_at(world_, state.time), config_.sensor, pose,
                                    Random(config_.seed, scan).bits());
    round_depths(image);
    if (on_image_) on_image_(image, pose);
    return live_.integrate(image, config_.sensor.camera, pose);
  }

  UpdateReport scan_around(const FlightState& state, std::size_t scan) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(state.yaw, Eigen::Vector3d::UnitZ()));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn.normalized().toRotationMatrix();
    pose.translation() = state.position;
    std::vector<Point> points = scan_with(world_at(world_, state.time), *config_.lidar, pose,
                                          Random(config_.seed, scan).bits());
    for (Point& point : points) point = point.cast<float>().cast<double>();  // as it is recorded
    if (on_scan_) on_scan_(points, pose);
    return live_.integrate(points, pose);
  }

  ExplorationStep next_step(const std::shared_ptr<const Roadmap>& now, const FlightState& state) {
    if (offline_) return offline_->decide(*now, state);
    if (config_.planner == ExplorationPlanner::kNextBest) return next_best_.decide(now, state);
    return explorer_.decide(now, state);
  }

  void decide(const FlightState& state) {
    const std::shared_ptr<const Roadmap> now = live_.snapshot();
    ExplorationSample& sample = flight_.samples.back();
    if (!now) {
      flight_.end = ExplorationStatus::kStuck;
      return;
    }
    sample.mapped = static_cast<double>(viewable_.known_of(now)) /
                    std::max(1.0, static_cast<double>(viewable_.voxels()));
    const ExplorationStep step = next_step(now, state);
    ++flight_.decisions;
    sample.frontiers = step.frontiers;
    sample.seconds = step.seconds;
    flight_.doubts += step.was_in_doubt;
    flight_.brakes += step.is_braking;
    if (!step.trajectory.segments.empty()) {
      flying_ = step.trajectory;
      since_ = state.time;
      ++flight_.trajectories;
      flight_.stops += state.velocity.norm() < 1e-3;
    }
    if (step.status == ExplorationStatus::kComplete ||
        step.status == ExplorationStatus::kOutOfTime || step.status == ExplorationStatus::kStuck)
      flight_.end = step.status;
  }

  /// Holds the way from one time to another against the exact world.
  void follow(double from, double to) {
    World now = world_at(world_, from);
    const auto steps = static_cast<int>(std::ceil((to - from) / kPathStep));
    for (int i = 0; i < steps; ++i) {
      const double time = from + (to - from) * i / steps;
      if (i > 0 && !world_.timed.empty()) now = world_at(world_, time);
      const Point p = state_at(time).position;
      const double room = surface_distance(now, p).distance - config_.radius;
      flight_.nearest = std::min(flight_.nearest, room);
      flight_.collisions += room < 0.0;
      if (!flight_.path.empty()) flight_.length += (p - flight_.path.back()).norm();
      flight_.path.push_back(p);
    }
  }

  void finish() {
    if (flight_.path.empty())  // it has not left its start
      flight_.nearest =
          surface_distance(world_at(world_, 0.0), config_.start).distance - config_.radius;
    flight_.seconds = flight_.samples.back().state.time;
    flight_.coverage = flight_.samples.back().mapped;
    flight_.is_complete = flight_.end == ExplorationStatus::kComplete && config_.is_by_explorer();
    if (config_.is_by_explorer()) flight_.unseen = explorer_.unseen();
    flight_.map = live_.map();
    flight_.roadmap = live_.settled();
  }

  const World& world_;
  const ExplorationFlightConfig& config_;
  const OnImage& on_image_;
  const OnScan& on_scan_;
  const VoxelRange within_;
  LiveRoadmap live_;
  ViewableVolume viewable_;
  Explorer explorer_;
  NextBestView next_best_;
  std::optional<OfflineTour> offline_;
  Trajectory flying_;
  double since_ = 0.0;
  ExplorationFlight flight_;
};

}  // namespace

ExplorationFlight explore(const World& world, const ExplorationFlightConfig& config,
                          const Progress& progress, const OnImage& on_image,
                          const OnMoment& on_moment, const OnScan& on_scan) {
  config.validate();
  const Box bounds = bounds_of(world, config);
  if (!bounds.min.allFinite() || !bounds.max.allFinite())
    throw InputError(world.name, "has no enclosure", "give bounds");
  require_start(world, config, bounds);
  return ExplorationRun(world, config, bounds, on_image, on_scan).run(progress, on_moment);
}

}  // namespace ridgeway
