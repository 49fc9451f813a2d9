// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <iterator>

#include "bounded_hub_labels.hpp"
#include "common/require.hpp"
#include "corner_links.hpp"
#include "corner_regions.hpp"
#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway {
namespace {

using detail::Corner;
using detail::kPlanning;
using detail::MergedCorners;
using detail::SampledPath;

/// The widest traversable voxel of a block, the first of equally wide ones, or kNoVoxel.
VoxelId widest_of_block(const Roadmap& roadmap, std::uint32_t slot) {
  const std::uint32_t* const squared = roadmap.esdf.squared.block(slot);
  const Direction* const next = roadmap.attach.next.block(slot);
  std::array<std::uint32_t, kBlockVoxels> widths;  // 0: not traversable
  std::uint32_t most = 0;
  for (VoxelId i = 0; i < kBlockVoxels; ++i) {
    widths[i] = next[i] == AttachField::kNotTraversable ? 0 : squared[i];
    most = std::max(most, widths[i]);
  }
  if (most == 0) return kNoVoxel;
  const auto first = std::find(widths.begin(), widths.end(), most) - widths.begin();
  return slot * kBlockVoxels + static_cast<VoxelId>(first);
}

/// The widest traversable voxel of every region, the first of equally wide ones, or kNoVoxel.
std::vector<VoxelId> widest_of_regions(const Roadmap& roadmap, const BlockRegions& regions) {
  const EsdfMap& esdf = roadmap.esdf;
  std::vector<VoxelId> of_block(esdf.layout.block_count()), widest(regions.count, kNoVoxel);
  parallel_for_each_index(
      of_block.size(),
      [&](std::size_t slot) {
        of_block[slot] = widest_of_block(roadmap, static_cast<std::uint32_t>(slot));
      },
      64);
  for (std::uint32_t rank = 0; rank < of_block.size(); ++rank) {
    const std::uint32_t slot = esdf.layout.slot_at(rank);
    VoxelId& best = widest[regions.region_of_block[slot]];
    const VoxelId own = of_block[slot];
    if (own != kNoVoxel && (best == kNoVoxel || esdf.squared[own] > esdf.squared[best])) best = own;
  }
  return widest;
}

/// The corners that can be seen from a place and that a tight path from there may turn at.
std::vector<VertexId> look_around(const FreeSpace& space, double radius,
                                  const std::vector<Corner>& corners, const Point& place) {
  std::vector<VertexId> seen;
  for (const std::uint32_t i : detail::nearest_corners(
           corners, place, kPlanning.looked_at,
           [&](std::uint32_t j) { return detail::may_turn(corners[j], place); })) {
    if (!space.is_free(place, corners[i].place, radius)) continue;
    seen.push_back(VertexId{i});
    if (seen.size() == TangentGraph::kMostSeen) break;
  }
  return seen;
}

/// Learns corners, each time from as many paths as before, until it knows the way of most new ones.
class Learning {
 public:
  explicit Learning(const Roadmap& roadmap)
      : roadmap_(roadmap), space_(roadmap.esdf), merging_(roadmap, roadmap.min_clearance) {
    BlockRegions regions = number_regions(roadmap.esdf.layout);
    widest_ = widest_of_regions(roadmap, regions);
    tangent_.region_of_block = std::move(regions.region_of_block);
  }

  TangentGraph run(std::size_t most_pairs) {
    std::size_t enough = kPlanning.first_pairs;
    while (enough + kPlanning.asked_pairs <= most_pairs) {
      learn(sample(enough - pairs_));
      if (!link()) break;
      const double known = ask_and_learn();
      if (known < kPlanning.hopeless) break;
      enough = 2 * pairs_;
      if (known < kPlanning.known) continue;
      if (!link()) break;
      auto hubs = detail::label_hubs_within(tangent_.graph);
      if (!hubs) break;
      tangent_.hubs = *std::move(hubs);
      list_seen();
      return std::move(tangent_);
    }
    return {};  // too much to learn: queries had better not rely on it
  }

 private:
  std::vector<SampledPath> sample(std::size_t pairs) {
    pairs_ += pairs;
    return detail::sample_paths(roadmap_, pairs_ - pairs, pairs);
  }

  void learn(const std::vector<SampledPath>& paths) {
    for (const SampledPath& path : paths) merging_.add(path);
  }

  /// Of the paths between new pairs of places, the share for which there is a route about as short,
  /// and learns them. Where that is hopeless it learns none, and stops asking once that is certain.
  /// Nothing is known where there are next to no paths.
  double ask_and_learn() {
    constexpr std::size_t kAtOnce = 20;  // pairs, for all threads
    const std::size_t end = pairs_ + kPlanning.asked_pairs;
    std::vector<SampledPath> paths;
    std::size_t unknown = 0;
    while (pairs_ < end) {
      std::vector<SampledPath> some = sample(std::min(kAtOnce, end - pairs_));
      unknown += count_unknown(some);
      if (static_cast<double>(unknown) > (1.0 - kPlanning.hopeless) * kPlanning.asked_pairs)
        return 0.0;
      std::move(some.begin(), some.end(), std::back_inserter(paths));
    }
    if (5 * paths.size() < kPlanning.asked_pairs) return 0.0;
    const double known =
        static_cast<double>(paths.size() - unknown) / static_cast<double>(paths.size());
    if (known >= kPlanning.hopeless) learn(paths);
    return known;
  }

  /// False where there are too many.
  bool link() {
    const MergedCorners merged = merging_.merged();
    corners_ = detail::corners_of(roadmap_, merged);
    if (corners_.size() > TangentGraph::kMostCorners) return false;
    tangent_.graph = detail::link_corners(roadmap_, merged, corners_);
    return true;
  }

  std::size_t count_unknown(const std::vector<SampledPath>& paths) const {
    std::vector<char> is_known(paths.size());
    parallel_for_each_index(paths.size(), [&](std::size_t i) { is_known[i] = knows(paths[i]); });
    return static_cast<std::size_t>(std::count(is_known.begin(), is_known.end(), 0));
  }

  /// Whether there is a route about as short as a path.
  bool knows(const SampledPath& path) const {
    const double enough = kPlanning.as_found * length_of(path.waypoints);
    const Point &start = path.waypoints.front(), &goal = path.waypoints.back();
    const double radius = roadmap_.min_clearance;
    Sources first;
    for (const VertexId v : seen_from_region(path.from))
      if (const Point& corner = corners_[number(v)].place; space_.is_free(start, corner, radius))
        first.emplace_back(v, (corner - start).norm());
    const std::vector<double> lengths = lengths_from(tangent_.graph, first, radius);
    const std::vector<VertexId> last = seen_from_region(path.to);
    return std::any_of(last.begin(), last.end(), [&](VertexId v) {
      const Point& corner = corners_[number(v)].place;
      return lengths[number(v)] + (goal - corner).norm() <= enough &&
             space_.is_free(corner, goal, radius);
    });
  }

  std::vector<VertexId> seen_from_region(VoxelId voxel) const {
    const VoxelId widest = widest_[tangent_.region_of_block[voxel / kBlockVoxels]];
    return look_around(space_, roadmap_.min_clearance, corners_, place_of(widest));
  }

  /// Only corners of the region's own part: a segment may slip through where moves from voxel to
  /// voxel cannot, and what there is a path to shall not depend on who is asked. Regions with
  /// more than one part list none.
  void list_seen() {
    const std::vector<detail::Part> parts =
        detail::parts_of_regions(roadmap_, tangent_.region_of_block, widest_.size());
    std::vector<std::vector<VertexId>> seen(widest_.size());
    parallel_for_each_index(seen.size(), [&](std::size_t region) {
      if (widest_[region] == kNoVoxel || parts[region] >= detail::kNoPart) return;
      seen[region] =
          look_around(space_, roadmap_.min_clearance, corners_, place_of(widest_[region]));
      std::erase_if(seen[region],
                    [&](VertexId v) { return corners_[number(v)].part != parts[region]; });
    });
    tangent_.first_seen.push_back(0);
    for (const std::vector<VertexId>& own : seen) {
      tangent_.seen.insert(tangent_.seen.end(), own.begin(), own.end());
      tangent_.first_seen.push_back(static_cast<std::uint32_t>(tangent_.seen.size()));
    }
  }

  Point place_of(VoxelId id) const {
    return centre_of(roadmap_.esdf.layout.index_of(id), roadmap_.esdf.voxel_size);
  }

  const Roadmap& roadmap_;
  const FreeSpace space_;
  detail::CornerMerging merging_;
  std::size_t pairs_ = 0;        // of places that paths were sampled between
  std::vector<VoxelId> widest_;  // by region
  std::vector<Corner> corners_;
  TangentGraph tangent_;
};

}  // namespace

void TangentConfig::validate() const {
  constexpr std::size_t kMostPairs = 1000000;
  detail::require(tangent_pairs <= kMostPairs, "tangent_pairs", tangent_pairs,
                  "give at most a million, or 0 for no tangent graph");
}

TangentGraph build_tangent_graph(const Roadmap& roadmap, const TangentConfig& config) {
  config.validate();
  return Learning(roadmap).run(config.tangent_pairs);
}

}  // namespace ridgeway
