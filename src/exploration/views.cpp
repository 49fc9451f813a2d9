// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "views.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "ray_walk.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kEdge = 0.97;  // of the angles of view: what is at the edge may be missed

Bounds bounds_of(const BlockIndex& block, double voxel_size) {
  const double side = kBlockSide * voxel_size;
  const Point low = Point(block.x, block.y, block.z) * side;
  return {low, low + Point::Constant(side)};
}

}  // namespace

Views::Views(const FieldOfView& view, int headings, const VoxelRange& within, double deepest)
    : view_(view),
      headings_(headings),
      within_(within),
      deepest_(deepest),
      steepest_(std::tan(0.5 * kEdge * view.vertical)),
      steepest_to_edge_(std::tan(0.5 * view.vertical)),
      least_cosine_(std::cos(0.5 * kEdge * view.horizontal)) {
  for (int heading = 0; heading < headings; ++heading)
    forward_.emplace_back(std::cos(yaw_of(heading)), std::sin(yaw_of(heading)));
}

double Views::yaw_of(int heading) const {
  return std::remainder(2.0 * std::numbers::pi * heading / headings_, 2.0 * std::numbers::pi);
}

int Views::heading_of(double yaw) const {
  const int heading =
      static_cast<int>(std::lround(yaw * headings_ / (2.0 * std::numbers::pi))) % headings_;
  return heading < 0 ? heading + headings_ : heading;
}

std::uint32_t Views::headings_to(const Point& from, const Point& target) const {
  const Eigen::Vector3d way = target - from;
  const double squared = way.squaredNorm();
  if (squared > view_.range * view_.range || squared < view_.nearest * view_.nearest) return 0;
  const double level = std::sqrt(way.x() * way.x() + way.y() * way.y());
  const double rise = std::abs(way.z());
  if (rise > steepest_ * level) return 0;
  if (view_.is_all_around()) return ~0u;  // each heading is as good
  std::uint32_t bits = 0;
  for (std::size_t heading = 0; heading < forward_.size(); ++heading) {
    const double depth = way.x() * forward_[heading].x() + way.y() * forward_[heading].y();
    if (depth >= level * least_cosine_ && rise <= steepest_ * depth) bits |= 1u << heading;
  }
  return bits;
}

/// The share of a frontier voxel's worth that is expected to be measured from so far off. Free
/// space is measured up to a surface alone, which has to be in range: the less of the range is left
/// behind a voxel, the rarer there is one.
double Views::share_from(double distance) const {
  constexpr double kLeast = 0.1;  // whatever is in view counts
  const double share = distance / view_.range;
  return std::max(1.0 - share * share, kLeast);
}

void Views::ban(const Place& place, const FrontierPart& part) {
  banned_[{part.first, part.version}].push_back(place.id);
  const auto found = of_part_.find(part.first);
  if (found != of_part_.end() && found->second.version == part.version)
    found->second.banned.push_back(place.id);
}

bool Views::is_banned(const Place& place, const FrontierPart& part) const {
  const auto found = banned_.find({part.first, part.version});
  return found != banned_.end() &&
         std::find(found->second.begin(), found->second.end(), place.id) != found->second.end();
}

void Views::note_changes(const Roadmap& roadmap, const Frontiers& frontiers) {
  if (noted_ == frontiers.version()) return;
  noted_ = frontiers.version();
  for (const BlockIndex& block : frontiers.changed_blocks()) {
    const Bounds b = bounds_of(block, roadmap.esdf.voxel_size);
    changed_.add(b.low);
    changed_.add(b.high);
  }
  for (const BlockIndex& block : frontiers.closed_blocks())
    closed_.push_back(bounds_of(block, roadmap.esdf.voxel_size));
}

void Views::follow_places(std::span<const Place> places) {
  const std::size_t before = index_of_.size();
  now_at_.assign(before, kGone);
  new_places_.clear();
  std::unordered_map<std::uint64_t, std::uint32_t> now;
  now.reserve(places.size());
  places_changed_ = before != places.size();
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    now[places[i].id] = i;
    const auto found = index_of_.find(places[i].id);
    if (found == index_of_.end())
      new_places_.push_back(i);
    else
      now_at_[found->second] = i;
    places_changed_ = places_changed_ || found == index_of_.end() || found->second != i;
  }
  index_of_ = std::move(now);
  places_ = places;
}

/// What was seen across a place that has changed is to be looked at again; where all of a part was
/// seen, only across one in which something is no longer free.
void Views::mark_changed(const Roadmap& roadmap, const Bounds& changed) {
  const std::vector<Bounds> closed = std::exchange(closed_, {});
  std::vector<std::pair<BlockIndex, PartViews*>> parts;
  parts.reserve(of_part_.size());
  for (auto& [first, views] : of_part_) parts.emplace_back(block_of(first), &views);
  parallel_for_each_index(parts.size(), [&](std::size_t i) {
    PartViews& views = *parts[i].second;
    if (places_changed_) {
      for (Candidate& candidate : views.candidates) candidate.place = now_at_[candidate.place];
      std::erase_if(views.candidates, [](const Candidate& c) { return c.place == kGone; });
    }
    const Bounds part = bounds_of(parts[i].first, roadmap.esdf.voxel_size);
    if (!part.widened(view_.range).meets(changed)) return;
    for (const Candidate& candidate : views.candidates) {
      if (candidate.cached < 0) continue;
      Cached& cached = views.cached[static_cast<std::size_t>(candidate.cached)];
      if (cached.is_stale || (cached.all_seen && closed.empty())) continue;
      Bounds way = part;
      way.add(places_[candidate.place].position);
      // Rays to targets of the part run no farther from the line to its middle than these lie.
      const auto is_crossed = [&](const Bounds& block) {
        return block.widened(0.5 * (part.high.x() - part.low.x()) + roadmap.esdf.voxel_size)
            .meets(places_[candidate.place].position, 0.5 * (part.low + part.high));
      };
      cached.is_stale = way.meets(changed) &&
                        (!cached.all_seen || std::any_of(closed.begin(), closed.end(), is_crossed));
    }
  });
}

bool Views::is_candidate(const EsdfMap& esdf, const FrontierPart& part, const Place& place,
                         double& distance) const {
  constexpr double kBehind = 0.5;  // cosine: from there the unknown side is all that is seen
  const double extent = kBlockSide * esdf.voxel_size;
  const Eigen::Vector3d way = place.position - part.centroid;
  const double squared = way.squaredNorm(), reach = view_.range + extent;
  if (squared > reach * reach) return false;
  distance = std::sqrt(squared);
  if (distance < view_.nearest - extent) return false;
  const double level = std::sqrt(way.x() * way.x() + way.y() * way.y());
  if (std::abs(way.z()) > steepest_to_edge_ * (level + extent) + extent) return false;
  const double normal = part.normal.norm();
  return normal <= 0.5 || part.normal.dot(way) <= kBehind * normal * distance;
}

void Views::find_candidates(const EsdfMap& esdf, const FrontierPart& part, bool is_new,
                            PartViews& views) const {
  const std::size_t before = views.candidates.size();
  const auto consider = [&](std::uint32_t place) {
    double distance = 0.0;
    if (is_candidate(esdf, part, places_[place], distance))
      views.candidates.push_back({distance, place});
  };
  if (is_new)
    for (std::uint32_t place = 0; place < places_.size(); ++place) consider(place);
  else
    for (const std::uint32_t place : new_places_) consider(place);
  if (views.candidates.size() == before) return;
  std::sort(views.candidates.begin(), views.candidates.end(),
            [](const Candidate& a, const Candidate& b) {
              return a.distance != b.distance ? a.distance < b.distance : a.place < b.place;
            });
}

/// The parts that are to be seen, the nearest first, with the places from which they might be.
std::vector<Views::Waiting> Views::follow_parts(const Roadmap& roadmap, const Frontiers& frontiers,
                                                std::size_t least, const Point& near, bool thorough,
                                                const Bounds& changed) {
  const std::span<const FrontierPart> parts = frontiers.parts();
  std::vector<Waiting> waiting;
  std::vector<std::uint8_t> are_new;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const FrontierPart& part = parts[i];
    if (frontiers.clusters()[part.cluster].voxels < least) continue;
    PartViews& views = of_part_[part.first];
    const bool is_new = views.version != part.version || views.thorough != thorough;
    if (is_new) {
      views = PartViews{};
      views.version = part.version;
      views.thorough = thorough;
      views.served = updates_;
      if (const auto found = banned_.find({part.first, part.version}); found != banned_.end())
        views.banned = found->second;
    }
    views.live = updates_;
    are_new.push_back(is_new);
    waiting.push_back({(part.centroid - near).squaredNorm(), i, &views});
  }
  parallel_for_each_index(waiting.size(), [&](std::size_t i) {
    const FrontierPart& part = parts[waiting[i].part];
    PartViews& views = *waiting[i].views;
    find_candidates(roadmap.esdf, part, are_new[i] != 0, views);
    const Bounds around = bounds_of(part.block, roadmap.esdf.voxel_size).widened(deepest_);
    if (are_new[i] != 0 || around.meets(changed))
      views.worth = depth_behind(roadmap.esdf, within_, part, deepest_);
  });
  std::sort(waiting.begin(), waiting.end(), [](const Waiting& a, const Waiting& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.part < b.part;
  });
  return waiting;
}

bool Views::update(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
                   std::span<const Place> places, const Point& near, std::size_t most_rays,
                   bool thorough) {
  note_changes(roadmap, frontiers);
  ++updates_;
  follow_places(places);
  const Bounds changed = std::exchange(changed_, Bounds{});
  mark_changed(roadmap, changed);
  const std::span<const FrontierPart> parts = frontiers.parts();
  std::vector<Waiting> waiting = follow_parts(roadmap, frontiers, least, near, thorough, changed);
  std::erase_if(of_part_, [&](const auto& entry) { return entry.second.live != updates_; });
  std::erase_if(banned_, [&](const auto& entry) {  // parts that have changed since
    const auto now = of_part_.find(entry.first.first);
    return now != of_part_.end() && now->second.version != entry.first.second;
  });
  std::size_t of_late = most_rays / 3, of_near = most_rays - of_late;
  serve(roadmap, parts, waiting, of_near);
  std::vector<Waiting> late = waiting;
  std::stable_sort(late.begin(), late.end(), [](const Waiting& a, const Waiting& b) {
    return a.views->served < b.views->served;
  });
  of_late += of_near;
  const bool all_served = serve(roadmap, parts, late, of_late);
  part_count_ = parts.size();
  gather(waiting);
  return all_served;
}

Stop Views::best_heading(std::size_t place, std::span<const std::uint64_t> covered) const {
  std::array<double, 32> gains{};
  for (const Sight& sight : from_places_[place])
    for (const Ray& ray : sight.rays) {
      if ((covered[sight.part] >> ray.target & 1) != 0) continue;
      for (std::uint32_t bits = ray.headings; bits != 0; bits &= bits - 1)
        gains[static_cast<std::size_t>(std::countr_zero(bits))] += ray.weight * sight.worth;
    }
  Stop best{place, 0, 0.0};
  for (int heading = 0; heading < headings_; ++heading)
    if (const double gain = gains[static_cast<std::size_t>(heading)]; gain > best.gain * (1 + 1e-9))
      best = {place, heading, gain};
  return best;
}

double Views::gain_at(std::size_t place, int heading,
                      std::span<const std::uint64_t> covered) const {
  double gain = 0.0;
  for (const Sight& sight : from_places_[place])
    for (const Ray& ray : sight.rays)
      if ((covered[sight.part] >> ray.target & 1) == 0 && (ray.headings >> heading & 1) != 0)
        gain += ray.weight * sight.worth;
  return gain;
}

void Views::cover(std::size_t place, int heading, std::span<std::uint64_t> covered) const {
  for (const Sight& sight : from_places_[place])
    for (const Ray& ray : sight.rays)
      if ((ray.headings >> heading & 1) != 0) covered[sight.part] |= std::uint64_t{1} << ray.target;
}

}  // namespace ridgeway::detail
