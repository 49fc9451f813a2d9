// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "segment_fitting.hpp"

#include <algorithm>

namespace ridgeway::detail {
namespace {

SquaredHalves clearance_between(const DiagramCurves& curves, DiagramNumber a, DiagramNumber b) {
  for (const DiagramMove& move : curves.moves_of(a))
    if (move.to == b) return move.clearance;
  return {};
}

struct Farthest {
  std::size_t place;
  double distance;
};

/// Interior voxel of curve[first..last] that is farthest from the straight line between its ends.
Farthest farthest_from_line(const DiagramCurves& curves, const Curve& curve, std::size_t first,
                            std::size_t last) {
  const Point a = curves.position(curve[first]);
  const Point along = curves.position(curve[last]) - a;
  const double squared = along.squaredNorm();
  Farthest farthest{(first + last) / 2, 0.0};
  for (std::size_t i = first + 1; i < last; ++i) {
    const Point off = curves.position(curve[i]) - a;
    const double t = squared > 0.0 ? std::clamp(off.dot(along) / squared, 0.0, 1.0) : 0.0;
    const double distance = (off - t * along).norm();
    if (distance > farthest.distance) farthest = {i, distance};
  }
  return farthest;
}

}  // namespace

void fit_segments(const EsdfMap& esdf, const DiagramCurves& curves, const Curve& curve,
                  const FitConfig& config, SegmentMemory* memory, std::vector<Segment>& segments) {
  const RememberedSpace space(esdf, memory);
  std::vector<SquaredHalves> width(curve.size() - 1);  // of each move
  for (std::size_t i = 0; i + 1 < curve.size(); ++i)
    width[i] = clearance_between(curves, curve[i], curve[i + 1]);
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, curve.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    if (last - first == 1) {
      segments.push_back({curve[first], curve[last]});
      continue;
    }
    const Farthest farthest = farthest_from_line(curves, curve, first, last);
    if (farthest.distance <= config.split_deviation && curve[first] != curve[last]) {
      const SquaredHalves narrowest =
          *std::min_element(width.begin() + static_cast<std::ptrdiff_t>(first),
                            width.begin() + static_cast<std::ptrdiff_t>(last));
      const double clearance = narrowest.metres(esdf.voxel_size);
      const double wanted = std::max(config.min_clearance, std::min(clearance, config.widest_kept));
      if (space.is_free(curves.position(curve[first]), curves.position(curve[last]), wanted)) {
        segments.push_back({curve[first], curve[last]});
        continue;
      }
    }
    open.emplace_back(farthest.place, last);
    open.emplace_back(first, farthest.place);
  }
}

}  // namespace ridgeway::detail
