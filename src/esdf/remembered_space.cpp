// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "remembered_space.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace ridgeway::detail {
namespace {

/// Voxels beyond what decides in which distances are looked up: a march reads those of voxels that
/// the segment touches, whose nearest obstacles are no more than a voxel's diagonal farther from it
/// than the nearest of all, and looks at obstacles no farther than that.
constexpr double kAround = 4.0;
constexpr std::size_t kAnswersABlock = 20;
// Questions about one segment differ by a number: a radius above 0 (is it free at that?), a length
// below 0 (the clearance, at most as much), or this one.
constexpr double kClearance = -std::numeric_limits<double>::infinity();

}  // namespace

std::uint64_t SegmentMemory::hash_of(const OfSegment& question) noexcept {
  std::uint64_t hash = 0;
  for (const double part : question) hash = mixed(hash ^ std::bit_cast<std::uint64_t>(part));
  return hash;
}

/// body(answers) for those of each kind of question in each shard.
template <typename Body>
void SegmentMemory::for_each_kind(const Body& body) {
  for (Shard& shard : shards_)
    std::apply([&](auto&... answers) { (body(answers), ...); }, shard.answers);
}

void SegmentMemory::forget_unasked() {
  for_each_kind([](auto& answers) { answers.before.clear(); });
}

void SegmentMemory::forget() {
  for_each_kind([](auto& answers) {
    answers.now.clear();
    answers.before.clear();
  });
}

void SegmentMemory::change(const BlockLayout& layout, std::span<const std::uint32_t> changed) {
  for_each_kind([](auto& answers) {
    std::swap(answers.before, answers.now);
    answers.now.clear();
  });
  most_answers_ = kAnswersABlock * layout.block_count() / kShards + 1;
  sums_.clear();
  extent_ = {};
  is_all_changed_ = false;
  if (changed.empty()) return;
  BlockIndex high = low_ = layout.block(changed.front());
  for (const std::uint32_t slot : changed) {
    const BlockIndex& b = layout.block(slot);
    low_ = {std::min(low_.x, b.x), std::min(low_.y, b.y), std::min(low_.z, b.z)};
    high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
  }
  const double places = (high.x - low_.x + 1.0) * (high.y - low_.y + 1.0) * (high.z - low_.z + 1.0);
  constexpr double kMostPlaces = 1e7;
  is_all_changed_ = places > kMostPlaces;
  if (is_all_changed_) return forget();  // changes far apart
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
  if (sums_.empty()) return is_all_changed_;
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

/// `reach(answer)`: metres around the segment in which that answer's obstacles lie.
template <typename Reach, typename Find>
double RememberedSpace::ask(double kind, const Point& a, const Point& b, const Reach& reach,
                            const Find& find) const {
  if (memory_ == nullptr) return find();
  const auto holds = [&](double answer) {
    const Eigen::Vector3d around =
        Eigen::Vector3d::Constant(reach(answer) / esdf_.voxel_size + kAround);
    return !memory_->touches_change(a.cwiseMin(b) / esdf_.voxel_size - around,
                                    a.cwiseMax(b) / esdf_.voxel_size + around);
  };
  return memory_->answer(SegmentMemory::OfSegment{kind, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()},
                         holds, find);
}

bool RememberedSpace::is_free(const Point& a, const Point& b, double radius) const {
  return ask(
             radius, a, b, [&](double) { return radius; },
             [&] { return space_.is_free(a, b, radius) ? 1.0 : 0.0; }) != 0.0;
}

double RememberedSpace::clearance(const Point& a, const Point& b) const {
  return ask(
      kClearance, a, b, [](double clearance) { return clearance; },
      [&] { return space_.clearance(a, b); });
}

double RememberedSpace::clearance(const Point& a, const Point& b, double at_most) const {
  return ask(
      -at_most, a, b, [](double clearance) { return clearance; },
      [&] {
        const std::array<Point, 2> ends{a, b};
        return space_.clearance(ends, at_most);
      });
}

SquaredHalves RememberedSpace::move_clearance(VoxelId from, VoxelId to, int direction) const {
  const SquaredHalves low = std::min(esdf_.squared[from], esdf_.squared[to]);
  if (is_level(from, to, direction)) return low;
  if (direction < kCentre) {  // both ways are one question
    std::swap(from, to);
    direction = opposite(direction);
  }
  const OfMove move = move_from(from, direction);
  if (moves_ != nullptr)
    if (const double* known = moves_->find(move)) return SquaredHalves(*known);
  if (memory_ == nullptr) return space_.move_clearance(from, to, direction);
  const auto holds = [&](double) {
    const VoxelIndex v = esdf_.layout.index_of(from);
    const Point centre(v.x, v.y, v.z);
    const double reach = 0.5 * std::sqrt(static_cast<double>(low.value)) + kAround;
    return !memory_->touches_change(centre - Eigen::Vector3d::Constant(reach),
                                    centre + Eigen::Vector3d::Constant(reach));
  };
  return SquaredHalves(memory_->answer(
      move, holds, [&] { return space_.move_clearance(from, to, direction).value; }));
}

}  // namespace ridgeway::detail
