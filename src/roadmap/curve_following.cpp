// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "curve_following.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {
namespace {

/// A move over which two floods meet, or one meets itself.
struct Meeting {
  DiagramNumber a, b;
  SquaredHalves width;
  double length;  // of the whole way from vertex to vertex
};

Curve way_to_vertex(const DiagramFlood& flood, DiagramNumber v) {
  Curve way{v};
  while (flood.toward[v] != v) way.push_back(v = flood.toward[v]);
  return way;
}

/// Length of the loop that a move closes between two ways of the same flood.
double loop_length(const DiagramFlood& flood, const Meeting& meeting) {
  Curve a = way_to_vertex(flood, meeting.a), b = way_to_vertex(flood, meeting.b);
  DiagramNumber fork = a.back();
  while (!a.empty() && !b.empty() && a.back() == b.back()) {
    fork = a.back();
    a.pop_back();
    b.pop_back();
  }
  return meeting.length - 2.0 * static_cast<double>(flood.distance[fork]);
}

/// Of meetings of one pair of vertices, the widest (then shortest) of each group of adjacent ones.
void keep_best_of_groups(const DiagramCurves& curves, std::vector<Meeting>& meetings) {
  std::unordered_map<DiagramNumber, std::vector<std::uint32_t>> at;  // voxel of side a -> meetings
  for (std::uint32_t i = 0; i < meetings.size(); ++i) at[meetings[i].a].push_back(i);
  DisjointSets groups(meetings.size());
  const auto near = [&](DiagramNumber v, DiagramNumber w) {
    if (v == w) return true;
    const auto moves = curves.moves_of(v);
    return std::any_of(moves.begin(), moves.end(), [&](const DiagramMove& m) { return m.to == w; });
  };
  const auto join_at = [&](std::uint32_t i, DiagramNumber voxel) {
    const auto others = at.find(voxel);
    if (others == at.end()) return;
    for (const std::uint32_t j : others->second)
      if (near(meetings[i].b, meetings[j].b)) groups.join(i, j);
  };
  for (std::uint32_t i = 0; i < meetings.size(); ++i) {
    join_at(i, meetings[i].a);
    for (const DiagramMove& move : curves.moves_of(meetings[i].a)) join_at(i, move.to);
  }
  std::map<std::uint32_t, Meeting> best;
  for (std::uint32_t i = 0; i < meetings.size(); ++i) {
    const Meeting& m = meetings[i];
    const auto [place, fresh] = best.try_emplace(groups.find(i), m);
    if (!fresh && std::tie(place->second.width, m.length) < std::tie(m.width, place->second.length))
      place->second = m;
  }
  meetings.clear();
  for (const auto& [group, meeting] : best) meetings.push_back(meeting);
}

}  // namespace

std::vector<Curve> follow_curves(const DiagramCurves& curves, const DiagramFlood& flood,
                                 double shortest_loop) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Meeting>> by_pair;
  for (DiagramNumber a = 0; a < curves.size(); ++a) {
    for (const DiagramMove& move : curves.moves_of(a)) {
      const DiagramNumber b = move.to;
      if (b <= a || flood.toward[a] == b || flood.toward[b] == a) continue;
      Meeting meeting{a, b, std::min({flood.width[a], move.clearance, flood.width[b]}),
                      static_cast<double>(flood.distance[a] + move.length + flood.distance[b])};
      const bool same = flood.vertex[a] == flood.vertex[b];
      if (same && loop_length(flood, meeting) < shortest_loop) continue;
      if (flood.vertex[a] > flood.vertex[b]) std::swap(meeting.a, meeting.b);
      by_pair[{flood.vertex[meeting.a], flood.vertex[meeting.b]}].push_back(meeting);
    }
  }
  std::vector<Curve> result;
  for (auto& [pair, meetings] : by_pair) {
    keep_best_of_groups(curves, meetings);
    for (const Meeting& meeting : meetings) {
      Curve left = way_to_vertex(flood, meeting.a);
      const Curve right = way_to_vertex(flood, meeting.b);
      std::reverse(left.begin(), left.end());
      if (pair.first == pair.second) {
        if (left.size() > 1) result.push_back(left);
        left = {meeting.a};
      }
      left.insert(left.end(), right.begin(), right.end());
      result.push_back(std::move(left));
    }
  }
  return result;
}

}  // namespace ridgeway::detail
