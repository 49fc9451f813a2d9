// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "views.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "ray_walk.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::size_t kTargets = 6;       // of a part, that are looked at
constexpr std::size_t kMostTargets = 64;  // that coverage tells apart
constexpr std::size_t kNearPlaces = 24;   // that are asked for every part
constexpr std::size_t kFarPlaces = 64;    // and where none of these sees it
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

void Views::ban(const Place& place, const FrontierPart& part) {
  banned_.insert({place.id, part.first, part.version});
}

void Views::note_changes(const Roadmap& roadmap, const Frontiers& frontiers) {
  if (noted_ == frontiers.version()) return;
  noted_ = frontiers.version();
  for (const BlockIndex& block : frontiers.changed_blocks()) {
    const Bounds b = bounds_of(block, roadmap.esdf.voxel_size);
    changed_.add(b.low);
    changed_.add(b.high);
  }
}

void Views::forget_changed(const Roadmap& roadmap, std::span<const Place> places) {
  const double s = roadmap.esdf.voxel_size;
  const Bounds changed = std::exchange(changed_, Bounds{});
  if (changed.is_empty()) return;
  std::unordered_map<std::uint64_t, const Place*> by_id;
  for (const Place& place : places) by_id[place.id] = &place;
  for (auto& [first, views] : of_part_) {
    const Bounds part = bounds_of(block_of(first), s);
    Bounds reach = part;
    reach.low.array() -= view_.range;
    reach.high.array() += view_.range;
    if (!reach.meets(changed)) continue;
    std::erase_if(views.from, [&, &part_bounds = part](const auto& entry) {
      const auto place = by_id.find(entry.first);
      if (place == by_id.end()) return true;
      if (entry.second.all_seen) return false;
      Bounds way = part_bounds;
      way.add(place->second->position);
      return way.meets(changed);
    });
  }
}

const Views::Cached* Views::look(const Roadmap& roadmap, const FrontierPart& part,
                                 const Place& place, PartViews& views,
                                 std::size_t& rays_left) const {
  if (const auto found = views.from.find(place.id); found != views.from.end())
    return &found->second;
  const std::size_t count = part.targets.size();
  const std::size_t looks = views.thorough ? count : std::min(count, kTargets);
  if (rays_left < looks) return nullptr;
  Cached& cached = views.from[place.id];
  cached.all_seen = true;
  for (std::size_t i = 0; i < looks; ++i) {
    const VoxelIndex& target = part.targets[i * count / looks];
    const std::uint32_t headings =
        headings_to(place.position, centre_of(target, roadmap.esdf.voxel_size));
    if (headings == 0) continue;  // does not depend on the map
    --rays_left;
    if (sees(roadmap.esdf, place.position, target))
      cached.rays.push_back({headings, static_cast<std::uint8_t>(i % kMostTargets),
                             static_cast<float>(part.voxels) / static_cast<float>(looks)});
    else
      cached.all_seen = false;
  }
  return &cached;
}

std::vector<std::size_t> Views::candidates(const EsdfMap& esdf, const FrontierPart& part,
                                           std::span<const Place> places) const {
  constexpr double kBehind = 0.5;  // cosine: from there the unknown side is all that is seen
  const double extent = kBlockSide * esdf.voxel_size;
  const double steepest = std::tan(0.5 * view_.vertical);
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d way = places[i].position - part.centroid;
    const double distance = way.norm();
    if (distance > view_.range + extent || distance < view_.nearest - extent) continue;
    const double level = std::hypot(way.x(), way.y());
    if (std::abs(way.z()) > steepest * (level + extent) + extent) continue;
    if (part.normal.norm() > 0.5 && part.normal.dot(way) > kBehind * part.normal.norm() * distance)
      continue;
    found.push_back({distance, i});
  }
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> indices;
  for (const auto& [distance, i] : found) indices.push_back(i);
  return indices;
}

void Views::update(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
                   std::span<const Place> places, const Point& near, std::size_t most_rays) {
  note_changes(roadmap, frontiers);
  forget_changed(roadmap, places);
  const bool thorough = most_rays == kAllRays;
  const std::span<const FrontierPart> parts = frontiers.parts();
  part_count_ = parts.size();
  from_places_.assign(places.size(), {});
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (frontiers.clusters()[parts[i].cluster].voxels >= least)
      order.push_back({(parts[i].centroid - near).squaredNorm(), i});
  std::sort(order.begin(), order.end());
  for (auto& [first, views] : of_part_) views.is_live = false;
  std::size_t rays_left = most_rays;
  for (const auto& [distance, i] : order) {
    const FrontierPart& part = parts[i];
    PartViews& views = of_part_[part.first];
    if (views.version != part.version || views.thorough != thorough) views.from.clear();
    views.version = part.version;
    views.thorough = thorough;
    views.is_live = true;
    const double worth = depth_behind(roadmap.esdf, within_, part, deepest_);
    bool is_seen = false;
    std::size_t asked = 0;
    for (const std::size_t place : candidates(roadmap.esdf, part, places)) {
      if (!thorough && asked >= (is_seen ? kNearPlaces : kFarPlaces)) break;
      ++asked;
      if (banned_.contains({places[place].id, part.first, part.version})) continue;
      const Cached* cached = look(roadmap, part, places[place], views, rays_left);
      if (cached == nullptr || cached->rays.empty()) continue;
      is_seen = true;
      from_places_[place].push_back({i, cached->rays, worth});
    }
  }
  std::erase_if(of_part_, [](const auto& entry) { return !entry.second.is_live; });
  for (std::vector<Sight>& sights : from_places_)
    std::sort(sights.begin(), sights.end(),
              [](const Sight& a, const Sight& b) { return a.part < b.part; });
}

double Views::gain_now(const Roadmap& roadmap, const Frontiers& frontiers, std::size_t least,
                       const Place& place, int heading) const {
  double gain = 0.0;
  for (const FrontierPart& part : frontiers.parts()) {
    if (frontiers.clusters()[part.cluster].voxels < least) continue;
    if (banned_.contains({place.id, part.first, part.version})) continue;
    const double reach = view_.range + kBlockSide * roadmap.esdf.voxel_size;
    if ((part.centroid - place.position).squaredNorm() > reach * reach) continue;
    const std::size_t count = part.targets.size(), looks = std::min(count, kTargets);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < looks; ++i) {
      const VoxelIndex& target = part.targets[i * count / looks];
      const Point centre = centre_of(target, roadmap.esdf.voxel_size);
      if ((headings_to(place.position, centre) >> heading & 1) != 0 &&
          sees(roadmap.esdf, place.position, target))
        ++seen;
    }
    if (seen > 0)
      gain += static_cast<double>(part.voxels * seen) / static_cast<double>(looks) *
              depth_behind(roadmap.esdf, within_, part, deepest_);
  }
  return gain;
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
