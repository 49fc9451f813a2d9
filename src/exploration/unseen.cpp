// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <limits>

#include "explorer_state.hpp"
#include "planning/endpoint.hpp"
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

}  // namespace

std::vector<UnseenFrontier> Explorer::unseen() const {
  const State& state = *state_;
  std::vector<UnseenFrontier> unseen;
  if (!state.roadmap) return unseen;
  const EsdfMap& esdf = state.roadmap->esdf;
  const double radius = state.roadmap->min_clearance;
  std::optional<SpaceParts> parts;
  const auto home = state.config.home
                        ? detail::find_endpoint(esdf, to_local(esdf, *state.config.home), radius)
                        : detail::Endpoint{};
  const std::vector<VoxelId> views = widest_views_of(*state.roadmap, state.frontiers, state.config);
  for (std::size_t c = 0; c < state.frontiers.clusters().size(); ++c) {
    const FrontierCluster& cluster = state.frontiers.clusters()[c];
    if (cluster.voxels < state.config.least_frontier) continue;
    UnseenFrontier found = {to_world(esdf, cluster.centroid), cluster.voxels};
    if (!state.has_seen_all) found.reason = UnseenReason::kNotVisited;
    std::size_t looked_at = 0, targets = 0;
    for (const std::size_t i : cluster.parts)
      for (const VoxelIndex& target : state.frontiers.parts()[i].targets) {
        ++targets;
        looked_at += state.looks.contains(target) ? 1 : 0;
      }
    if (2 * looked_at > targets) found.reason = UnseenReason::kLookedInVain;
    if (home.voxel != kNoVoxel) {
      if (!parts) parts.emplace(esdf);
      const FrontierPart& part = state.frontiers.parts()[cluster.parts[0]];
      const VoxelId voxel = views[c] != kNoVoxel ? views[c] : esdf.layout.find(part.first);
      const std::optional<Pass> pass = parts->narrowest_move(home.voxel, voxel);
      if (pass) {
        const SpaceParts::Narrow narrow = parts->look_at(*pass);
        const double width = pass->clearance.metres(esdf.voxel_size);
        if (width < radius && narrow.by == Blocker::kObstacle) {
          found.reason = UnseenReason::kTooNarrow;
          found.door = narrow.place;
          found.door_radius = width;
        }
      }
    }
    unseen.push_back(found);
  }
  return unseen;
}

}  // namespace ridgeway
