// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <type_traits>
#include <vector>

namespace ridgeway::detail {

/// The one search over graphs: takes nodes in order, the best first, and remembers by which node
/// each was reached best. `Id` is an index or one of the strong index types, counted from 0. What
/// the search is called goes by the other parameters:
/// - Dijkstra: `Cost` is a length, and so is `Rank`;
/// - widest ways: `Cost` compares widths, the wider one is less;
/// - A*: `Rank` is an estimate with a member `cost`, what the way to the node has cost by then; the
///   node with the least estimate is next, and `cost` alone says which way to a node is best.
/// Nodes of equal rank are taken by number, so the result never depends on the order of offers
/// (among ways to one node of equal cost the first offered stays).
///
/// A caller offers the nodes to begin with, then calls run() with what is to be done at a node:
/// offer its neighbours, and say whether to go on.
template <typename Id, typename Cost, typename Rank = Cost>
class BestFirstSearch {
 public:
  /// `unreached`: the cost of a node that no way leads to; every other cost is less.
  BestFirstSearch(std::size_t nodes, const Cost& unreached)
      : unreached_(unreached), nodes_(nodes, {unreached, Id{}, 0}) {}

  /// Forgets all ways, in constant time.
  void restart() {
    open_ = {};
    if (++run_ == 0) {  // numbers are used up
      for (Node& node : nodes_) node.run = 0;
      run_ = 1;
    }
  }

  bool is_reached(Id v) const { return nodes_[place(v)].run == run_; }
  const Cost& cost(Id v) const { return is_reached(v) ? nodes_[place(v)].cost : unreached_; }
  /// The node before one that was reached; of a node to begin with, itself.
  Id from(Id v) const { return nodes_[place(v)].from; }

  /// Remembers a way to a node where it is better than all before; whether it is.
  bool improve(Id v, const Cost& cost, Id from) {
    if (!(cost < this->cost(v))) return false;
    nodes_[place(v)] = {cost, from, run_};
    return true;
  }

  /// Lets run() come to a node that was improved.
  void enqueue(Id v, const Rank& rank) { open_.push({rank, v}); }

  /// Both.
  void offer(Id v, const Cost& cost, Id from) requires std::is_same_v<Cost, Rank> {
    if (improve(v, cost, from)) enqueue(v, cost);
  }

  /// Calls visit(node) for each node, the best first, until it returns false or none is left.
  template <typename Visit>
  void run(const Visit& visit) {
    while (!open_.empty()) {
      const Entry entry = open_.top();
      open_.pop();
      if (nodes_[place(entry.node)].cost < cost_of(entry.rank)) continue;  // reached better since
      if (!visit(entry.node)) return;
    }
  }

  /// The nodes on the way to one that was reached, from the first on.
  std::vector<Id> way_to(Id v) const {
    std::vector<Id> way{v};
    while (nodes_[place(v)].from != v) way.push_back(v = nodes_[place(v)].from);
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  struct Node {
    Cost cost;
    Id from;
    std::uint32_t run;  ///< that reached it last
  };
  struct Entry {
    Rank rank;
    Id node;
    bool operator<(const Entry& other) const {  // the queue's top is the best
      if (other.rank < rank) return true;
      return !(rank < other.rank) && node > other.node;
    }
  };

  static std::size_t place(Id v) { return static_cast<std::size_t>(v); }
  static const Cost& cost_of(const Rank& rank) {
    if constexpr (std::is_same_v<Cost, Rank>)
      return rank;
    else
      return rank.cost;
  }

  const Cost unreached_;
  std::vector<Node> nodes_;
  std::uint32_t run_ = 1;
  std::priority_queue<Entry> open_;
};

}  // namespace ridgeway::detail
