// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "any_angle_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "open_buckets.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kExpansionsBetweenLooksAtTheClock = 256;

double distance_between(const VoxelIndex& a, const VoxelIndex& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

class AnyAngleSearch {
 public:
  AnyAngleSearch(const FreeSpace& space, VoxelId start, VoxelId goal, double radius)
      : esdf_(space.map()),
        space_(space),
        start_(start),
        goal_(goal),
        target_(esdf_.layout.index_of(goal)),
        radius_(radius),
        threshold_(least_clearance(space.inner_radius(radius), esdf_.voxel_size)),
        blocks_(esdf_.layout.block_count()),
        open_(distance_between(esdf_.layout.index_of(start), target_)) {}

  LatticePath run(const Deadline& deadline) {
    improve(start_, {.cost = 0.0, .parent = start_});
    int expansions = 0;
    while (const std::optional<OpenBuckets::Entry> best = open_.pop(kInfinity)) {
      Node& node = at(best->voxel);
      if (node.is_closed || best->cost > node.cost) continue;
      if (++expansions % kExpansionsBetweenLooksAtTheClock == 0 && deadline.has_passed())
        return {SearchStatus::kTimeout, {}};
      if (!is_in_sight(node.parent, best->voxel)) step_from_a_neighbour(best->voxel, node);
      node.is_closed = true;
      if (best->voxel == goal_) return {SearchStatus::kFound, turns(), node.cost};
      look_around(best->voxel, node);
    }
    return {SearchStatus::kNoRoute, {}};
  }

 private:
  struct Node {
    double cost = kInfinity;    // voxels
    VoxelId parent = kNoVoxel;  // until the node is closed perhaps out of sight
    bool is_closed = false;
  };
  using Block = std::array<Node, kBlockVoxels>;

  Node& at(VoxelId id) {
    std::unique_ptr<Block>& block = blocks_[id / kBlockVoxels];
    if (!block) block = std::make_unique<Block>();
    return (*block)[id % kBlockVoxels];
  }

  bool is_traversable(VoxelId id) const {
    return esdf_.squared[id] >= threshold_ && esdf_.is_open(id) && space_.is_within_limits(id);
  }

  bool is_in_sight(VoxelId a, VoxelId b) const {
    return space_.is_free(centre_of(esdf_.layout.index_of(a), esdf_.voxel_size),
                          centre_of(esdf_.layout.index_of(b), esdf_.voxel_size), radius_);
  }

  void improve(VoxelId id, const Node& better) {
    at(id) = better;
    open_.push(better.cost + distance_between(esdf_.layout.index_of(id), target_),
               {better.cost, id});
  }

  /// Hopes that what the node's parent sees goes on to its neighbours.
  void look_around(VoxelId id, const Node& node) {
    const Node& parent = at(node.parent);
    const VoxelIndex from = esdf_.layout.index_of(node.parent);
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf_.layout.neighbour(id, d);
      if (d == kCentre || next == kNoVoxel || !is_traversable(next)) continue;
      const Node& there = at(next);
      if (there.is_closed) continue;
      const double cost = parent.cost + distance_between(from, esdf_.layout.index_of(next));
      if (cost < there.cost && space_.move_is_free(id, next, d, threshold_))
        improve(next, {.cost = cost, .parent = node.parent});
    }
  }

  /// The hope was vain: the cheapest way by a closed neighbour, such as the one that had it.
  void step_from_a_neighbour(VoxelId id, Node& node) {
    node.cost = kInfinity;
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf_.layout.neighbour(id, d);
      if (d == kCentre || next == kNoVoxel || !is_traversable(next) || !at(next).is_closed)
        continue;
      const double cost = at(next).cost + std::sqrt(static_cast<double>(squared_length(d)));
      if (cost >= node.cost || !space_.move_is_free(next, id, opposite(d), threshold_)) continue;
      node.cost = cost;
      node.parent = next;
    }
  }

  std::vector<VoxelId> turns() {
    std::vector<VoxelId> voxels{goal_};
    while (voxels.back() != start_) voxels.push_back(at(voxels.back()).parent);
    std::reverse(voxels.begin(), voxels.end());
    return voxels;
  }

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const VoxelId start_, goal_;
  const VoxelIndex target_;
  const double radius_;
  const SquaredHalves threshold_;
  std::vector<std::unique_ptr<Block>> blocks_;
  OpenBuckets open_;
};

}  // namespace

LatticePath search_any_angle(const FreeSpace& space, VoxelId start, VoxelId goal, double radius,
                             const Deadline& deadline) {
  return AnyAngleSearch(space, start, goal, radius).run(deadline);
}

}  // namespace ridgeway::detail
