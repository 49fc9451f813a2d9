// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corner_merging.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::size_t kTries = 4;  // corners that may stand for one

/// Corners as they are met, in buckets by place.
class Merging {
 public:
  Merging(const Roadmap& roadmap, double distance)
      : esdf_(roadmap.esdf),
        space_(roadmap.esdf),
        radius_(roadmap.min_clearance),
        distance_(distance) {}

  void add(const CornerChain& chain) {
    std::uint32_t last = kNone;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Point corner = place_of(chain[i]);
      const Point* before = last == kNone ? nullptr : &places_[last];
      const Point next = i + 1 < chain.size() ? place_of(chain[i + 1]) : corner;
      std::uint32_t own = stand_in(corner, before, next);
      if (own == kNone) own = insert(chain[i], corner);
      if (last != kNone && own != last) steps_.emplace_back(std::minmax(last, own));
      last = own;
    }
  }

  MergedCorners finish() {
    std::vector<std::uint32_t> order(voxels_.size()), rank(voxels_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return voxels_[a] < voxels_[b]; });
    MergedCorners result;
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      rank[order[i]] = i;
      result.voxels.push_back(voxels_[order[i]]);
    }
    for (const auto& [a, b] : steps_) result.steps.emplace_back(std::minmax(rank[a], rank[b]));
    std::sort(result.steps.begin(), result.steps.end());
    result.steps.erase(std::unique(result.steps.begin(), result.steps.end()), result.steps.end());
    return result;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Bucket = std::tuple<int, int, int>;

  Point place_of(VoxelId id) const {
    return centre_of(esdf_.layout.index_of(id), esdf_.voxel_size);
  }
  Bucket bucket_of(const Point& p) const {
    return {floor_to_int(p.x() / distance_), floor_to_int(p.y() / distance_),
            floor_to_int(p.z() / distance_)};
  }

  std::uint32_t insert(VoxelId id, const Point& corner) {
    const auto own = static_cast<std::uint32_t>(voxels_.size());
    voxels_.push_back(id);
    places_.push_back(corner);
    buckets_[bucket_of(corner)].push_back(own);
    return own;
  }

  /// The nearest known corner that a path from `before` (if any) on to `next` may turn at instead.
  std::uint32_t stand_in(const Point& corner, const Point* before, const Point& next) const {
    std::vector<std::pair<double, std::uint32_t>> near;
    const auto [x, y, z] = bucket_of(corner);
    for (int i = 0; i < 27; ++i) {
      const auto found = buckets_.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
      if (found == buckets_.end()) continue;
      for (const std::uint32_t other : found->second) {
        const double away = (places_[other] - corner).norm();
        if (away < distance_) near.emplace_back(away, other);
      }
    }
    std::sort(near.begin(), near.end());
    for (std::size_t i = 0; i < std::min(near.size(), kTries); ++i) {
      const Point& place = places_[near[i].second];
      if ((before == nullptr || space_.is_free(*before, place, radius_)) &&
          space_.is_free(place, next, radius_))
        return near[i].second;
    }
    return kNone;
  }

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const double radius_, distance_;
  std::vector<VoxelId> voxels_;
  std::vector<Point> places_;
  std::map<Bucket, std::vector<std::uint32_t>> buckets_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> steps_;
};

}  // namespace

MergedCorners merge_corners(const Roadmap& roadmap, const std::vector<CornerChain>& chains,
                            double distance) {
  Merging merging(roadmap, distance);
  for (const CornerChain& chain : chains) merging.add(chain);
  return merging.finish();
}

}  // namespace ridgeway::detail
