// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "vertex_selection.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "best_first_search.hpp"

namespace ridgeway::detail {
namespace {

/// Visits the voxels within `radius` of a start along the diagram, itself included.
template <typename Visit>
void visit_near(const DiagramCurves& curves, DiagramNumber start, double radius,
                BestFirstSearch<DiagramNumber, float>& search, const Visit& visit) {
  search.restart();
  search.offer(start, 0.0f, start);
  search.run([&](DiagramNumber voxel) {
    visit(voxel);
    for (const DiagramMove& move : curves.moves_of(voxel)) {
      const float next = search.cost(voxel) + move.length;
      if (next <= static_cast<float>(radius)) search.offer(move.to, next, voxel);
    }
    return true;
  });
}

}  // namespace

std::vector<DiagramNumber> select_vertices(const DiagramCurves& curves, double prune_radius) {
  std::vector<DiagramNumber> by_clearance(curves.size());
  std::iota(by_clearance.begin(), by_clearance.end(), 0u);
  std::stable_sort(by_clearance.begin(), by_clearance.end(),
                   [&](auto a, auto b) { return curves.squared[a] > curves.squared[b]; });
  std::vector<DiagramNumber> vertices;
  std::vector<bool> pruned(curves.size(), false);
  BestFirstSearch<DiagramNumber, float> search(curves.size(),
                                               std::numeric_limits<float>::infinity());
  for (const DiagramNumber v : by_clearance) {
    if (curves.moves_of(v).size() == 2 || pruned[v]) continue;
    vertices.push_back(v);
    visit_near(curves, v, prune_radius, search, [&](DiagramNumber w) { pruned[w] = true; });
  }
  // Rings without a junction: their widest voxel.
  std::vector<bool> reached(curves.size(), false);
  std::vector<DiagramNumber> stack = vertices;
  for (const DiagramNumber v : stack) reached[v] = true;
  for (std::size_t next = 0;;) {
    while (!stack.empty()) {
      const DiagramNumber v = stack.back();
      stack.pop_back();
      for (const DiagramMove& move : curves.moves_of(v))
        if (!reached[move.to]) {
          reached[move.to] = true;
          stack.push_back(move.to);
        }
    }
    while (next < by_clearance.size() && reached[by_clearance[next]]) ++next;
    if (next == by_clearance.size()) break;
    vertices.push_back(by_clearance[next]);
    stack.push_back(by_clearance[next]);
    reached[by_clearance[next]] = true;
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace ridgeway::detail
