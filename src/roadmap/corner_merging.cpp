// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corner_merging.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace ridgeway::detail {
namespace {

constexpr std::uint32_t kNoCorner = 0xffffffffu;

}  // namespace

CornerMerging::CornerMerging(const Roadmap& roadmap, double distance)
    : esdf_(roadmap.esdf),
      space_(roadmap.esdf),
      radius_(roadmap.min_clearance),
      distance_(distance) {}

void CornerMerging::add(const SampledPath& path) {
  std::vector<VoxelId> chain;
  for (std::size_t i = 1; i + 1 < path.waypoints.size(); ++i)
    if (const VoxelId id = voxel_for(path.waypoints[i]); id != kNoVoxel) chain.push_back(id);
  const auto place_of = [&](VoxelId id) {
    return centre_of(esdf_.layout.index_of(id), esdf_.voxel_size);
  };
  std::uint32_t last = kNoCorner;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Point place = place_of(chain[i]);
    const Point next = i + 1 < chain.size() ? place_of(chain[i + 1]) : place;
    std::uint32_t own =
        stand_in(place, path.part, last == kNoCorner ? nullptr : &places_[last], next);
    if (own == kNoCorner) own = insert(chain[i], place, path.part);
    if (last != kNoCorner && own != last) steps_.emplace_back(std::minmax(last, own));
    last = own;
  }
}

MergedCorners CornerMerging::merged() const {
  std::vector<std::uint32_t> order(voxels_.size()), rank(voxels_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&, &layout = esdf_.layout](std::uint32_t a, std::uint32_t b) {
              return layout.order_of(voxels_[a]) < layout.order_of(voxels_[b]);
            });
  MergedCorners result;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    result.voxels.push_back(voxels_[order[i]]);
    result.parts.push_back(parts_[order[i]]);
  }
  for (const auto& [a, b] : steps_) result.steps.emplace_back(std::minmax(rank[a], rank[b]));
  std::sort(result.steps.begin(), result.steps.end());
  result.steps.erase(std::unique(result.steps.begin(), result.steps.end()), result.steps.end());
  return result;
}

CornerMerging::Bucket CornerMerging::bucket_of(const Point& p) const {
  const double side = std::max(distance_, esdf_.voxel_size);  // so that all of a map have a number
  return {floor_to_int(p.x() / side), floor_to_int(p.y() / side), floor_to_int(p.z() / side)};
}

/// Of the eight voxels around a corner the nearest one that is no nearer to obstacles.
VoxelId CornerMerging::voxel_for(const Point& corner) const {
  const double s = esdf_.voxel_size;
  const SquaredHalves least = least_clearance(std::max(space_.distance(corner), radius_), s);
  const Point low = corner / s - Point::Constant(0.5);
  const VoxelIndex first{floor_to_int(low.x()), floor_to_int(low.y()), floor_to_int(low.z())};
  VoxelId best = kNoVoxel;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    const VoxelIndex v = first + VoxelIndex{i & 1, i >> 1 & 1, i >> 2};
    const VoxelId id = esdf_.layout.find(v);
    if (!esdf_.is_open(id) || esdf_.squared[id] < least) continue;
    const double distance = (centre_of(v, s) - corner).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    best = id;
  }
  return best;
}

std::uint32_t CornerMerging::insert(VoxelId id, const Point& place, std::uint32_t part) {
  std::vector<std::uint32_t>& bucket = buckets_[bucket_of(place)];
  for (const std::uint32_t other : bucket)
    if (voxels_[other] == id) return other;
  bucket.push_back(static_cast<std::uint32_t>(voxels_.size()));
  voxels_.push_back(id);
  places_.push_back(place);
  parts_.push_back(part);
  return bucket.back();
}

/// The nearest known corner of the same part, if a path from `before` (if any) on to `next` may
/// turn at it instead.
std::uint32_t CornerMerging::stand_in(const Point& corner, std::uint32_t part, const Point* before,
                                      const Point& next) const {
  std::pair<double, std::uint32_t> nearest{distance_, kNoCorner};
  const auto [x, y, z] = bucket_of(corner);
  for (int i = 0; i < 27; ++i) {
    const auto found = buckets_.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
    if (found == buckets_.end()) continue;
    for (const std::uint32_t other : found->second)
      if (parts_[other] == part)
        nearest = std::min(nearest, {(places_[other] - corner).norm(), other});
  }
  if (nearest.second == kNoCorner) return kNoCorner;
  const Point& place = places_[nearest.second];
  const bool suits = (before == nullptr || space_.is_free(*before, place, radius_)) &&
                     space_.is_free(place, next, radius_);
  return suits ? nearest.second : kNoCorner;
}

}  // namespace ridgeway::detail
