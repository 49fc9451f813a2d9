// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tangent_search.hpp"

#include <algorithm>
#include <limits>

namespace ridgeway::detail {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// A corner that may be the first or the last of a route.
struct Candidate {
  VertexId corner;
  float length;  ///< of the segment between it and the start, or the goal
  bool is_seen = false;
};

/// The nearest way from a hub over one of the last corners to the goal.
struct WayOn {
  float length = kFar;
  std::uint32_t last = 0;  ///< place among them
};

/// A route by the hub where its halves meet.
struct HubMeeting {
  float length = kFar;
  std::size_t first = 0, last = 0;  ///< places among the candidates
  std::uint32_t hub = 0;
};

class TangentSearch {
 public:
  TangentSearch(const SparseGraph& graph, const HubLabels& hubs, const FreeSpace& space,
                const TangentQuery& query)
      : graph_(graph),
        hubs_(hubs),
        space_(space),
        query_(query),
        first_(candidates(query.seen_from_start, query.start)),
        last_(candidates(query.seen_from_goal, query.goal)),
        on_(graph.vertices.size()) {}

  std::vector<VertexId> run() {
    find_ways_on();
    for (;;) {
      const HubMeeting best = shortest();
      if (best.length == kFar) return {};
      if (!sees(first_[best.first], query_.start)) {
        first_[best.first] = first_.back();
        first_.pop_back();
      } else if (!sees(last_[best.last], query_.goal)) {
        forget_ways_on();
        last_[best.last] = last_.back();
        last_.pop_back();
        find_ways_on();
      } else {
        return route_over(best);
      }
    }
  }

 private:
  std::vector<Candidate> candidates(std::span<const VertexId> corners, const Point& end) const {
    std::vector<Candidate> result;
    result.reserve(corners.size());
    for (const VertexId v : corners)
      result.push_back({v, static_cast<float>((place_of(v) - end).norm())});
    return result;
  }

  const Point& place_of(VertexId v) const { return graph_.vertices[number(v)].position; }

  bool sees(Candidate& candidate, const Point& end) const {
    candidate.is_seen =
        candidate.is_seen || space_.is_free(end, place_of(candidate.corner), query_.radius);
    return candidate.is_seen;
  }

  void find_ways_on() {
    for (std::uint32_t i = 0; i < last_.size(); ++i)
      for (const HubLabel& label : hubs_.of(last_[i].corner))
        if (const float length = label.length + last_[i].length; length < on_[label.hub].length)
          on_[label.hub] = {length, i};
  }

  void forget_ways_on() {
    for (const Candidate& candidate : last_)
      for (const HubLabel& label : hubs_.of(candidate.corner)) on_[label.hub] = {};
  }

  HubMeeting shortest() const {
    HubMeeting best;
    for (std::size_t i = 0; i < first_.size(); ++i)
      for (const HubLabel& label : hubs_.of(first_[i].corner)) {
        const float length = first_[i].length + label.length + on_[label.hub].length;
        if (length < best.length) best = {length, i, on_[label.hub].last, label.hub};
      }
    return best;
  }

  std::vector<VertexId> route_over(const HubMeeting& meeting) const {
    std::vector<VertexId> route = way_to_hub(hubs_, first_[meeting.first].corner, meeting.hub);
    const std::vector<VertexId> back = way_to_hub(hubs_, last_[meeting.last].corner, meeting.hub);
    route.insert(route.end(), back.rbegin() + 1, back.rend());
    return route;
  }

  const SparseGraph& graph_;
  const HubLabels& hubs_;
  const FreeSpace& space_;
  const TangentQuery& query_;
  std::vector<Candidate> first_, last_;
  std::vector<WayOn> on_;  // by hub
};

}  // namespace

std::vector<VertexId> search_tangents(const SparseGraph& graph, const HubLabels& hubs,
                                      const FreeSpace& space, const TangentQuery& query) {
  if (query.seen_from_start.empty() || query.seen_from_goal.empty()) return {};
  return TangentSearch(graph, hubs, space, query).run();
}

}  // namespace ridgeway::detail
