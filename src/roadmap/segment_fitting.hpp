// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "curve_following.hpp"
#include "esdf/remembered_space.hpp"

namespace ridgeway::detail {

struct FitConfig {
  double min_clearance;    ///< metres
  double widest_kept;      ///< metres; up to this an edge is as wide as the curve under it
  double split_deviation;  ///< metres
};

/// A straight piece: indices of its end voxels in the diagram.
struct Segment {
  DiagramNumber from, to;
};

/// Splits a curve into straight segments (paper: Edge Splitting): at the voxel farthest from the
/// straight line, while that is farther than `split_deviation` or the line is not free at the
/// clearance that the curve has (at most `widest_kept`). A single move of the curve always holds.
void fit_segments(const EsdfMap& esdf, const DiagramCurves& curves, const Curve& curve,
                  const FitConfig& config, SegmentMemory* memory, std::vector<Segment>& segments);

}  // namespace ridgeway::detail
