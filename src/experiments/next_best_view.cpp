// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "next_best_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/clock.hpp"
#include "exploration/legs.hpp"
#include "planning/escape.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway {
namespace {

// As published.
constexpr double kLongestEdge = 1.0;     // metres
constexpr double kDegression = 0.5;      // per metre
constexpr std::size_t kNodes = 30;       // of a tree
constexpr std::size_t kMostTries = 200;  // where nothing has a gain
// Ours.
constexpr int kStride = 2;  // voxels between those that stand for the volume around them

/// Whether nothing occupied is between two places: unknown space is looked through.
bool is_clear(const EsdfMap& esdf, const Point& from, const Point& to) {
  const double length = (to - from).norm();
  const Eigen::Vector3d direction = (to - from) / length;
  VoxelFinder finder(esdf.layout);
  for (double t = 0.0; t < length; t += 0.7 * esdf.voxel_size) {
    const VoxelId id = finder.find(voxel_at(from + t * direction, esdf.voxel_size));
    if (id != kNoVoxel && esdf.state[id] == VoxelState::kOccupied) return false;
  }
  return true;
}

}  // namespace

NextBestView::NextBestView(const ExplorerConfig& config, std::uint64_t seed)
    : config_(config), random_(seed, 17) {}

double NextBestView::unknown_in_view(const EsdfMap& esdf, const Point& from, double yaw) const {
  const double s = esdf.voxel_size, range = config_.view.range;
  const VoxelIndex low = voxel_at(from - Point::Constant(range), s);
  const VoxelIndex high = voxel_at(from + Point::Constant(range), s);
  const double steepest = std::tan(0.5 * config_.view.vertical);
  const double across = std::cos(0.5 * config_.view.horizontal);
  const Eigen::Vector2d forward(std::cos(yaw), std::sin(yaw));
  double volume = 0.0;
  for (int z = low.z; z <= high.z; z += kStride)
    for (int y = low.y; y <= high.y; y += kStride)
      for (int x = low.x; x <= high.x; x += kStride) {
        const VoxelIndex voxel{x, y, z};
        if (!config_.within.contains(voxel + esdf.origin)) continue;
        const Eigen::Vector3d way = centre_of(voxel, s) - from;
        if (way.squaredNorm() > range * range) continue;
        const double level = way.head<2>().norm();
        const double depth = config_.view.is_all_around() ? level : way.head<2>().dot(forward);
        if (depth < level * across || std::abs(way.z()) > steepest * depth) continue;
        const VoxelId id = esdf.layout.find(voxel);
        if (id != kNoVoxel && esdf.state[id] != VoxelState::kUnknown) continue;
        if (is_clear(esdf, from, from + way)) volume += std::pow(kStride * s, 3);
      }
  return volume;
}

void NextBestView::add(const Roadmap& roadmap, std::vector<Node>& tree, std::size_t parent,
                       const Point& at, double yaw) const {
  const double way = tree[parent].way + (at - tree[parent].position).norm();
  const double gain =
      tree[parent].gain + unknown_in_view(roadmap.esdf, at, yaw) * std::exp(-kDegression * way);
  tree.push_back({at, yaw, parent, way, gain});
}

void NextBestView::grow(const Roadmap& roadmap, std::vector<Node>& tree) {
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  const double r = roadmap.min_clearance;
  // What was best and was not flown comes first.
  std::size_t parent = 0;
  for (const Viewpoint& kept : kept_) {
    const Point at = to_local(esdf, kept.position);
    if (!space.is_free(tree[parent].position, at, r)) break;
    add(roadmap, tree, parent, at, kept.yaw);
    parent = tree.size() - 1;
  }
  const VoxelRange known = known_range({.voxel_size = esdf.voxel_size,
                                        .origin = esdf.origin,
                                        .layout = esdf.layout,
                                        .state = esdf.state.shared()});
  const Point low = Point(known.min.x, known.min.y, known.min.z) * esdf.voxel_size;
  const Point high = Point(known.max.x + 1, known.max.y + 1, known.max.z + 1) * esdf.voxel_size;
  for (std::size_t i = 0; i < 50 * kMostTries && tree.size() <= kMostTries; ++i) {
    const bool has_gain =
        std::any_of(tree.begin(), tree.end(), [](const Node& node) { return node.gain > 0.0; });
    if (tree.size() > kNodes && has_gain) return;
    Point to;
    for (int axis = 0; axis < 3; ++axis) to[axis] = random_.uniform(low[axis], high[axis]);
    const double yaw = random_.uniform(-std::numbers::pi, std::numbers::pi);
    const auto nearest =
        std::min_element(tree.begin(), tree.end(), [&](const Node& a, const Node& b) {
          return (a.position - to).squaredNorm() < (b.position - to).squaredNorm();
        });
    const Eigen::Vector3d way = to - nearest->position;
    const Point at = nearest->position + way * std::min(1.0, kLongestEdge / way.norm());
    if (space.is_free(nearest->position, at, r))
      add(roadmap, tree, static_cast<std::size_t>(nearest - tree.begin()), at, yaw);
  }
}

/// Where the tree begins: at the robot or, where what was seen last is nearer to it than what it
/// has to keep from, at the nearest place that is free. None where there is no way out.
std::optional<Point> NextBestView::root_at(const Roadmap& roadmap, const Point& local) {
  const FreeSpace space(roadmap.esdf);
  if (space.is_free(local, roadmap.min_clearance)) return local;
  const detail::EscapeResult out =
      detail::find_escape(space, local, roadmap.min_clearance, detail::Deadline::never());
  if (out.status != detail::SearchStatus::kFound) return std::nullopt;
  return out.place;
}

/// The first edge of a branch, from rest to rest.
std::optional<Trajectory> NextBestView::fly(const Roadmap& roadmap, const FlightState& state,
                                            const Point& root, const Viewpoint& to) const {
  if (root != to_local(roadmap.esdf, state.position))
    return detail::fly_to_rest(  // what is left of its motion is rounding
        roadmap, config_.motion, to,
        {.time = state.time, .position = state.position, .yaw = state.yaw});
  const std::vector<Point> edge = {state.position, to.position};
  TrajectoryResult flown = plan_trajectory(
      roadmap.esdf, edge,
      {.radius = roadmap.min_clearance, .motion = config_.motion, .follow_yaw = false});
  if (!flown.ok()) return std::nullopt;
  detail::turn_to(flown.trajectory, state.yaw, to.yaw, config_.motion.max_yaw_rate);
  return std::move(flown.trajectory);
}

ExplorationStep NextBestView::decide(const std::shared_ptr<const Roadmap>& now,
                                     const FlightState& state) {
  ExplorationStep step;
  if (state.time < busy_until_ - 1e-9) return step;
  const double began = detail::thread_seconds_now();
  const EsdfMap& esdf = now->esdf;
  const std::optional<Point> root = root_at(*now, to_local(esdf, state.position));
  if (!root) {
    step.status = ExplorationStatus::kStuck;
    step.seconds.total = detail::thread_seconds_now() - began;
    return step;
  }
  std::vector<Node> tree = {{*root, state.yaw, 0, 0.0, 0.0}};
  grow(*now, tree);
  const auto best = std::max_element(tree.begin(), tree.end(),
                                     [](const Node& a, const Node& b) { return a.gain < b.gain; });
  step.status = tree.size() > 1 ? ExplorationStatus::kComplete : ExplorationStatus::kStuck;
  if (best->gain > 0.0) {
    std::vector<Viewpoint> branch;
    for (auto i = static_cast<std::size_t>(best - tree.begin()); i != 0; i = tree[i].parent)
      branch.insert(branch.begin(), {to_world(esdf, tree[i].position), tree[i].yaw});
    std::optional<Trajectory> flown = fly(*now, state, *root, branch.front());
    kept_.clear();
    step.status = ExplorationStatus::kKeep;
    if (flown) {
      kept_.assign(branch.begin() + 1, branch.end());
      step.status = ExplorationStatus::kFly;
      step.trajectory = std::move(*flown);
      busy_until_ = state.time + step.trajectory.duration();
    }
  }
  step.seconds.total = detail::thread_seconds_now() - began;
  return step;
}

}  // namespace ridgeway
