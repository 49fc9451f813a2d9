// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>

#include "cell_bends.hpp"
#include "cell_neighbours.hpp"
#include "cell_walks.hpp"
#include "common/require.hpp"
#include "open_parts.hpp"
#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

using detail::CellId;
using detail::CellLattice;
using detail::kPlanning;
using detail::kRadiusLevels;
static_assert(kRadiusLevels.size() == CellGraph::kLevels);

struct PlaceInCell {
  double off;          ///< its centre from that of the cell, weighed, voxels
  std::uint8_t place;  ///< as CellGraph::Cell has it
  VoxelId local;       ///< its number less that of the cell's first voxel
};

/// The voxels of a cell, those nearest to its centre first.
std::array<PlaceInCell, CellGraph::kNoPlace> from_centre_out() {
  std::array<PlaceInCell, CellGraph::kNoPlace> places{};
  const double middle = 0.5 * (CellGraph::kSide - 1);
  for (std::uint8_t i = 0; i < CellGraph::kNoPlace; ++i) {
    const Point off((i & 3) - middle, (i >> 2 & 3) - middle, (i >> 4) - middle);
    places[i] = {kPlanning.cell_centring * off.norm(), i, detail::local_voxel(0, i)};
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const PlaceInCell& a, const PlaceInCell& b) { return a.off < b.off; });
  return places;
}

class CellGraphBuilder {
 public:
  CellGraphBuilder(const EsdfMap& esdf, double radius)
      : esdf_(esdf),
        space_(esdf),
        lattice_(esdf.layout),
        radius_(radius),
        is_plain_(esdf.unknown == UnknownPolicy::kObstacle && !esdf.limits.any()) {
    for (std::size_t i = 0; i < thresholds_.size(); ++i)
      thresholds_[i] = least_clearance(radius * kRadiusLevels[i], esdf.voxel_size);
    least_ = static_cast<std::uint32_t>(
        std::min(std::ceil(thresholds_.front().value), static_cast<double>(kNoSite)));
  }

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
    parallel_for_each_index(
        count, [&](std::size_t i) { look_all_around(static_cast<CellId>(i)); }, 64);
    detail::add_bends(space_, radius_, graph_);
    parallel_for_each_index(2, [&](std::size_t task) {  // neither of which knows of the other
      if (task == 0) return detail::place_cell_landmarks(esdf_.layout, graph_);
      number_parts();
      graph_.open_parts = detail::find_open_parts(esdf_, radius_);
    });
    return std::move(graph_);
  }

 private:
  VoxelId voxel_of(CellId cell, std::uint8_t place) const {
    return esdf_.layout.slot_at(cell / CellGraph::kPerBlock) * kBlockVoxels +
           detail::local_voxel(cell, place);
  }

  /// The voxel at which a cell is passed, and how far it is from obstacles.
  struct Passed {
    SquaredHalves squared;
    VoxelIndex voxel;
  };
  /// That of a cell, whose first voxel is known.
  Passed passed_in(CellId cell, const VoxelIndex& first) const {
    const std::uint8_t place = cells_[cell].place;
    return {esdf_.known_squared(voxel_of(cell, place)), first + detail::offset_of_place(place)};
  }

  /// Whether the robot may fit on a voxel of a block.
  bool has_room(std::uint32_t rank) const {
    const std::uint32_t* squared = esdf_.squared.block(esdf_.layout.slot_at(rank));
    return std::any_of(squared, squared + kBlockVoxels,
                       [&](std::uint32_t own) { return own >= least_; });
  }

  /// Wide, but no wider than the widest robots need to turn, and near the middle: there most
  /// neighbours are in sight.
  void choose_place(CellId cell) {
    constexpr double kSlack = 1.0 - 1e-9;  // of what rounding may do to a root and its square
    static const auto kPlaces = from_centre_out();
    const double enough = kRadiusLevels.back() * radius_ / esdf_.voxel_size + kPlanning.cell_room;
    double best = -std::numeric_limits<double>::infinity();
    const VoxelId first = voxel_of(cell, 0);
    const std::uint32_t* squared = &esdf_.squared[first];
    for (const auto& [off, place, local] : kPlaces) {
      if (enough - off <= best) return;  // so are those after it
      if (squared[local] < least_) continue;
      const double own = squared[local], wider = 2.0 * std::max(best + off, 0.0);
      if (own < kSlack * wider * wider) continue;
      const VoxelId id = first + local;
      if (!esdf_.is_open(id) || !space_.is_within_limits(id)) continue;
      const double width = 0.5 * std::sqrt(own);
      if (const double worth = std::min(width, enough) - off; worth > best) {
        best = worth;
        cells_[cell].place = place;
      }
    }
  }

  void link(CellId cell) {
    if (cells_[cell].place == CellGraph::kNoPlace) return;
    const VoxelIndex first = lattice_.first_voxel(cell);
    const Passed here = passed_in(cell, first);
    for (int d = kCentre + 1; d < 27; ++d) {
      const CellId other = lattice_.neighbour(cell, d);
      if (other == detail::kNoCell || cells_[other].place == CellGraph::kNoPlace) continue;
      const VoxelIndex& o = offset_of(d);
      const VoxelIndex step{CellGraph::kSide * o.x, CellGraph::kSide * o.y, CellGraph::kSide * o.z};
      cells_[cell].widths[static_cast<std::size_t>(d - kCentre - 1)] =
          width_between(here, passed_in(other, first + step));
    }
  }

  void look_all_around(CellId cell) {
    if (cells_[cell].place == CellGraph::kNoPlace) return;
    auto least = static_cast<std::uint8_t>(kRadiusLevels.size());
    for (int d = 0; d < 27 && least > 0; ++d) {
      if (d == kCentre) continue;
      const CellId other = lattice_.neighbour(cell, d);
      least = other == detail::kNoCell
                  ? std::uint8_t{0}
                  : std::min(least, detail::edge_width(cells_, cell, other, d));
    }
    cells_[cell].all_around = least;
  }

  /// How many of the levels of radii pass between two places. Only for small robots single
  /// obstacles are looked at.
  std::uint8_t width_between(const Passed& a, const Passed& b) const {
    const VoxelIndex along = b.voxel - a.voxel;
    const int apart2 = along.x * along.x + along.y * along.y + along.z * along.z;
    const SquaredHalves ends = std::min(a.squared, b.squared);
    if (is_plain_ && ends.value - apart2 >= thresholds_.back().value)
      return static_cast<std::uint8_t>(thresholds_.size());  // move_bound is no less
    const SquaredHalves bound = FreeSpace::move_bound(a.squared, b.squared, apart2);
    const Point place = centre_of(a.voxel, esdf_.voxel_size),
                other = centre_of(b.voxel, esdf_.voxel_size);
    if (!space_.is_within_limits(place, other)) return 0;
    const bool is_known = esdf_.unknown == UnknownPolicy::kObstacle ||
                          (bound >= thresholds_.front() && space_.is_known_free(place, other));
    std::uint8_t width = levels_below(ends);
    const std::uint8_t sure = is_known ? levels_below(bound) : 0;
    for (; width > sure; --width) {
      const double radius = radius_ * kRadiusLevels[width - 1];
      if (width > 2 ? space_.is_clearly_free(place, other, radius)
                    : space_.is_free(place, other, radius))
        break;
    }
    return width;
  }

  std::uint8_t levels_below(SquaredHalves clearance) const {
    std::uint8_t levels = 0;
    while (levels < thresholds_.size() && clearance >= thresholds_[levels]) ++levels;
    return levels;
  }

  /// For each level of radii, of the edges and bends that let it through. Wider robots pass less,
  /// so their parts only grow together towards the smallest.
  void number_parts() {
    DisjointSets parts(cells_.size() + graph_.nooks.size());
    for (std::size_t level = CellGraph::kLevels; level-- > 0;) {
      join_what_passes(level, parts);
      number_parts(level, parts);
    }
  }

  /// Over what lets this level of radii through, but no wider one.
  void join_what_passes(std::size_t level, DisjointSets& parts) const {
    for (CellId cell = 0; cell < cells_.size(); ++cell) {
      if (cells_[cell].place == CellGraph::kNoPlace) continue;
      for (std::size_t i = 0; i < cells_[cell].widths.size(); ++i)
        if (cells_[cell].widths[i] == level + 1)
          parts.join(cell, lattice_.neighbour(cell, kCentre + 1 + static_cast<int>(i)));
    }
    for (const CellGraph::Bend& bend : graph_.bends)
      if (bend.width == level + 1) parts.join(bend.from, bend.to);
  }

  /// In the order of their first places.
  void number_parts(std::size_t level, DisjointSets& parts) {
    const CellId cells = static_cast<CellId>(cells_.size());
    const auto places = static_cast<CellId>(cells + graph_.nooks.size());
    const auto part_of = [&](CellId place) -> std::uint16_t& {
      return place < cells ? cells_[place].parts[level] : graph_.nooks[place - cells].parts[level];
    };
    std::uint16_t next = 0;
    for (CellId place = 0; place < places; ++place) {
      if (detail::number_in_cell(graph_, place) == CellGraph::kNoPlace) continue;
      std::uint16_t& part = part_of(parts.find(place));
      if (part == CellGraph::kNoPart && next != CellGraph::kNoPart) part = next++;
      part_of(place) = part;
    }
  }

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const CellLattice lattice_;
  const double radius_;
  const bool is_plain_;  ///< nothing but distances decides whether a segment is free
  std::array<SquaredHalves, kRadiusLevels.size()> thresholds_;
  std::uint32_t least_ = 0;  ///< squared distance, as the map has it, of what the robot fits on
  CellGraph graph_;
  std::vector<CellGraph::Cell>& cells_ = graph_.cells;
};

}  // namespace

CellGraph build_cell_graph(const EsdfMap& esdf, double min_clearance) {
  detail::require(min_clearance >= 0.0 && std::isfinite(min_clearance), "min_clearance",
                  min_clearance, "give the robot's radius in metres, 0 or more");
  if (esdf.planar) return {};  // its cells would be layers beside the one that flights are in
  return CellGraphBuilder(esdf, min_clearance).run();
}

}  // namespace ridgeway
