// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway {

/// The shortest way from a vertex to a hub. Small: a query reads hundreds.
struct HubLabel {
  std::uint32_t hub = 0;  ///< by importance: 0 is the hub that most ways pass
  float length = 0.0f;    ///< of the way, metres
  friend bool operator==(const HubLabel&, const HubLabel&) = default;
};

/// Shortest lengths and ways between any two vertices of a graph, without a search: each vertex
/// knows the way to a few hubs, and any two vertices that are connected share a hub on a shortest
/// way between them (2-hop cover: Cohen, Halperin, Kaplan and Zwick, "Reachability and distance
/// queries via 2-hop labels", 2003). All edges count, whatever their clearance.
struct HubLabels {
  std::vector<std::uint32_t> first;  ///< vertices + 1 entries into `labels`
  std::vector<HubLabel> labels;      ///< of each vertex by ascending hub
  std::vector<VertexId> next;  ///< by label: next vertex on the way; the hub itself at its end

  std::span<const HubLabel> of(VertexId v) const {
    return std::span(labels).subspan(first[number(v)], first[number(v) + 1] - first[number(v)]);
  }
};

/// Pruned landmark labelling (Akiba, Iwata and Yoshida, "Fast exact shortest-path distance queries
/// on large networks by pruned landmark labeling", 2013): from each hub, the most important first,
/// a Dijkstra that stops where earlier hubs already know a way as short. Deterministic.
HubLabels label_hubs(const SparseGraph& graph);

/// The vertices on the way from one that has a label of the hub, itself first, to the hub.
std::vector<VertexId> way_to_hub(const HubLabels& hubs, VertexId from, std::uint32_t hub);

}  // namespace ridgeway
