// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <limits>

#include "explorer_state.hpp"
#include "planning/endpoint.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/exploration/explorer.hpp"

namespace ridgeway {
namespace {

/// Traversable voxels, by cluster, from which some of it would be seen: the widest. None for
/// others.
std::vector<VoxelId> widest_views_of(const Roadmap& roadmap, const Frontiers& frontiers,
                                     const ExplorerConfig& config) {
  const std::vector<detail::Place> places = detail::widest_places(roadmap, config.spacing);
  detail::Views views(config.view, config.headings, config.within, 0.0);
  views.update(roadmap, frontiers, config.least_frontier, places, Point::Zero(),
               std::numeric_limits<std::size_t>::max(), true);
  std::vector<VoxelId> widest(frontiers.clusters().size(), kNoVoxel);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const detail::Sight& sight : views.from_places()[i]) {
      VoxelId& best = widest[frontiers.parts()[sight.part].cluster];
      const VoxelId voxel = roadmap.esdf.layout.find(places[i].voxel);
      if (best == kNoVoxel || roadmap.esdf.squared[voxel] > roadmap.esdf.squared[best])
        best = voxel;
    }
  return widest;
}

/// Where the widest way between two places is too narrow for the robot, taking unknown space for
/// free: so nothing that is still to be seen can make it wider.
class Doors {
 public:
  explicit Doors(const Roadmap& roadmap)
      : radius_(roadmap.min_clearance),
        esdf_(compute_esdf(
            occupancy_of(roadmap.esdf),
            {.unknown = UnknownPolicy::kFree, .max_distance = roadmap.esdf.max_distance})),
        parts_(esdf_) {}

  /// 0 beyond the box around the map.
  double clearance(const VoxelIndex& voxel) const {
    const VoxelId id = esdf_.layout.find(voxel);
    return id == kNoVoxel ? 0.0 : esdf_.known_squared(id).metres(esdf_.voxel_size);
  }

  struct Door {
    Point place;   ///< world
    double width;  ///< radius that fits, metres
  };
  /// Nothing where the robot fits on no place at the way's end: that says nothing about the way.
  std::optional<Door> between(const VoxelIndex& home, const VoxelIndex& end) const {
    if (clearance(end) < radius_) return std::nullopt;
    const auto pass = parts_.narrowest_move(esdf_.layout.find(home), esdf_.layout.find(end));
    if (!pass || pass->clearance.metres(esdf_.voxel_size) >= radius_) return std::nullopt;
    const SpaceParts::Narrow narrow = parts_.look_at(*pass);
    return Door{narrow.place, pass->clearance.metres(esdf_.voxel_size)};
  }

  /// Of the unknown voxels of a frontier the one with most room.
  VoxelIndex widest_target(const Frontiers& frontiers, const FrontierCluster& cluster) const {
    VoxelIndex widest = frontiers.parts()[cluster.parts[0]].first;
    for (const std::size_t i : cluster.parts)
      for (const VoxelIndex& target : frontiers.parts()[i].targets)
        if (clearance(target) > clearance(widest)) widest = target;
    return widest;
  }

 private:
  const double radius_;
  const EsdfMap esdf_;
  const SpaceParts parts_;
};

}  // namespace

std::vector<UnseenFrontier> Explorer::unseen() const {
  const State& state = *state_;
  std::vector<UnseenFrontier> unseen;
  if (!state.roadmap) return unseen;
  const EsdfMap& esdf = state.roadmap->esdf;
  std::optional<Doors> doors;
  const auto home = state.config.home
                        ? detail::find_endpoint(esdf, to_local(esdf, *state.config.home),
                                                state.roadmap->min_clearance)
                        : detail::Endpoint{};
  Frontiers frontiers(state.config.within);  // with what was looked at in vain
  frontiers.update(state.roadmap);
  std::vector<VoxelId> views;  // of clusters, made with the doors
  for (std::size_t c = 0; c < frontiers.clusters().size(); ++c) {
    detail::stop_if_cancelled();
    const FrontierCluster& cluster = frontiers.clusters()[c];
    if (cluster.voxels < state.config.least_frontier) continue;
    UnseenFrontier found = {to_world(esdf, cluster.centroid), cluster.voxels};
    if (!state.has_seen_all) found.reason = UnseenReason::kNotVisited;
    std::size_t looked_at = 0, targets = 0;
    for (const std::size_t i : cluster.parts)
      for (const VoxelIndex& target : frontiers.parts()[i].targets) {
        ++targets;
        const auto looks = state.looks.find(target);
        looked_at += looks != state.looks.end() && looks->second >= state.config.most_looks ? 1 : 0;
      }
    if (2 * looked_at > targets) {
      found.reason = UnseenReason::kLookedInVain;
    } else if (state.has_seen_all && home.voxel != kNoVoxel) {
      if (!doors) {
        doors.emplace(*state.roadmap);
        views = widest_views_of(*state.roadmap, frontiers, state.config);
      }
      const VoxelIndex end = views[c] != kNoVoxel ? esdf.layout.index_of(views[c])
                                                  : doors->widest_target(frontiers, cluster);
      if (const auto door = doors->between(esdf.layout.index_of(home.voxel), end)) {
        found.reason = UnseenReason::kTooNarrow;
        found.door = door->place;
        found.door_radius = door->width;
      }
    }
    unseen.push_back(found);
  }
  return unseen;
}

}  // namespace ridgeway
