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

/// Where the widest way between two places, through space that is known to be free, is too narrow
/// for the robot by what is known to be occupied: nothing that is still to be seen makes it wider.
/// (Ways through unknown space are no answer: nobody has seen all of a wall.)
class Doors {
 public:
  explicit Doors(const Roadmap& roadmap)
      : radius_(roadmap.min_clearance),
        if_free_(distances(roadmap, UnknownPolicy::kFree)),
        known_(distances(roadmap, UnknownPolicy::kIgnore)),
        parts_(known_) {}

  struct Door {
    Point place;   ///< world
    double width;  ///< radius that fits, metres
  };
  std::optional<Door> between(const VoxelIndex& home, const VoxelIndex& end) const {
    const auto pass = parts_.narrowest_move(known_.layout.find(home), known_.layout.find(end));
    if (!pass || pass->clearance.metres(known_.voxel_size) >= radius_) return std::nullopt;
    return Door{parts_.look_at(*pass).place, pass->clearance.metres(known_.voxel_size)};
  }

  /// The free voxel of a frontier beside the unknown one with most room for all that is known;
  /// nothing where the robot would not fit there even if it were free.
  std::optional<VoxelIndex> widest_of(const Frontiers& frontiers,
                                      const FrontierCluster& cluster) const {
    std::optional<VoxelIndex> widest;
    double room = 0.0;
    for (const std::size_t i : cluster.parts)
      for (const VoxelIndex& target : frontiers.parts()[i].targets) {
        const VoxelId id = if_free_.layout.find(target);
        const double clearance =
            id == kNoVoxel ? 0.0 : if_free_.known_squared(id).metres(if_free_.voxel_size);
        if (clearance < radius_ || clearance <= room) continue;
        for (const Direction d : kFaceDirections)
          if (known_.is_open(known_.layout.find(target + offset_of(d)))) {
            room = clearance;
            widest = target + offset_of(d);
          }
      }
    return widest;
  }

 private:
  static EsdfMap distances(const Roadmap& roadmap, UnknownPolicy unknown) {
    return compute_esdf(occupancy_of(roadmap.esdf),
                        {.unknown = unknown, .max_distance = roadmap.esdf.max_distance});
  }

  const double radius_;
  const EsdfMap if_free_, known_;
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
      const VoxelIndex from = esdf.layout.index_of(home.voxel);
      std::optional<Doors::Door> door;
      if (views[c] != kNoVoxel) door = doors->between(from, esdf.layout.index_of(views[c]));
      const auto end = door ? std::nullopt : doors->widest_of(frontiers, cluster);
      if (end) door = doors->between(from, *end);
      if (door) {
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
