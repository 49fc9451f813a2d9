// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "diagram_curves.hpp"
#include "ridgeway/roadmap/build_graph.hpp"

namespace ridgeway::detail {

/// build_graph and build_attach_field of a diagram that is indexed already, at the same clearance.
/// `memory`: of segments, where the map is one that changes.
SparseGraph build_graph(const EsdfMap& esdf, const DiagramCurves& curves, const GraphConfig& config,
                        SegmentMemory* memory = nullptr);
SparseGraph simplify_graph(const EsdfMap& esdf, const SparseGraph& graph,
                           const SimplifyConfig& config, SegmentMemory* memory);
AttachField build_attach_field(const EsdfMap& esdf, const DiagramCurves& curves,
                               const SparseGraph& graph, Basins basins);

}  // namespace ridgeway::detail
