// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "vertex_selection.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace ridgeway::detail {
namespace {

constexpr std::size_t kJunction = 3;

std::size_t degree(const DiagramCurves& curves, const std::vector<bool>& followed,
                   DiagramNumber v) {
  const auto moves = curves.moves_of(v);
  return static_cast<std::size_t>(std::count_if(
      moves.begin(), moves.end(), [&](const DiagramMove& m) { return followed[m.to]; }));
}

double clearance(const DiagramCurves& curves, DiagramNumber v) {  // voxels
  return 0.5 * std::sqrt(static_cast<double>(curves.squared[v]));
}

/// The voxels from a free end up to, not including, the next junction; empty where the curve has
/// no junction. `length`: from the end to the junction; `base`: the junction.
struct Branch {
  std::vector<DiagramNumber> voxels;
  double length = 0.0;
  DiagramNumber base = kNowhere;
};

Branch branch_from(const DiagramCurves& curves, const std::vector<bool>& followed,
                   DiagramNumber end) {
  Branch branch;
  DiagramNumber previous = kNowhere, voxel = end;
  while (true) {
    branch.voxels.push_back(voxel);
    const DiagramMove* onward = nullptr;
    for (const DiagramMove& move : curves.moves_of(voxel))
      if (followed[move.to] && move.to != previous) onward = &move;
    if (onward == nullptr) return {};
    branch.length += static_cast<double>(onward->length);
    previous = voxel;
    voxel = onward->to;
    const std::size_t neighbours = degree(curves, followed, voxel);
    if (neighbours >= kJunction) {
      branch.base = voxel;
      return branch;
    }
    if (neighbours < 2) return {};
  }
}

/// Visits the followed voxels within `radius` of a start along the diagram, itself included.
template <typename Visit>
void visit_near(const DiagramCurves& curves, const std::vector<bool>& followed, DiagramNumber start,
                double radius, std::vector<float>& best, const Visit& visit) {
  using Entry = std::pair<float, DiagramNumber>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<DiagramNumber> touched{start};
  best[start] = 0.0f;
  queue.push({0.0f, start});
  while (!queue.empty()) {
    const auto [distance, voxel] = queue.top();
    queue.pop();
    if (distance > best[voxel]) continue;
    visit(voxel);
    for (const DiagramMove& move : curves.moves_of(voxel)) {
      const float next = distance + move.length;
      if (!followed[move.to] || next > static_cast<float>(radius) || next >= best[move.to])
        continue;
      best[move.to] = next;
      touched.push_back(move.to);
      queue.push({next, move.to});
    }
  }
  for (const DiagramNumber v : touched) best[v] = INFINITY;
}

}  // namespace

std::vector<bool> significant_voxels(const DiagramCurves& curves, double significance) {
  std::vector<bool> followed(curves.size(), true);
  for (bool changed = true; changed;) {
    std::vector<Branch> spurious;
    for (DiagramNumber v = 0; v < curves.size(); ++v) {
      if (!followed[v] || degree(curves, followed, v) != 1) continue;
      Branch branch = branch_from(curves, followed, v);
      if (branch.base == kNowhere) continue;
      if (clearance(curves, v) + branch.length - clearance(curves, branch.base) < significance)
        spurious.push_back(std::move(branch));
    }
    changed = false;
    for (const Branch& branch : spurious) {
      // An earlier one may have made the base an ordinary voxel; then this is no branch any more.
      if (degree(curves, followed, branch.base) < kJunction) continue;
      for (const DiagramNumber v : branch.voxels) followed[v] = false;
      changed = true;
    }
  }
  return followed;
}

std::vector<DiagramNumber> select_vertices(const DiagramCurves& curves,
                                           const std::vector<bool>& followed, double prune_radius) {
  std::vector<DiagramNumber> by_clearance;
  for (DiagramNumber v = 0; v < curves.size(); ++v)
    if (followed[v]) by_clearance.push_back(v);
  std::stable_sort(by_clearance.begin(), by_clearance.end(),
                   [&](auto a, auto b) { return curves.squared[a] > curves.squared[b]; });
  std::vector<DiagramNumber> vertices;
  std::vector<bool> pruned(curves.size(), false);
  std::vector<float> best(curves.size(), INFINITY);
  for (const DiagramNumber v : by_clearance) {
    const std::size_t neighbours = degree(curves, followed, v);
    if (neighbours == 2 || pruned[v]) continue;
    vertices.push_back(v);
    visit_near(curves, followed, v, prune_radius, best, [&](DiagramNumber w) { pruned[w] = true; });
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
        if (followed[move.to] && !reached[move.to]) {
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
