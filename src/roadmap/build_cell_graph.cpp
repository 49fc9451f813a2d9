// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "cell_neighbours.hpp"
#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway {
namespace {

using detail::CellId;
using detail::CellLattice;
using detail::kPlanning;

/// Distance of a voxel's centre from that of its cell, voxels.
double off_centre(int place) {
  const double middle = 0.5 * (CellGraph::kSide - 1);
  return Point((place & 3) - middle, (place >> 2 & 3) - middle, (place >> 4) - middle).norm();
}

/// The voxels of a cell, those nearest to its centre first.
std::array<std::uint8_t, CellGraph::kNoPlace> from_centre_out() {
  std::array<std::uint8_t, CellGraph::kNoPlace> places{};
  std::iota(places.begin(), places.end(), std::uint8_t{0});
  std::stable_sort(places.begin(), places.end(),
                   [](int a, int b) { return off_centre(a) < off_centre(b); });
  return places;
}

class CellGraphBuilder {
 public:
  CellGraphBuilder(const EsdfMap& esdf, double radius)
      : esdf_(esdf), space_(esdf), lattice_(esdf.layout), radius_(radius) {}

  CellGraph run() {
    const std::size_t count = std::size_t{CellGraph::kPerBlock} * esdf_.layout.block_count();
    cells_.resize(count);
    parallel_for_each_index(
        esdf_.layout.block_count(),
        [&](std::size_t rank) {
          if (!has_room(static_cast<std::uint32_t>(rank))) return;
          for (CellId i = 0; i < CellGraph::kPerBlock; ++i)
            choose_place(static_cast<CellId>(rank) * CellGraph::kPerBlock + i);
        },
        16);
    parallel_for_each_index(
        count, [&](std::size_t i) { link(static_cast<CellId>(i)); }, 64);
    number_parts();
    return {std::move(cells_)};
  }

 private:
  VoxelId voxel_of(CellId cell, std::uint8_t place) const {
    const std::uint32_t slot = esdf_.layout.slot_at(cell / CellGraph::kPerBlock);
    const auto coordinate = [&](int axis) {
      return (cell >> axis & 1u) * CellGraph::kSide + (place >> 2 * axis & 3u);
    };
    return slot * kBlockVoxels +
           (coordinate(0) | coordinate(1) << kBlockBits | coordinate(2) << 2 * kBlockBits);
  }
  Point place_of(CellId cell) const {
    return centre_of(lattice_.voxel_at(cell, cells_[cell].place), esdf_.voxel_size);
  }

  /// Whether the robot may fit on a voxel of a block.
  bool has_room(std::uint32_t rank) const {
    const VoxelId first = esdf_.layout.slot_at(rank) * kBlockVoxels;
    std::uint32_t widest = 0;
    for (VoxelId id = first; id < first + kBlockVoxels; ++id)
      widest = std::max(widest, esdf_.squared[id]);
    return widest >= least_clearance(radius_, esdf_.voxel_size);
  }

  /// Wide, but no wider than pays, and near the middle: there most neighbours are in sight.
  void choose_place(CellId cell) {
    static const auto kPlaces = from_centre_out();
    const SquaredHalves threshold = least_clearance(radius_, esdf_.voxel_size);
    const double enough = radius_ / esdf_.voxel_size + kPlanning.cell_room;
    double best = -std::numeric_limits<double>::infinity();
    for (const std::uint8_t place : kPlaces) {
      const VoxelId id = voxel_of(cell, place);
      if (esdf_.squared[id] < threshold || esdf_.state[id] != VoxelState::kFree) continue;
      const double width = 0.5 * std::sqrt(static_cast<double>(esdf_.squared[id]));
      const double worth = std::min(width, enough) - kPlanning.cell_centring * off_centre(place);
      if (worth > best) {
        best = worth;
        cells_[cell].place = place;
      }
      if (width >= enough) return;  // those after it are farther off
    }
  }

  void link(CellId cell) {
    if (cells_[cell].place == CellGraph::kNoPlace) return;
    for (int d = kCentre + 1; d < 27; ++d) {
      const CellId other = lattice_.neighbour(cell, d);
      if (other == detail::kNoCell || cells_[other].place == CellGraph::kNoPlace) continue;
      const double code = CellGraph::kCodesPerRadius * clearance_between(cell, other) / radius_;
      cells_[cell].clearance[static_cast<std::size_t>(d - kCentre - 1)] =
          static_cast<std::uint8_t>(std::min(code + 1e-6, 255.0));
    }
  }

  /// A bound from the two ends where that is enough; else whether the smallest robot fits.
  double clearance_between(CellId a, CellId b) const {
    const VoxelId from = voxel_of(a, cells_[a].place), to = voxel_of(b, cells_[b].place);
    const VoxelIndex along =
        lattice_.voxel_at(b, cells_[b].place) - lattice_.voxel_at(a, cells_[a].place);
    const SquaredHalves bound =
        FreeSpace::move_bound(esdf_.squared[from], esdf_.squared[to],
                              along.x * along.x + along.y * along.y + along.z * along.z);
    const bool is_wide = bound >= least_clearance(radius_, esdf_.voxel_size);
    if (is_wide && (esdf_.unknown == UnknownPolicy::kObstacle ||
                    space_.is_known_free(place_of(a), place_of(b))))
      return std::max(radius_, bound.metres(esdf_.voxel_size));
    return space_.is_free(place_of(a), place_of(b), radius_) ? radius_ : 0.0;
  }

  void number_parts() {
    std::vector<CellId> open;
    std::uint16_t part = 0;
    for (CellId first = 0; first < cells_.size(); ++first) {
      if (cells_[first].place == CellGraph::kNoPlace || cells_[first].part != CellGraph::kNoPart)
        continue;
      if (part == CellGraph::kNoPart) return;
      cells_[first].part = part;
      for (open.assign(1, first); !open.empty();) {
        const CellId cell = open.back();
        open.pop_back();
        for (int d = 0; d < 27; ++d) {
          if (d == kCentre) continue;
          const CellId next = lattice_.neighbour(cell, d);
          if (next == detail::kNoCell || detail::edge_code(cells_, cell, next, d) == 0 ||
              cells_[next].part != CellGraph::kNoPart)
            continue;
          cells_[next].part = part;
          open.push_back(next);
        }
      }
      ++part;
    }
  }

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const CellLattice lattice_;
  const double radius_;
  std::vector<CellGraph::Cell> cells_;
};

}  // namespace

CellGraph build_cell_graph(const EsdfMap& esdf, double min_clearance) {
  return CellGraphBuilder(esdf, min_clearance).run();
}

}  // namespace ridgeway
