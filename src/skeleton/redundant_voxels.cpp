// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "redundant_voxels.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "by_height.hpp"
#include "parallel_deletion.hpp"
#include "simple_point.hpp"

namespace ridgeway::detail {
namespace {

struct Neighbour {
  VoxelId id;
  int direction;
  SquaredHalves width;  // of the move over the centre
};

/// Width of the move between two neighbours of a voxel, or 0 where they are not adjacent.
SquaredHalves width_between(const RememberedSpace& space, const Neighbour& a, const Neighbour& b) {
  const VoxelIndex o = offset_of(b.direction) - offset_of(a.direction);
  if (std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) > 1) return SquaredHalves();
  return space.move_clearance(a.id, b.id, direction_of(o));
}

/// Whether each pair of neighbours is connected without the centre as widely as over it.
bool can_do_without(const RememberedSpace& space, SquaredHalves threshold, VoxelId id,
                    Cube27 cube) {
  std::array<Neighbour, 26> neighbours;
  std::size_t count = 0;
  for (Cube27 cells = cube & kCells26; cells != 0; cells &= cells - 1) {
    const int d = std::countr_zero(cells);
    const VoxelId other = space.map().layout.neighbour(id, d);
    const SquaredHalves width = space.move_clearance(id, other, d);
    if (width >= threshold) neighbours[count++] = {other, d, width};
  }
  std::sort(neighbours.begin(), neighbours.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Neighbour& a, const Neighbour& b) { return a.width > b.width; });
  // Each one, widest first, must hang on a wider one without the centre.
  for (std::size_t i = 1; i < count; ++i) {
    std::array<bool, 26> reached{};
    std::vector<std::size_t> stack{i};
    reached[i] = true;
    bool hangs = false;
    while (!stack.empty() && !hangs) {
      const std::size_t from = stack.back();
      stack.pop_back();
      for (std::size_t to = 0; to < count; ++to) {
        if (reached[to] ||
            width_between(space, neighbours[from], neighbours[to]) < neighbours[i].width)
          continue;
        reached[to] = true;
        hangs |= to < i;
        stack.push_back(to);
      }
    }
    if (!hangs) return false;
  }
  return count > 0;
}

}  // namespace

void remove_redundant_voxels(const RememberedSpace& space, SquaredHalves threshold,
                             const Basins& basins, VoxelMask& diagram) {
  const EsdfMap& esdf = space.map();
  std::vector<VoxelId> work = diagram.members(esdf.layout);
  const auto may_go = [&](VoxelId id, Cube27 cube) {
    return basins.next[id] != kCentre && is_simple(cube) && !is_curve_end(cube) &&
           can_do_without(space, threshold, id, cube);
  };
  // What may go depends on what is left around it alone. So all are asked at once, and again those
  // around which a voxel has gone when their turn comes.
  struct Answer {
    Cube27 cube;
    bool may_go;
  };
  std::vector<Answer> answers;
  while (!work.empty()) {
    sort_lowest_first(esdf, work);
    answers.resize(work.size());
    parallel_for_each_index(
        work.size(),
        [&](std::size_t i) {
          const Cube27 cube = cube_around(esdf.layout, diagram, work[i]);
          answers[i] = {cube, may_go(work[i], cube)};
        },
        64);
    std::vector<VoxelId> deleted;
    for (std::size_t i = 0; i < work.size(); ++i) {
      const Cube27 cube = cube_around(esdf.layout, diagram, work[i]);
      if (!(cube == answers[i].cube ? answers[i].may_go : may_go(work[i], cube))) continue;
      diagram.reset(work[i]);
      deleted.push_back(work[i]);
    }
    work = neighbours_of(esdf.layout, diagram, deleted);
  }
}

}  // namespace ridgeway::detail
