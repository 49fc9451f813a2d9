// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "best_first_search.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway::detail {

/// A sparse graph whose links come and go. Vertices keep their numbers and places.
/// The SparseGraph must outlive it.
class EditableGraph {
 public:
  using Number = std::uint32_t;
  struct Link {
    double clearance = 0.0;
    bool widest = false;  ///< see mark_widest_ways
    bool is_new = false;  ///< not from the SparseGraph
    Number first = 0;     ///< the end from which a new one is measured
  };

  /// The links of a vertex by neighbour, ascending; they are few.
  class Links {
    using Entry = std::pair<Number, Link>;
    template <typename Entries>
    static auto lower_bound(Entries& entries, Number neighbour) {
      return std::partition_point(entries.begin(), entries.end(),
                                  [&](const Entry& e) { return e.first < neighbour; });
    }

   public:
    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    auto begin() const { return entries_.begin(); }
    auto end() const { return entries_.end(); }
    auto rbegin() const { return entries_.rbegin(); }
    auto find(Number neighbour) const {
      const auto place = lower_bound(entries_, neighbour);
      return place != end() && place->first == neighbour ? place : end();
    }
    bool contains(Number neighbour) const { return find(neighbour) != end(); }
    /// Of a neighbour.
    const Link& at(Number neighbour) const { return lower_bound(entries_, neighbour)->second; }

   private:
    friend EditableGraph;
    Link& at(Number neighbour) { return lower_bound(entries_, neighbour)->second; }
    void put(Number neighbour, const Link& link);
    void erase(Number neighbour);

    std::vector<Entry> entries_;
  };

  explicit EditableGraph(const SparseGraph& graph);

  Number size() const { return static_cast<Number>(links_.size()); }
  const Links& links_of(Number v) const { return links_[v]; }
  const Point& at(Number v) const { return graph_.vertices[v].position; }
  double clearance(Number v) const { return graph_.vertices[v].clearance; }
  double length(Number a, Number b) const { return (at(b) - at(a)).norm(); }
  double length(const std::vector<Number>& way) const;

  void link(Number a, Number b, const Link& value);
  void unlink(Number a, Number b);

  /// Grows whenever a link of the vertex comes, goes or changes.
  std::uint32_t changes(Number v) const { return changes_[v]; }

  /// Marks the links of a maximum spanning forest over `width(clearance)`, which never falls: at
  /// every such width they connect as much as all links do. Shorter links win among equals.
  void mark_widest_ways(const std::function<double(double)>& width);

  /// The vertices from the end of a link to the next fork or end, both included.
  std::vector<Number> way_to_fork(Number end) const;

  /// Shortest way between the ends of a link without it, as wide as `width` and no longer than
  /// `longest`; empty where there is none.
  std::vector<Number> other_way(Number from, Number to, double longest, double width);

  /// Without the vertices that have lost all their links.
  SparseGraph result() const;

 private:
  const SparseGraph& graph_;
  std::vector<Links> links_;
  std::vector<std::uint32_t> changes_;
  BestFirstSearch<Number, double> search_;
};

}  // namespace ridgeway::detail
