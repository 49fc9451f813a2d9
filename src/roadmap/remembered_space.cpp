// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "remembered_space.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace ridgeway::detail {
namespace {

constexpr double kAround = 4.0;  // voxels beyond what decides in which distances are looked up
constexpr std::size_t kAnswersABlock = 20;
// Questions about one segment differ by a number: a radius above 0 (is it free at that?), a length
// below 0 (the clearance, at most as much), or one of these.
constexpr double kClearance = -std::numeric_limits<double>::infinity(), kMove = 0.0;

}  // namespace

std::size_t SegmentMemory::hash_of_question(const Question& question) noexcept {
  std::uint64_t hash = 0;
  for (const double part : question) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 29;
  }
  return hash;
}

void SegmentMemory::forget_unasked() {
  for (Shard& shard : shards_) Answers().swap(shard.before);
}

void SegmentMemory::forget() {
  for (Shard& shard : shards_) {
    shard.now.clear();
    shard.before.clear();
  }
}

void SegmentMemory::change(const BlockLayout& layout, std::span<const std::uint32_t> changed) {
  for (Shard& shard : shards_) {
    shard.before.swap(shard.now);
    shard.now.clear();
  }
  most_answers_ = kAnswersABlock * layout.block_count() / kShards + 1;
  sums_.clear();
  extent_ = {};
  if (changed.empty()) return;
  BlockIndex high = low_ = layout.block(changed.front());
  for (const std::uint32_t slot : changed) {
    const BlockIndex& b = layout.block(slot);
    low_ = {std::min(low_.x, b.x), std::min(low_.y, b.y), std::min(low_.z, b.z)};
    high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
  }
  const double places = (high.x - low_.x + 1.0) * (high.y - low_.y + 1.0) * (high.z - low_.z + 1.0);
  constexpr double kMostPlaces = 1e7;
  if (places > kMostPlaces) return forget();  // changes far apart
  extent_ = high - low_ + BlockIndex{1, 1, 1};
  sums_.assign(static_cast<std::size_t>(places), 0);
  const auto sum = [&](int x, int y, int z) -> std::uint32_t& {
    return sums_[static_cast<std::size_t>(x) +
                 static_cast<std::size_t>(extent_.x) *
                     (static_cast<std::size_t>(y) +
                      static_cast<std::size_t>(extent_.y) * static_cast<std::size_t>(z))];
  };
  for (const std::uint32_t slot : changed) {
    const BlockIndex b = layout.block(slot) - low_;
    sum(b.x, b.y, b.z) = 1;
  }
  for (int z = 0; z < extent_.z; ++z)
    for (int y = 0; y < extent_.y; ++y)
      for (int x = 1; x < extent_.x; ++x) sum(x, y, z) += sum(x - 1, y, z);
  for (int z = 0; z < extent_.z; ++z)
    for (int y = 1; y < extent_.y; ++y)
      for (int x = 0; x < extent_.x; ++x) sum(x, y, z) += sum(x, y - 1, z);
  for (int z = 1; z < extent_.z; ++z)
    for (int y = 0; y < extent_.y; ++y)
      for (int x = 0; x < extent_.x; ++x) sum(x, y, z) += sum(x, y, z - 1);
}

/// Changed blocks up to a place in the box, itself included; -1 is before the first.
std::uint32_t SegmentMemory::sum_up_to(int x, int y, int z) const {
  if (x < 0 || y < 0 || z < 0) return 0;
  return sums_[static_cast<std::size_t>(x) +
               static_cast<std::size_t>(extent_.x) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(extent_.y) * static_cast<std::size_t>(z))];
}

bool SegmentMemory::touches_change(const Point& low, const Point& high) const {
  if (sums_.empty()) return false;
  const auto clamped = [](double voxel, int from, int extent) {
    return static_cast<int>(
               std::clamp(std::floor(voxel / kBlockSide), from - 1.0, from + 0.0 + extent)) -
           from;
  };
  const int x0 = std::max(clamped(low.x(), low_.x, extent_.x), 0);
  const int y0 = std::max(clamped(low.y(), low_.y, extent_.y), 0);
  const int z0 = std::max(clamped(low.z(), low_.z, extent_.z), 0);
  const int x1 = std::min(clamped(high.x(), low_.x, extent_.x), extent_.x - 1);
  const int y1 = std::min(clamped(high.y(), low_.y, extent_.y), extent_.y - 1);
  const int z1 = std::min(clamped(high.z(), low_.z, extent_.z), extent_.z - 1);
  if (x0 > x1 || y0 > y1 || z0 > z1) return false;
  const auto layer = [&](int z) {
    return sum_up_to(x1, y1, z) - sum_up_to(x0 - 1, y1, z) - sum_up_to(x1, y0 - 1, z) +
           sum_up_to(x0 - 1, y0 - 1, z);
  };
  return layer(z1) != layer(z0 - 1);
}

/// At least the distance to the nearest obstacle, metres.
double RememberedSpace::farthest_obstacle(const Point& p) const {
  const VoxelId id = esdf_.layout.find(voxel_at(p, esdf_.voxel_size));
  const double at_centre = id == kNoVoxel ? 0.0 : esdf_.distance(id);
  return std::min(at_centre + esdf_.voxel_size, esdf_.max_distance + 2.0 * esdf_.voxel_size);
}

/// `reach`: metres around the segment within which obstacles may decide.
template <typename Find>
double RememberedSpace::ask(double kind, const Point& a, const Point& b, double reach,
                            const Find& find) const {
  if (memory_ == nullptr || std::isinf(reach)) return find();
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(reach / esdf_.voxel_size + kAround);
  return memory_->answer({kind, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()},
                         a.cwiseMin(b) / esdf_.voxel_size - around,
                         a.cwiseMax(b) / esdf_.voxel_size + around, find);
}

bool RememberedSpace::is_free(const Point& a, const Point& b, double radius) const {
  return ask(radius, a, b, radius, [&] { return space_.is_free(a, b, radius) ? 1.0 : 0.0; }) != 0.0;
}

double RememberedSpace::clearance(const Point& a, const Point& b) const {
  const double reach = memory_ == nullptr ? 0.0
                                          : std::min(farthest_obstacle(a), farthest_obstacle(b)) +
                                                0.5 * (b - a).norm();
  return ask(kClearance, a, b, reach, [&] { return space_.clearance(a, b); });
}

double RememberedSpace::clearance(const Point& a, const Point& b, double at_most) const {
  return ask(-at_most, a, b, at_most, [&] {
    const std::array<Point, 2> ends{a, b};
    return space_.clearance(ends, at_most);
  });
}

SquaredHalves RememberedSpace::move_clearance(VoxelId from, VoxelId to, int direction) const {
  const SquaredHalves a = esdf_.squared[from], b = esdf_.squared[to];
  const SquaredHalves low = std::min(a, b);
  if (memory_ == nullptr || low == SquaredHalves(kNoSite) ||
      FreeSpace::move_bound(a, b, squared_length(direction)) >= low)
    return space_.move_clearance(from, to, direction);
  const VoxelIndex v = esdf_.layout.index_of(from);
  return SquaredHalves(ask(kMove, centre_of(v, esdf_.voxel_size),
                           centre_of(v + offset_of(direction), esdf_.voxel_size),
                           low.metres(esdf_.voxel_size),
                           [&] { return space_.move_clearance(from, to, direction).value; }));
}

}  // namespace ridgeway::detail
