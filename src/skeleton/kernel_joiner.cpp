// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "kernel_joiner.hpp"

#include <algorithm>
#include <queue>
#include <vector>

#include "by_height.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/disjoint_sets.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {
namespace {

/// Builds the diagram from the top of the clearance down and keeps, at every level, one
/// invariant: diagram voxels that space connects at this level are connected along the diagram at
/// this level; and from any voxel of a connected region that holds a diagram voxel, following
/// `next` leads to one.
///
/// Plain form: regions_at() in plain_regions.hpp, by which flooding space and the diagram has to
/// agree at every level. docs/fast-kernels.md section 5: arcs span regions (1), what is connected
/// at the level reached (2) is so at all above (3), and moves that dip (4).
class KernelJoiner {
 public:
  KernelJoiner(const RememberedSpace& space, SquaredHalves threshold, Basins& basins)
      : esdf_(space.map()),
        layout_(esdf_.layout),
        threshold_(threshold),
        basins_(basins),
        space_(space),
        regions_(basins.peaks.size()),
        anchored_(basins.peaks.size(), false),
        pieces_(0),
        moves_(NarrowerPass{&layout_}),
        diagram_(layout_) {}

  VoxelMask run(const VoxelMask& wanted) {
    const std::vector<VoxelId> voxels = highest_first(esdf_, wanted);
    piece_.reserve(2 * voxels.size());
    std::size_t pass = 0;
    const auto sink_to = [&](SquaredHalves level) {
      while (true) {
        constexpr SquaredHalves kNone(-1.0);
        const SquaredHalves move = moves_.empty() ? kNone : moves_.top().clearance;
        const SquaredHalves next_pass =
            pass < basins_.passes.size() ? basins_.passes[pass].clearance : kNone;
        if (std::max(move, next_pass) <= level) return;
        if (move >= next_pass) {
          pieces_.join(piece_of(moves_.top().from), piece_of(moves_.top().to));
          moves_.pop();
        } else {
          cross(basins_.passes[pass++]);
        }
      }
    };
    for (const VoxelId id : voxels) {
      stop_if_cancelled();
      sink_to(esdf_.squared[id]);
      if (!diagram_.test(id)) add_wanted(id);
    }
    sink_to(SquaredHalves());
    return diagram_;
  }

 private:
  VoxelId after(VoxelId id) const {
    return basins_.next[id] == kCentre ? kNoVoxel : layout_.neighbour(id, basins_.next[id]);
  }

  /// The way from a voxel, itself first, to the first diagram voxel on it, or to its end.
  std::vector<VoxelId> way_from(VoxelId id) const {
    std::vector<VoxelId> way{id};
    for (VoxelId next = after(id); next != kNoVoxel; next = after(next)) {
      way.push_back(next);
      if (diagram_.test(next)) break;
    }
    return way;
  }

  /// Turns the ways around so that all of a voxel's tree leads to it.
  void reroot(VoxelId id) {
    Direction incoming = kCentre;
    while (true) {
      const Direction outgoing = basins_.next[id];
      basins_.next[id] = incoming;
      if (outgoing == kCentre) return;
      id = layout_.neighbour(id, outgoing);
      incoming = static_cast<Direction>(opposite(outgoing));
    }
  }

  /// Takes a voxel into the diagram and connects it with the neighbours there, at once where the
  /// move is at least as wide as `level`, later where it is narrower but legal.
  void add_to_diagram(VoxelId id, SquaredHalves level) {
    const std::uint32_t piece = pieces_.add();
    piece_.add(id, mixed(id), piece);
    for (Cube27 cube = cube_around(layout_, diagram_, id) & kCells26; cube != 0; cube &= cube - 1) {
      const int d = std::countr_zero(cube);
      const VoxelId other = layout_.neighbour(id, d);
      const SquaredHalves width = space_.move_clearance(id, other, d);
      if (width >= level) {
        pieces_.join(piece, piece_of(other));
      } else if (width >= threshold_) {
        moves_.push({width, id, other});
      }
    }
    diagram_.set(id);
  }

  std::uint32_t piece_of(VoxelId id) const { return piece_.at(id, mixed(id)); }
  bool same_piece(VoxelId a, VoxelId b) {
    return pieces_.find(piece_of(a)) == pieces_.find(piece_of(b));
  }

  /// Adds all of a way that is nowhere narrower than `level`; it ends on the diagram.
  void add_way(const std::vector<VoxelId>& way, SquaredHalves level) {
    for (std::size_t i = way.size(); i-- > 0;) {
      if (!diagram_.test(way[i])) add_to_diagram(way[i], level);
      if (i + 1 < way.size()) pieces_.join(piece_of(way[i]), piece_of(way[i + 1]));
    }
  }

  void add_wanted(VoxelId id) {
    const std::vector<VoxelId> way = way_from(id);
    const SquaredHalves level = esdf_.squared[id];
    const bool reaches = way.size() > 1 && diagram_.test(way.back());
    add_to_diagram(id, level);
    if (!reaches) {  // the first diagram voxel of its region
      reroot(id);
      anchored_[regions_.find(basins_.basin[id])] = true;
    } else if (!same_piece(id, way.back())) {
      add_way(way, level);
    }
  }

  /// Two regions of space meet.
  void cross(const Pass& pass) {
    std::uint32_t a = regions_.find(basins_.basin[pass.from]);
    std::uint32_t b = regions_.find(basins_.basin[pass.to]);
    VoxelId from = pass.from, to = pass.to;
    const bool both = anchored_[a] && anchored_[b];
    if (both) {
      const std::vector<VoxelId> left = way_to_diagram(from), right = way_to_diagram(to);
      if (!same_piece(left.back(), right.back())) {
        add_way(left, pass.clearance);
        add_way(right, pass.clearance);
        pieces_.join(piece_of(from), piece_of(to));
      }
    } else {
      if (anchored_[b]) std::swap(from, to);
      reroot(to);  // the region without a diagram voxel now leads over the pass
      const VoxelIndex o = layout_.index_of(from) - layout_.index_of(to);
      basins_.next[to] = static_cast<Direction>(direction_of(o));
    }
    const bool anchored = anchored_[a] || anchored_[b];
    anchored_[regions_.join(a, b)] = anchored;
  }

  std::vector<VoxelId> way_to_diagram(VoxelId id) const {
    return diagram_.test(id) ? std::vector<VoxelId>{id} : way_from(id);
  }

  const EsdfMap& esdf_;
  const BlockLayout& layout_;
  const SquaredHalves threshold_;
  Basins& basins_;
  const RememberedSpace& space_;
  DisjointSets regions_;        // of basins
  std::vector<bool> anchored_;  // by region: holds a diagram voxel
  DisjointSets pieces_;         // of diagram voxels
  FlatTable<VoxelId, std::uint32_t> piece_;
  std::priority_queue<Pass, std::vector<Pass>, NarrowerPass>
      moves_;  // legal but narrower than ends
  VoxelMask diagram_;
};

}  // namespace

VoxelMask join_kernel(const RememberedSpace& space, const VoxelMask& kernel,
                      SquaredHalves threshold, Basins& basins) {
  return KernelJoiner(space, threshold, basins).run(kernel);
}

}  // namespace ridgeway::detail
