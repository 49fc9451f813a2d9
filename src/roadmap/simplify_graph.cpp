// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/require.hpp"
#include "editable_graph.hpp"
#include "esdf/known_radius.hpp"
#include "esdf/remembered_space.hpp"
#include "graph_of_curves.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "vertex_merging.hpp"

namespace ridgeway {
namespace {

using detail::EditableGraph;
using detail::NeighbourPair;
using detail::require;
using Number = EditableGraph::Number;

constexpr double kLeastWidthStep = 1e-6;  // below it steps are lost in rounding

class Simplification {
 public:
  Simplification(const EsdfMap& esdf, const SparseGraph& graph, const SimplifyConfig& config,
                 detail::SegmentMemory* memory)
      : space_(esdf, memory),
        radius_(graph.min_clearance),
        widths_{graph.min_clearance,
                config.widest_kept > 0.0 ? std::max(config.widest_kept, graph.min_clearance)
                                         : 2.0 * graph.min_clearance,
                config.width_step * graph.min_clearance},
        config_(config),
        graph_(graph),
        merging_(space_, widths_, graph_) {}

  SparseGraph run() {
    for (bool again = true; again;) {
      mark_widest_ways();
      again = drop_dead_ends();
      again |= merging_.run();
      mark_widest_ways();
      again |= drop_parallel_ways();
    }
    measure_new_links();
    return graph_.result();
  }

 private:
  void mark_widest_ways() {
    graph_.mark_widest_ways([&](double clearance) { return widths_.kept(clearance); });
  }

  void measure_new_links() {
    struct NewLink {
      Number from, to;
      EditableGraph::Link link;
    };
    std::vector<NewLink> links;
    for (Number v = 0; v < graph_.size(); ++v)
      for (const auto& [w, link] : graph_.links_of(v))
        if (link.is_new && link.first == v) links.push_back({v, w, link});
    parallel_for_each_index(links.size(), [&](std::size_t i) {
      links[i].link.clearance = space_.clearance(graph_.at(links[i].from), graph_.at(links[i].to));
    });
    for (const NewLink& l : links) graph_.link(l.from, l.to, l.link);
  }

  /// Whether the ball at a dead end (`way` leads from it to its base) reaches far enough beyond
  /// those of the vertices around: of those that are met from its base on, the fewest edges first,
  /// no farther off than the end itself.
  bool is_significant(const std::vector<Number>& way) const {
    const Number end = way.front(), base = way.back(), inside = way[way.size() - 2];
    const double along = graph_.length(way);
    const double enough = std::max(config_.significance, config_.steepness * along);
    if (graph_.clearance(end) + along - graph_.clearance(base) < enough) return false;
    std::map<Number, double> distance{{base, 0.0}};
    std::vector<Number> queue{base};
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const auto& [v, link] : graph_.links_of(queue[i])) {
        const double next = distance.at(queue[i]) + graph_.length(queue[i], v);
        if (v == inside || next > along || !distance.try_emplace(v, next).second) continue;
        queue.push_back(v);
        if (graph_.clearance(end) + graph_.length(end, v) - graph_.clearance(v) < enough &&
            space_.is_free(graph_.at(end), graph_.at(v), radius_))
          return false;
      }
    return true;
  }

  bool drop_dead_ends() {
    bool changed = false;
    for (bool again = true; again; changed |= again) {
      again = false;
      for (Number end = 0; end < graph_.size(); ++end) {
        if (graph_.links_of(end).size() != 1) continue;
        detail::stop_if_cancelled();
        const std::vector<Number> way = graph_.way_to_fork(end);
        if (graph_.links_of(way.back()).size() < 3 || is_significant(way)) continue;
        for (std::size_t i = 0; i + 1 < way.size(); ++i) graph_.unlink(way[i], way[i + 1]);
        again = true;
      }
    }
    return changed;
  }

  /// Whether the segment between the ends of a way can be swept onto it, point by point at equal
  /// shares of their lengths.
  bool sweeps_onto(const std::vector<Number>& way) const {
    const double total = graph_.length(way);
    const Point a = graph_.at(way.front()), b = graph_.at(way.back());
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const double own = graph_.length(way[i], way[i + 1]);
      const int steps = std::max(1, static_cast<int>(std::ceil(own / radius_)));
      for (int k = 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        const Point p = graph_.at(way[i]) + t * (graph_.at(way[i + 1]) - graph_.at(way[i]));
        const Point q = a + (b - a) * ((before + t * own) / total);
        if (!space_.is_free(p, q, radius_)) return false;
      }
      before += own;
    }
    return true;
  }

  bool drop_parallel_ways() {
    std::vector<NeighbourPair> longest_first;
    for (Number v = 0; v < graph_.size(); ++v)
      for (const auto& [w, link] : graph_.links_of(v))
        if (v < w && !link.widest) longest_first.push_back({-graph_.length(v, w), v, w});
    std::sort(longest_first.begin(), longest_first.end());
    bool changed = false;
    for (const NeighbourPair& c : longest_first) {
      detail::stop_if_cancelled();
      const std::vector<Number> way =
          graph_.other_way(c.from, c.to, -c.length * config_.stretch,
                           widths_.kept(graph_.links_of(c.from).at(c.to).clearance));
      if (way.empty() || !sweeps_onto(way)) continue;
      graph_.unlink(c.from, c.to);
      changed = true;
    }
    return changed;
  }

  const detail::RememberedSpace space_;
  const double radius_;
  const detail::KeptWidths widths_;
  const SimplifyConfig& config_;
  EditableGraph graph_;
  detail::VertexMerging merging_;
};

}  // namespace

void SimplifyConfig::validate() const {
  require(significance >= 0.0 && std::isfinite(significance), "significance", significance,
          "give metres, 0 or more");
  require(steepness >= 0.0 && std::isfinite(steepness), "steepness", steepness,
          "give a share of a length, 0 or more");
  require(widest_kept >= 0.0 && std::isfinite(widest_kept), "widest_kept", widest_kept,
          "give metres, 0 for twice min_clearance");
  require(width_step >= kLeastWidthStep && std::isfinite(width_step), "width_step", width_step,
          "give a share of min_clearance, 1e-6 or more");
  require(stretch >= 1.0 && std::isfinite(stretch), "stretch", stretch, "give a factor, 1 or more");
}

SparseGraph simplify_graph(const EsdfMap& esdf, const SparseGraph& graph,
                           const SimplifyConfig& config) {
  return detail::simplify_graph(esdf, graph, config, nullptr);
}

SparseGraph detail::simplify_graph(const EsdfMap& esdf, const SparseGraph& graph,
                                   const SimplifyConfig& config, SegmentMemory* memory) {
  config.validate();
  detail::require_known_radius(esdf, "min_clearance", graph.min_clearance);
  return Simplification(esdf, graph, config, memory).run();
}

}  // namespace ridgeway
