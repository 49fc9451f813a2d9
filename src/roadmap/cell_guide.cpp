// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_guide.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "paths/planning_constants.hpp"

namespace ridgeway::detail {
namespace {

/// Length of the shortest way over voxels of empty space, so that estimates of such ways fit them.
float lattice_length(const Eigen::Vector3f& way) {
  constexpr float kRoot2 = 1.41421356f, kRoot3 = 1.73205081f;
  const float x = std::abs(way.x()), y = std::abs(way.y()), z = std::abs(way.z());
  const float least = std::min({x, y, z}), most = std::max({x, y, z});
  const float middle = x + y + z - least - most;
  return (kRoot3 - kRoot2) * least + (kRoot2 - 1.0f) * middle + most;
}

Eigen::Vector3f corner_of(const VoxelIndex& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Eigen::Vector3f middle_of(const VoxelIndex& v) {
  return corner_of(v) + Eigen::Vector3f::Constant(0.5f);
}

/// The voxel's bit in its cell.
CellMask bit_in_cell(const VoxelIndex& v) {
  return bit_of(static_cast<std::uint8_t>((v.x & 3) | (v.y & 3) << 2 | (v.z & 3) << 4));
}

/// The middle of voxels of a cell, from its first one.
Eigen::Vector3f middle_of(CellMask voxels) {
  if (voxels == ~CellMask{0}) return Eigen::Vector3f::Constant(2.0f);
  constexpr std::array<std::array<CellMask, 2>, 3> kBits{
      {{0xaaaaaaaaaaaaaaaau, 0xccccccccccccccccu},
       {0xf0f0f0f0f0f0f0f0u, 0xff00ff00ff00ff00u},
       {0xffff0000ffff0000u, 0xffffffff00000000u}}};
  const auto count = [](CellMask mask) { return static_cast<float>(std::popcount(mask)); };
  Eigen::Vector3f sum;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& bits = kBits[static_cast<std::size_t>(axis)];
    sum[axis] = count(voxels & bits[0]) + 2.0f * count(voxels & bits[1]);
  }
  return sum / count(voxels) + Eigen::Vector3f::Constant(0.5f);
}

}  // namespace

CellGuide::CellGuide(const Roadmap& roadmap, const FreeSpace& space, double radius, VoxelId from,
                     VoxelId to)
    : around_(roadmap, space, space.inner_radius(radius)),
      lengths_(roadmap.cells.lengths),
      start_(roadmap.esdf.layout.index_of(from)),
      end_(roadmap.esdf.layout.index_of(to)) {
  const CellId cell = around_.lattice.cell_of(start_);
  if (!lengths_.empty()) start_lengths_ = lengths_[cell / CellGraph::kPerBlock];
}

bool CellGuide::find_way(int most_parts, const Deadline& deadline) {
  const PartId last = part_with(start_), first = part_with(end_);
  if (first == kNoPart || last == kNoPart) return false;
  parts_[first].place = middle_of(end_);
  parts_[first].next = first;
  parts_[first].cost = 0.0f;
  open_.push({0.0f, 0.0f, first});
  for (int taken = 0; !open_.empty() && taken < most_parts; ++taken) {
    if (deadline.has_passed(taken)) return false;
    const Open next = open_.top();
    open_.pop();
    if (next.part == last) return true;
    if (parts_[next.part].is_final) continue;
    parts_[next.part].is_final = true;
    expand(next.part);
  }
  return false;
}

void CellGuide::expand(PartId id) {
  const Part here = parts_[id];
  for (int step = 0; step < 27; ++step) {
    if (step != kCentre && voxels_moved(here.voxels, step, step) == 0) continue;
    const CellId next = around_.lattice.neighbour(here.cell, step);
    if (next == kNoCell) continue;
    const Met met = parts_of(next);
    for (PartId k = met.first; k < met.last; ++k) {
      Part& part = parts_[k];
      const float cost = here.cost + lattice_length(part.place - here.place);
      if (part.is_final || cost >= part.cost || !leads(here, part, step)) continue;
      if (part.next == kNoPart) part.rest = rest_of_search(next, part.place);
      part.cost = cost;
      part.next = id;
      open_.push({cost + static_cast<float>(kPlanning.cell_weight) * part.rest, cost, k});
    }
  }
}

/// `step`: the direction from cell to cell.
bool CellGuide::leads(const Part& from, const Part& to, int step) const {
  if (step != kCentre && leads(from, to, step, step)) return true;
  const VoxelIndex& s = offset_of(step);
  for (int move = 0; move < 27; ++move) {  // aslant
    const VoxelIndex& m = offset_of(move);
    if (move == step || move == kCentre || (s.x != 0 && s.x != m.x) || (s.y != 0 && s.y != m.y) ||
        (s.z != 0 && s.z != m.z))
      continue;
    if (leads(from, to, step, move)) return true;
  }
  return false;
}

bool CellGuide::leads(const Part& from, const Part& to, int step, int move) const {
  CellMask left = voxels_moved(from.voxels, step, move) & to.voxels;
  const VoxelIndex& m = offset_of(move);
  if (m.x * m.x + m.y * m.y + m.z * m.z == 1) return left != 0;  // across a face: free
  const BlockLayout& layout = around_.esdf.layout;
  const VoxelId first = layout.slot_at(to.cell / CellGraph::kPerBlock) * kBlockVoxels;
  for (; left != 0; left &= left - 1) {
    const VoxelId there =
        first + local_voxel(to.cell, static_cast<std::uint32_t>(std::countr_zero(left)));
    const VoxelId here = layout.neighbour(there, opposite(move));
    if (around_.space.move_is_free(here, there, move, around_.threshold)) return true;
  }
  return false;
}

const CellGuide::Met& CellGuide::parts_of(CellId cell) {
  Met& met = met_[cell];
  if (met.first != kNoPart) return met;
  met.first = static_cast<PartId>(parts_.size());
  const Place first = corner_of(around_.lattice.first_voxel(cell));
  for (CellMask left = voxels_for_robot(cell); left != 0;) {
    const CellMask part = left == ~CellMask{0} ? left : flood(left & (~left + 1), left);
    parts_.push_back({cell, part, first + middle_of(part)});
    left &= ~part;
  }
  met.last = static_cast<PartId>(parts_.size());
  return met;
}

/// Moves across faces between voxels that hold the robot are free for cylinders as for spheres: the
/// obstacle voxel that is nearest on the way is as near to one of its ends.
CellMask CellGuide::voxels_for_robot(CellId cell) const {
  const FreeSpace& space = around_.space;
  CellMask fitting = fitting_voxels(space, cell, around_.threshold);
  if (!space.is_narrowed()) return fitting;
  const BlockLayout& layout = around_.esdf.layout;
  const VoxelId first = layout.slot_at(cell / CellGraph::kPerBlock) * kBlockVoxels;
  for (CellMask left = fitting; left != 0; left &= left - 1) {
    const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
    const VoxelId id = first + local_voxel(cell, place);
    if (!space.is_within_limits(id) || !space.move_is_free(id, id, kCentre, around_.threshold))
      fitting &= ~(CellMask{1} << place);
  }
  return fitting;
}

CellGuide::PartId CellGuide::part_with(const VoxelIndex& voxel) {
  const CellId cell = around_.lattice.cell_of(voxel);
  if (cell == kNoCell) return kNoPart;
  const Met& met = parts_of(cell);
  for (PartId k = met.first; k < met.last; ++k)
    if ((parts_[k].voxels & bit_in_cell(voxel)) != 0) return k;
  return kNoPart;
}

float CellGuide::rest_of_search(CellId cell, const Place& place) const {
  float rest = lattice_length(place - middle_of(start_));
  if (lengths_.empty()) return rest;
  constexpr auto kShare = static_cast<float>(kPlanning.landmark_share);
  const auto& own = lengths_[cell / CellGraph::kPerBlock];
  for (std::size_t k = 0; k < own.size(); ++k)  // what is no number does not count
    rest = std::max(rest, kShare * std::abs(own[k] - start_lengths_[k]));
  return rest;
}

double CellGuide::rest_from(const VoxelIndex& voxel) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Met* met = met_.find(around_.lattice.cell_of(voxel));
  if (met == nullptr) return kNone;
  for (PartId k = met->first; k < met->last; ++k) {
    if ((parts_[k].voxels & bit_in_cell(voxel)) == 0) continue;
    if (parts_[k].next == kNoPart) break;
    const Part& next = parts_[parts_[k].next];
    return lattice_length(middle_of(voxel) - next.place) + next.cost;
  }
  return kNone;
}

}  // namespace ridgeway::detail
