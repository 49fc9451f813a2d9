// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "editable_graph.hpp"
#include "esdf/remembered_space.hpp"

namespace ridgeway::detail {

/// How much of a width matters, in metres.
struct KeptWidths {
  double radius;  ///< of the smallest robot
  double widest;  ///< all that is wider is as good
  double step;    ///< between the widths that are told apart

  double kept(double clearance) const {
    const double whole = std::floor(clearance / step * (1.0 + 1e-9)) * step;
    return std::clamp(whole, radius, widest);
  }
};

/// Two neighbours, the shortest pair first.
struct NeighbourPair {
  double length;
  EditableGraph::Number from, to;
  bool operator<(const NeighbourPair& other) const {
    return std::tie(length, from, to) < std::tie(other.length, other.from, other.to);
  }
};

/// Merges vertices of a graph into neighbours where the triangles between their edges and those
/// that replace them are free. Both must outlive it.
class VertexMerging {
 public:
  VertexMerging(const RememberedSpace& space, const KeptWidths& widths, EditableGraph& graph)
      : space_(space), widths_(widths), graph_(graph), refused_(graph.size()) {}

  /// One pair of neighbours after the other, the shortest first, until none is left to merge;
  /// whether any was.
  bool run();

 private:
  using Number = EditableGraph::Number;
  /// The first of a pair may be merged into the second, or not.
  struct Answer {
    bool may_merge = false;
    std::uint64_t changes = 0;                         ///< as changes_at
    std::vector<std::pair<Number, double>> new_links;  ///< if so: to which, and how wide
  };

  std::vector<NeighbourPair> pairs_to_ask(const std::vector<char>& fresh) const;
  std::uint64_t changes_at(const NeighbourPair& pair) const;
  bool was_refused(const NeighbourPair& pair) const;
  void refuse(const NeighbourPair& pair);
  Answer ask(const NeighbourPair& pair) const;
  bool may_merge(Number from, Number to) const;
  double width_needed(Number from, Number to, const EditableGraph::Link& replaced) const;
  void merge(Number from, Number to, const Answer& answer);

  const RememberedSpace& space_;
  const KeptWidths& widths_;
  EditableGraph& graph_;
  /// By vertex: into which neighbours it was not to be merged, and their changes then.
  std::vector<std::vector<std::pair<Number, std::uint64_t>>> refused_;
};

}  // namespace ridgeway::detail
