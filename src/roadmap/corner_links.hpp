// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "corner_merging.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway::detail {

/// A corner and the direction away from what it goes around.
struct Corner {
  Point place, outward;
  std::uint32_t part;  ///< connected part of the sparse graph
};

/// The corners that were merged, in their order.
std::vector<Corner> corners_of(const Roadmap& roadmap, const MergedCorners& merged);

/// Whether a tight path may come to a corner from a place, or leave to it: not from above what it
/// goes around, or the path would not turn there.
bool may_turn(const Corner& corner, const Point& from);

/// Of the corners that `may` allows the nearest ones to a place, nearest first.
template <typename May>
std::vector<std::uint32_t> nearest_corners(const std::vector<Corner>& corners, const Point& place,
                                           std::size_t most, const May& may) {
  std::vector<std::pair<double, std::uint32_t>> near;  // ascending
  near.reserve(most + 1);
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const std::pair own((corners[i].place - place).squaredNorm(), i);
    if ((near.size() == most && own >= near.back()) || !may(i)) continue;
    near.insert(std::upper_bound(near.begin(), near.end(), own), own);
    if (near.size() > most) near.pop_back();
  }
  std::vector<std::uint32_t> result;
  result.reserve(near.size());
  for (const auto& [distance, i] : near) result.push_back(i);
  return result;
}

/// Corners as vertices, and edges between those that follow each other on a path, or are near, and
/// see each other; all but those that hardly save anything over shorter ones.
SparseGraph link_corners(const Roadmap& roadmap, const MergedCorners& merged,
                         const std::vector<Corner>& corners);

}  // namespace ridgeway::detail
