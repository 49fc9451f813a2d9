// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>

#include "explorer_state.hpp"
#include "planning/endpoint.hpp"
#include "ridgeway/exploration/explorer.hpp"

namespace ridgeway {
namespace {

/// The widest of the free voxels of a part's block that touch its targets.
VoxelId free_voxel_of(const EsdfMap& esdf, const FrontierPart& part) {
  return esdf.layout.find(part.first);
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
  for (const FrontierCluster& cluster : state.frontiers.clusters()) {
    if (cluster.voxels < state.config.least_frontier) continue;
    UnseenFrontier found = {to_world(esdf, cluster.centroid), cluster.voxels};
    std::size_t looked_at = 0, targets = 0;
    for (const std::size_t i : cluster.parts)
      for (const VoxelIndex& target : state.frontiers.parts()[i].targets) {
        ++targets;
        looked_at += state.looks.contains(target) ? 1 : 0;
      }
    if (2 * looked_at > targets) found.reason = UnseenReason::kLookedInVain;
    if (home.voxel != kNoVoxel) {
      if (!parts) parts.emplace(esdf);
      const VoxelId voxel = free_voxel_of(esdf, state.frontiers.parts()[cluster.parts[0]]);
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
