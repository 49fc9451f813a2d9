// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "remembered_space.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

/// Voxels from a segment to the centres of those whose distances and sites are read: the eight
/// around a place on it, and both ends of a move.
constexpr double kBeside = 2.0;
/// Voxels beyond what decides in which obstacles are looked at: all that are nearer than a first
/// bound, from the site of a voxel no more than four from the narrowest place, which is known to a
/// diagonal.
constexpr double kAround = 6.0;
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

void SegmentMemory::change(const BlockLayout& layout, std::span<const std::uint32_t> changed,
                           std::span<const std::uint32_t> flipped) {
  for_each_kind([](auto& answers) {
    std::swap(answers.before, answers.now);
    answers.now.clear();
  });
  most_answers_ = kAnswersABlock * layout.block_count() / kShards + 1;
  changed_ = ChangedBlocks(layout, changed);
  changed_slots_.assign(changed.begin(), changed.end());
  flipped_ = ChangedBlocks(layout, flipped);
  if (changed_.are_all()) forget();
}

bool SegmentMemory::may_be_another(const Point& low, const Point& high, double reach) const {
  const Eigen::Vector3d beside = Eigen::Vector3d::Constant(kBeside);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(reach + kAround);
  return changed_.touch(low - beside, high + beside) || flipped_.touch(low - around, high + around);
}

/// `reach(answer)`: metres around the segment in which that answer's obstacles lie.
template <typename Reach, typename Find>
double RememberedSpace::ask(double kind, const Point& a, const Point& b, const Reach& reach,
                            const Find& find) const {
  if (memory_ == nullptr) return find();
  const auto holds = [&](double answer) {
    return !memory_->may_be_another(a.cwiseMin(b) / esdf_.voxel_size,
                                    a.cwiseMax(b) / esdf_.voxel_size,
                                    reach(answer) / esdf_.voxel_size);
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
    return !memory_->may_be_another(centre, centre, 0.5 * std::sqrt(low.value));
  };
  return SquaredHalves(memory_->answer(
      move, holds, [&] { return space_.move_clearance(from, to, direction).value; }));
}

void RememberedSpace::remember_moves(const VoxelMask& voxels) const {
  if (memory_ == nullptr) return;
  constexpr Cube27 kForward = kCells26 >> kCentre << kCentre;  // each move is one way
  const BlockLayout& layout = esdf_.layout;
  const auto remember = [&](std::uint32_t slot) {
    for_each_member(voxels, slot, [&](VoxelId id) {
      for (Cube27 cells = cube_around(layout, voxels, id) & kForward; cells != 0;
           cells &= cells - 1) {
        const int d = std::countr_zero(cells);
        move_clearance(id, layout.neighbour(id, d), d);
      }
    });
  };
  static_assert(kBeside < kBlockSide);  // no answer elsewhere may be another
  std::vector<std::uint8_t> is_done(layout.block_count());
  for (const std::uint32_t changed : memory_->changed_slots())
    for (int d = 0; d < 27; ++d)
      if (const std::uint32_t slot = layout.neighbour_block(changed, d);
          slot != BlockLayout::kNoBlock && std::exchange(is_done[slot], std::uint8_t{1}) == 0)
        remember(slot);
}

}  // namespace ridgeway::detail
