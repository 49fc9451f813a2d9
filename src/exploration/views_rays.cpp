// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <numeric>

#include "ray_walk.hpp"
#include "ridgeway/common/parallel.hpp"
#include "views.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::size_t kTargets = 6;       // of a part, that are looked at
constexpr std::size_t kMostTargets = 64;  // that coverage tells apart
constexpr std::size_t kNearPlaces = 24;   // that are asked for every part
constexpr std::size_t kFarPlaces = 64;    // and where none of these sees it

}  // namespace

/// Calls visit(candidate) for the places that are asked for a part, as long as it says true.
template <typename Visit>
void Views::for_each_asked(PartViews& views, const Visit& visit) const {
  bool is_seen = false;
  std::size_t asked = 0;
  for (Candidate& candidate : views.candidates) {
    if (!views.thorough && asked >= (is_seen ? kNearPlaces : kFarPlaces)) return;
    ++asked;
    const auto& banned = views.banned;
    if (!banned.empty() &&
        std::find(banned.begin(), banned.end(), places_[candidate.place].id) != banned.end())
      continue;
    if (!visit(candidate)) return;
    if (candidate.cached >= 0 &&
        !views.cached[static_cast<std::size_t>(candidate.cached)].rays.empty())
      is_seen = true;
  }
}

std::size_t Views::looks_at(const FrontierPart& part, const PartViews& views) {
  return views.thorough ? part.targets.size() : std::min(part.targets.size(), kTargets);
}

/// That it takes to serve a part, whatever is seen of it.
std::size_t Views::most_rays_of(const FrontierPart& part, const PartViews& views) {
  const std::size_t asked =
      views.thorough ? views.candidates.size() : std::min(views.candidates.size(), kFarPlaces);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < asked; ++i) {
    const std::int32_t cached = views.candidates[i].cached;
    missing += cached < 0 || views.cached[static_cast<std::size_t>(cached)].is_stale ? 1 : 0;
  }
  return missing * looks_at(part, views);
}

/// Casts the rays that are missing of a part, as long as there are some left.
bool Views::serve(const Roadmap& roadmap, const FrontierPart& part, PartViews& views,
                  std::size_t& rays_left) const {
  bool is_served = true;
  for_each_asked(views, [&](Candidate& candidate) {
    is_served = look(roadmap, part, candidate, views, rays_left);
    return is_served;
  });
  if (is_served) views.served = updates_ + 1;
  return is_served;
}

/// The same part by part; at a time as many parts as rays suffice for whatever is seen of them, so
/// that it does not depend on the others what a part gets.
bool Views::serve(const Roadmap& roadmap, std::span<const FrontierPart> parts,
                  std::span<const Waiting> waiting, std::size_t& rays_left) const {
  std::vector<std::size_t> most, left;
  for (std::size_t begin = 0; begin < waiting.size(); begin += most.size()) {
    most.clear();
    for (std::size_t i = begin, sum = 0; i < waiting.size(); ++i) {
      const std::size_t rays = most_rays_of(parts[waiting[i].part], *waiting[i].views);
      if (sum + rays > rays_left) break;
      sum += rays;
      most.push_back(rays);
    }
    if (most.empty()) {
      const Waiting& next = waiting[begin];
      most.push_back(0);
      if (!serve(roadmap, parts[next.part], *next.views, rays_left)) return false;
      continue;
    }
    left = most;
    parallel_for_each_index(most.size(), [&](std::size_t i) {
      const Waiting& next = waiting[begin + i];
      serve(roadmap, parts[next.part], *next.views, left[i]);
    });
    for (std::size_t i = 0; i < most.size(); ++i) rays_left -= most[i] - left[i];
  }
  return true;
}

/// What is seen of a part from a place, if that is not known; false where rays do not suffice.
bool Views::look(const Roadmap& roadmap, const FrontierPart& part, Candidate& candidate,
                 PartViews& views, std::size_t& rays_left) const {
  if (candidate.cached >= 0 && !views.cached[static_cast<std::size_t>(candidate.cached)].is_stale)
    return true;
  const Point& from = places_[candidate.place].position;
  const std::size_t count = part.targets.size();
  const std::size_t looks = looks_at(part, views);
  if (rays_left < looks) return false;
  if (candidate.cached < 0) {
    candidate.cached = static_cast<std::int32_t>(views.cached.size());
    views.cached.emplace_back();
  }
  Cached& cached = views.cached[static_cast<std::size_t>(candidate.cached)];
  cached.rays.clear();
  cached.is_stale = false;
  cached.all_seen = true;
  for (std::size_t i = 0; i < looks; ++i) {
    const VoxelIndex& target = part.targets[i * count / looks];
    const Point centre = centre_of(target, roadmap.esdf.voxel_size);
    const std::uint32_t headings = headings_to(from, centre);
    if (headings == 0) continue;  // does not depend on the map
    --rays_left;
    if (sees(roadmap.esdf, from, target))
      cached.rays.push_back(
          {headings, static_cast<std::uint8_t>(i % kMostTargets),
           static_cast<float>(static_cast<double>(part.voxels) *
                              share_from((centre - from).norm()) / static_cast<double>(looks))});
    else
      cached.all_seen = false;
  }
  return true;
}

/// What is seen from each place, of all that is known of that.
void Views::gather(std::span<const Waiting> waiting) {
  from_places_.resize(places_.size());
  for (std::vector<Sight>& sights : from_places_) sights.clear();
  for (const Waiting& next : waiting)
    for_each_asked(*next.views, [&](const Candidate& candidate) {
      if (candidate.cached < 0) return true;
      const Cached& cached = next.views->cached[static_cast<std::size_t>(candidate.cached)];
      if (!cached.rays.empty())
        from_places_[candidate.place].push_back({next.part, cached.rays, next.views->worth});
      return true;
    });
  for (std::vector<Sight>& sights : from_places_)
    std::sort(sights.begin(), sights.end(),
              [](const Sight& a, const Sight& b) { return a.part < b.part; });
}

double Views::gain_now(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
                       const Place& place, int heading) const {
  const double reach = view_.range + kBlockSide * roadmap.esdf.voxel_size;
  std::vector<const FrontierPart*> near;
  for (const FrontierPart& part : frontiers.parts())
    if (frontiers.clusters()[part.cluster].voxels >= least &&
        (part.centroid - place.position).squaredNorm() <= reach * reach && !is_banned(place, part))
      near.push_back(&part);
  std::vector<double> gains(near.size(), 0.0);
  parallel_for_each_index(near.size(), [&](std::size_t n) {
    const FrontierPart& part = *near[n];
    const std::size_t count = part.targets.size(), looks = std::min(count, kTargets);
    double seen = 0.0;
    for (std::size_t i = 0; i < looks; ++i) {
      const VoxelIndex& target = part.targets[i * count / looks];
      const Point centre = centre_of(target, roadmap.esdf.voxel_size);
      if ((headings_to(place.position, centre) >> heading & 1) != 0 &&
          sees(roadmap.esdf, place.position, target))
        seen += share_from((centre - place.position).norm());
    }
    if (seen > 0.0)
      gains[n] = static_cast<double>(part.voxels) * seen / static_cast<double>(looks) *
                 depth_behind(roadmap.esdf, within_, part, deepest_);
  });
  return std::accumulate(gains.begin(), gains.end(), 0.0);
}

}  // namespace ridgeway::detail
