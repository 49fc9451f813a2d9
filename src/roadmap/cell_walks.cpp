// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_walks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ridgeway::detail {
namespace {

// The voxels with the least and the greatest coordinate along each axis.
constexpr std::array<CellMask, 3> kFirstLayer{0x1111111111111111u, 0x000f000f000f000fu,
                                              0x000000000000ffffu};
constexpr std::array<CellMask, 3> kLastLayer{0x8888888888888888u, 0xf000f000f000f000u,
                                             0xffff000000000000u};

/// Voxels and those that share a face with them, in one cell.
CellMask spread_in_cell(CellMask voxels) {
  CellMask result = voxels;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const unsigned step = 1u << 2 * axis;
    result |= (voxels & ~kLastLayer[axis]) << step | (voxels & ~kFirstLayer[axis]) >> step;
  }
  return result;
}

CellPair pair_of(std::uint8_t place) {
  return place < 64 ? CellPair{bit_of(place), 0}
                    : CellPair{0, bit_of(static_cast<std::uint8_t>(place - 64))};
}

/// The axis of a step between two voxels that share a face.
int axis_of(const VoxelIndex& step) { return step.x != 0 ? 0 : step.y != 0 ? 1 : 2; }

}  // namespace

CellMask fitting_voxels(const FreeSpace& space, CellId cell, SquaredHalves threshold) {
  const EsdfMap& esdf = space.map();
  const double least = std::ceil(threshold.value);
  if (least > kNoSite) return 0;
  const auto enough = static_cast<std::uint32_t>(least);
  const std::uint32_t slot = esdf.layout.slot_at(cell / CellGraph::kPerBlock);
  const std::uint32_t* const squared = esdf.squared.block(slot);
  const VoxelState* const state = esdf.state.block(slot);
  CellMask fitting = 0;
  for (std::uint32_t row = 0; row < 16; ++row) {
    const std::uint32_t first = local_voxel(cell, 4 * row);
    unsigned fits = 0;  // without a branch
    for (std::uint32_t x = 0; x < 4; ++x)
      fits |= static_cast<unsigned>(is_open(state[first + x], esdf.unknown) &
                                    (squared[first + x] >= enough))
              << x;
    fitting |= CellMask{fits} << 4 * row;
  }
  if (space.limits() != nullptr)
    for (CellMask left = fitting; left != 0; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      if (!space.is_within_limits(slot * kBlockVoxels + local_voxel(cell, place)))
        fitting &= ~(left & (~left + 1));
    }
  return fitting;
}

CellMask flood(CellMask from, CellMask room) {
  for (CellMask reached = from & room;;) {
    const CellMask next = spread_in_cell(reached) & room;
    if (next == reached) return reached;
    reached = next;
  }
}

CellMask voxels_moved(CellMask voxels, int step, int move) {
  const VoxelIndex &s = offset_of(step), &m = offset_of(move);
  const std::array<int, 3> steps{s.x, s.y, s.z}, moves{m.x, m.y, m.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const unsigned one = 1u << 2 * axis, width = 3u << 2 * axis;
    if (moves[axis] > 0)
      voxels = steps[axis] > 0 ? (voxels & kLastLayer[axis]) >> width
                               : (voxels & ~kLastLayer[axis]) << one;
    if (moves[axis] < 0)
      voxels = steps[axis] < 0 ? (voxels & kFirstLayer[axis]) << width
                               : (voxels & ~kFirstLayer[axis]) >> one;
  }
  return voxels;
}

CellPair CellWalks::spread(const CellPair& voxels) const {
  const auto axis = static_cast<std::size_t>(axis_);
  const unsigned width = 3u << 2 * axis;
  CellPair result{spread_in_cell(voxels.first), spread_in_cell(voxels.second)};
  result.first |= (voxels.second & kFirstLayer[axis]) << width;
  result.second |= (voxels.first & kLastLayer[axis]) >> width;
  return {result.first & room_.first, result.second & room_.second};
}

bool CellWalks::connect(std::uint8_t from, std::uint8_t to) const {
  const CellPair goal = pair_of(to);
  if (!room_.meets(goal)) return false;
  CellPair reached = pair_of(from);
  while (room_.meets(reached) && !reached.meets(goal)) {
    const CellPair next = spread(reached);
    if (next == reached) return false;
    reached = next;
  }
  return reached.meets(goal);
}

std::vector<std::uint8_t> CellWalks::walk(std::uint8_t from, std::uint8_t to) const {
  if (!connect(from, to)) return {};
  std::vector<CellPair> reached{pair_of(to)};
  while (!reached.back().meets(pair_of(from))) reached.push_back(spread(reached.back()));
  std::vector<std::uint8_t> walk{from};
  int last_axis = -1;
  for (std::size_t left = reached.size() - 1; left-- > 0;) {
    const CellPair around = spread(pair_of(walk.back()));
    CellMask first = around.first & reached[left].first;
    CellMask second = around.second & reached[left].second;
    int best = -1;
    for (; (first | second) != 0; (first != 0 ? first &= first - 1 : second &= second - 1)) {
      const int place = first != 0 ? std::countr_zero(first) : 64 + std::countr_zero(second);
      const VoxelIndex step =
          step_to(static_cast<std::uint8_t>(place), axis_) - step_to(walk.back(), axis_);
      if (best < 0 || axis_of(step) != last_axis) best = place;
      if (axis_of(step) != last_axis) break;
    }
    const auto next = static_cast<std::uint8_t>(best);
    last_axis = axis_of(step_to(next, axis_) - step_to(walk.back(), axis_));
    walk.push_back(next);
  }
  return walk;
}

VoxelIndex step_to(std::uint8_t place, int axis) {
  const int in_cell = place & 63;
  VoxelIndex step{in_cell & 3, in_cell >> 2 & 3, in_cell >> 4};
  if (place >= 64) (axis == 0 ? step.x : axis == 1 ? step.y : step.z) += CellGraph::kSide;
  return step;
}

float length_of_walk(const std::vector<std::uint8_t>& walk, int axis) {
  float length = 0.0f;
  for (std::size_t at = 0; at + 1 < walk.size();) {
    unsigned axes = 0;
    std::size_t next = at;
    while (next + 1 < walk.size()) {
      const VoxelIndex step = step_to(walk[next + 1], axis) - step_to(walk[next], axis);
      const unsigned own = 1u << axis_of(step);
      if ((axes & own) != 0) break;
      axes |= own;
      ++next;
    }
    length += std::sqrt(static_cast<float>(next - at));
    at = next;
  }
  return length;
}

}  // namespace ridgeway::detail
