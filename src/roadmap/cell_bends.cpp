// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_bends.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "cell_walks.hpp"
#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

class BendFinder {
 public:
  BendFinder(const FreeSpace& space, double radius, CellGraph& graph)
      : esdf_(space.map()), space_(space), lattice_(esdf_.layout), graph_(graph) {
    for (std::size_t i = 0; i < thresholds_.size(); ++i)
      thresholds_[i] = least_clearance(radius * kRadiusLevels[i], esdf_.voxel_size);
  }

  void run() {
    gather(graph_.nooks,
           [&](CellId cell, std::vector<CellGraph::Nook>& nooks) { find_nooks(cell, nooks); });
    has_nooks_.resize(graph_.cells.size());
    for (const CellGraph::Nook& nook : graph_.nooks) has_nooks_[nook.cell] = 1;
    gather(graph_.bends, [&](CellId cell, std::vector<CellGraph::Bend>& bends) {
      for (int axis = 0; axis < 3; ++axis) find_bends(cell, axis, bends);
    });
    both_ways();
  }

 private:
  /// What find(cell, found) finds for each cell that has a place, in the order of cells.
  template <typename Found, typename Find>
  void gather(std::vector<Found>& all, const Find& find) {
    std::vector<std::vector<Found>> of_block(esdf_.layout.block_count());
    parallel_for_each_index(
        of_block.size(),
        [&](std::size_t rank) {
          for (CellId i = 0; i < CellGraph::kPerBlock; ++i) {
            const CellId cell = static_cast<CellId>(rank) * CellGraph::kPerBlock + i;
            if (graph_.cells[cell].place != CellGraph::kNoPlace) find(cell, of_block[rank]);
          }
        },
        16);
    for (const std::vector<Found>& found : of_block)
      all.insert(all.end(), found.begin(), found.end());
  }

  CellMask fitting(CellId cell, std::size_t level) const {
    return fitting_voxels(space_, cell, thresholds_[level]);
  }
  SquaredHalves clearance_at(CellId cell, unsigned place) const {
    const std::uint32_t slot = esdf_.layout.slot_at(cell / CellGraph::kPerBlock);
    return esdf_.known_squared(slot * kBlockVoxels + local_voxel(cell, place));
  }

  /// Whether all voxels of a cell are certainly free, as its place is far from everything.
  bool is_wide_open(CellId cell) const {
    constexpr double kDiagonal = 5.2;  // between two of its voxels at most, voxels
    const double least = 0.5 * std::sqrt(thresholds_.front().value) + kDiagonal;
    return esdf_.unknown == UnknownPolicy::kObstacle && space_.limits() == nullptr &&
           clearance_at(cell, graph_.cells[cell].place) >= SquaredHalves(4.0 * least * least);
  }

  void find_nooks(CellId cell, std::vector<CellGraph::Nook>& nooks) const {
    if (is_wide_open(cell)) return;
    const CellMask room = fitting(cell, 0);
    CellMask left = room & ~flood(bit_of(graph_.cells[cell].place), room);
    while (left != 0) {
      const CellMask part = flood(left & ~(left - 1), left);
      left &= ~part;
      nooks.push_back({cell, widest(cell, part)});
    }
  }

  std::uint8_t widest(CellId cell, CellMask voxels) const {
    auto best = static_cast<unsigned>(std::countr_zero(voxels));
    for (; voxels != 0; voxels &= voxels - 1)
      if (const auto place = static_cast<unsigned>(std::countr_zero(voxels));
          clearance_at(cell, best) < clearance_at(cell, place))
        best = place;
    return static_cast<std::uint8_t>(best);
  }

  std::size_t levels_at(CellId place) const {
    const SquaredHalves clearance =
        clearance_at(cell_of_place(graph_, place), number_in_cell(graph_, place));
    std::size_t levels = 0;
    while (levels < thresholds_.size() && clearance >= thresholds_[levels]) ++levels;
    return levels;
  }

  /// Between all places of a cell and of the next one along an axis.
  void find_bends(CellId cell, int axis, std::vector<CellGraph::Bend>& bends) const {
    const CellId next = lattice_.neighbour(cell, along(axis));
    if (next == kNoCell || graph_.cells[next].place == CellGraph::kNoPlace) return;
    const std::size_t width = edge_width(graph_.cells, cell, next, along(axis));
    find_bend(cell, next, axis, width, bends);
    if (has_nooks_[cell] == 0 && has_nooks_[next] == 0) return;
    const PlaceRange own = nooks_of(graph_, cell), others = nooks_of(graph_, next);
    for (CellId b = others.first; b < others.last; ++b) find_bend(cell, b, axis, 0, bends);
    for (CellId a = own.first; a < own.last; ++a) {
      find_bend(a, next, axis, 0, bends);
      for (CellId b = others.first; b < others.last; ++b) find_bend(a, b, axis, 0, bends);
    }
  }

  /// The widest bend, where it is wider than the straight edge.
  void find_bend(CellId a, CellId b, int axis, std::size_t straight,
                 std::vector<CellGraph::Bend>& bends) const {
    if (straight == thresholds_.size()) return;
    const std::uint8_t from = number_in_cell(graph_, a);
    const auto to = static_cast<std::uint8_t>(64 + number_in_cell(graph_, b));
    for (std::size_t width = std::min(levels_at(a), levels_at(b)); width > straight; --width) {
      const CellWalks walks({fitting(cell_of_place(graph_, a), width - 1),
                             fitting(cell_of_place(graph_, b), width - 1)},
                            axis);
      const std::vector<std::uint8_t> walk = walks.walk(from, to);
      if (walk.empty()) continue;
      bends.push_back({a, b, length_of_walk(walk, axis), static_cast<std::uint8_t>(width)});
      return;
    }
  }

  void both_ways() {
    std::vector<CellGraph::Bend>& bends = graph_.bends;
    const std::size_t count = bends.size();
    bends.reserve(2 * count);
    for (std::size_t i = 0; i < count; ++i)
      bends.push_back({bends[i].to, bends[i].from, bends[i].length, bends[i].width});
    std::sort(bends.begin(), bends.end(), [](const CellGraph::Bend& a, const CellGraph::Bend& b) {
      return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });
    for (const CellGraph::Bend& bend : bends)
      if (bend.from < graph_.cells.size()) graph_.cells[bend.from].has_bends = true;
  }

  const EsdfMap& esdf_;
  const FreeSpace& space_;
  const CellLattice lattice_;
  CellGraph& graph_;
  std::array<SquaredHalves, kRadiusLevels.size()> thresholds_;
  std::vector<char> has_nooks_;  // by cell
};

}  // namespace

void add_bends(const FreeSpace& space, double radius, CellGraph& graph) {
  BendFinder(space, radius, graph).run();
}

std::span<const CellGraph::Bend> bends_from(const CellGraph& graph, CellId place) {
  const auto first =
      std::lower_bound(graph.bends.begin(), graph.bends.end(), place,
                       [](const CellGraph::Bend& bend, CellId from) { return bend.from < from; });
  auto last = first;
  while (last != graph.bends.end() && last->from == place) ++last;
  return std::span(graph.bends)
      .subspan(static_cast<std::size_t>(first - graph.bends.begin()),
               static_cast<std::size_t>(last - first));
}

PlaceRange nooks_of(const CellGraph& graph, CellId cell) {
  const auto first =
      std::lower_bound(graph.nooks.begin(), graph.nooks.end(), cell,
                       [](const CellGraph::Nook& nook, CellId of) { return nook.cell < of; });
  auto last = first;
  while (last != graph.nooks.end() && last->cell == cell) ++last;
  const auto place = [&](auto nook) {
    return static_cast<CellId>(graph.cells.size() +
                               static_cast<std::size_t>(nook - graph.nooks.begin()));
  };
  return {place(first), place(last)};
}

std::vector<VoxelIndex> way_over_bend(const CellGraph& graph, const FreeSpace& space, CellId from,
                                      CellId to, SquaredHalves threshold) {
  const CellLattice lattice(space.map().layout);
  const VoxelIndex step = lattice.first_voxel(cell_of_place(graph, to)) -
                          lattice.first_voxel(cell_of_place(graph, from));
  const bool is_onward = step.x + step.y + step.z > 0;
  if (!is_onward) std::swap(from, to);
  const CellId first = cell_of_place(graph, from), second = cell_of_place(graph, to);
  const int axis = step.x != 0 ? 0 : step.y != 0 ? 1 : 2;
  const CellWalks walks(
      {fitting_voxels(space, first, threshold), fitting_voxels(space, second, threshold)}, axis);
  const auto goal = static_cast<std::uint8_t>(64 + number_in_cell(graph, to));
  std::vector<VoxelIndex> way;
  for (const std::uint8_t place : walks.walk(number_in_cell(graph, from), goal))
    way.push_back(lattice.first_voxel(first) + step_to(place, axis));
  if (!is_onward) std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace ridgeway::detail
