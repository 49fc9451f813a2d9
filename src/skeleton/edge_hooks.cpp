// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "edge_hooks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <span>
#include <vector>

#include "by_height.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/disjoint_sets.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::size_t kBesideSteps = 2;  // an edge this near to the diagram runs beside it
constexpr double kPatience = 1.0;        // voxels of clearance a piece may sink before it is hooked

class EdgeHooks {
 public:
  EdgeHooks(const RememberedSpace& space, SquaredHalves threshold, const Basins& basins,
            VoxelMask& diagram)
      : esdf_(space.map()),
        layout_(esdf_.layout),
        threshold_(threshold),
        basins_(basins),
        space_(space),
        exact_(diagram),
        diagram_(diagram) {}

  void run(const VoxelMask& edges) {
    const std::vector<VoxelId> voxels = highest_first(esdf_, without_exact(edges));
    piece_.reserve(voxels.size());
    for (const VoxelId id : voxels) {
      stop_if_cancelled();
      sink_to(esdf_.squared[id]);
      if (!diagram_.test(id)) add(id);
    }
    sink_to(SquaredHalves());
  }

 private:
  VoxelMask without_exact(VoxelMask edges) const {
    remove_members(edges, exact_);
    return edges;
  }

  /// Something that happens once the level has sunk to it: two voxels of pieces connect, or
  /// (from == to) a voxel's piece has waited long enough.
  struct Event {
    SquaredHalves level;
    VoxelId from, to;
  };

  /// Order of a queue whose top has the highest level; equal ones in the order of their voxels.
  struct Later {
    const BlockLayout* layout;
    bool operator()(const Event& a, const Event& b) const {
      if (a.level != b.level) return a.level < b.level;
      return a.from != b.from ? layout->order_of(a.from) > layout->order_of(b.from)
                              : layout->order_of(a.to) > layout->order_of(b.to);
    }
  };

  void sink_to(SquaredHalves level) {
    while (!events_.empty() && events_.top().level > level) {
      const Event event = events_.top();
      events_.pop();
      if (event.from == event.to) {
        if (!is_hooked(event.from)) hook(event.from);
      } else {
        connect(event.from, event.to);
      }
    }
  }

  void add(VoxelId id) {
    const SquaredHalves level = esdf_.squared[id];
    const std::uint32_t piece = pieces_.add();
    hooked_.push_back(false);
    struct Move {
      SquaredHalves width;
      VoxelId other;
    };
    std::array<Move, 26> moves;
    std::size_t count = 0;
    bool alone = true;
    for (Cube27 cube = cube_around(layout_, diagram_, id) & kCells26; cube != 0; cube &= cube - 1) {
      const int d = std::countr_zero(cube);
      const VoxelId other = layout_.neighbour(id, d);
      const SquaredHalves width = space_.move_clearance(id, other, d);
      if (width >= threshold_) moves[count++] = {width, other};
      alone &= width < level;
    }
    if (alone && is_beside_diagram(id)) return;
    piece_.add(id, mixed(id), piece);
    diagram_.set(id);
    for (const Move& move : std::span(moves).first(count)) {
      if (move.width >= level) {
        connect(id, move.other);
      } else {
        events_.push({move.width, id, move.other});
      }
    }
    const double sunk = std::max(std::sqrt(level.value) - 2.0 * kPatience, 0.0);
    if (!is_hooked(id)) events_.push({std::max(SquaredHalves(sunk * sunk), threshold_), id, id});
  }

  std::uint32_t piece_of(VoxelId id) const { return piece_.at(id, mixed(id)); }
  bool is_hooked(VoxelId id) { return exact_.test(id) || hooked_[pieces_.find(piece_of(id))]; }

  void connect(VoxelId a, VoxelId b) {
    if (exact_.test(a)) std::swap(a, b);
    const bool hooked = is_hooked(a) || is_hooked(b);
    std::uint32_t piece = pieces_.find(piece_of(a));
    if (!exact_.test(b)) piece = pieces_.join(piece, piece_of(b));
    hooked_[piece] = hooked;
  }

  VoxelId after(VoxelId id) const { return layout_.neighbour(id, basins_.next[id]); }

  /// Whether the way from a voxel is on the diagram within so few steps.
  bool is_beside_diagram(VoxelId id) const {
    for (std::size_t step = 0; step < kBesideSteps; ++step) {
      id = after(id);
      if (diagram_.test(id)) return true;
    }
    return false;
  }

  /// Adds the way from a voxel up to a hooked part of the diagram.
  void hook(VoxelId top) {
    VoxelId id = top;
    while (true) {
      const VoxelId next = after(id);
      if (!diagram_.test(next)) {
        piece_.add(next, mixed(next), pieces_.add());
        hooked_.push_back(false);
        diagram_.set(next);
      }
      const bool arrived = is_hooked(next);
      connect(id, next);
      if (arrived) return;
      id = next;
    }
  }

  const EsdfMap& esdf_;
  const BlockLayout& layout_;
  const SquaredHalves threshold_;
  const Basins& basins_;
  const RememberedSpace& space_;
  const VoxelMask exact_;  // the diagram as it was: everything on it is connected
  VoxelMask& diagram_;
  DisjointSets pieces_{0};
  std::vector<bool> hooked_;  // by piece: connected with the exact diagram
  FlatTable<VoxelId, std::uint32_t> piece_;
  std::priority_queue<Event, std::vector<Event>, Later> events_{Later{&layout_}};
};

}  // namespace

void hook_edges(const RememberedSpace& space, const VoxelMask& edges, SquaredHalves threshold,
                const Basins& basins, VoxelMask& diagram) {
  EdgeHooks(space, threshold, basins, diagram).run(edges);
}

}  // namespace ridgeway::detail
