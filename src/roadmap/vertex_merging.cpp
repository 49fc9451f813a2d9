// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "vertex_merging.hpp"

#include "common/parallel_sort.hpp"
#include "ridgeway/common/parallel.hpp"
#include "swept_triangle.hpp"

namespace ridgeway::detail {
namespace {

/// Pairs that are asked ahead of their turn. What is asked takes milliseconds, and merging few of
/// them leaves the answers for the others right.
constexpr std::size_t kAhead = 512;
/// Where there is a memory, which knows most answers, and remembers what is asked in vain.
constexpr std::size_t kAheadRemembered = 64;

}  // namespace

/// Whether a pair may be merged depends on the links of both alone. So many are asked at once, and
/// an answer holds at the pair's turn if none of these links has changed by then; else it is asked
/// again. The graph is the same as if each were asked at its turn.
bool VertexMerging::run() {
  bool changed = false;
  std::vector<char> fresh(graph_.size(), true);  // may be worth another look
  const std::size_t ahead = space_.memory() == nullptr ? kAhead : kAheadRemembered;
  std::vector<Answer> answers(ahead);
  for (bool again = true; again; changed |= again) {
    again = false;
    const std::vector<NeighbourPair> pairs = pairs_to_ask(fresh);
    fresh.assign(graph_.size(), false);
    for (std::size_t first = 0; first < pairs.size(); first += ahead) {
      const std::size_t count = std::min(ahead, pairs.size() - first);
      parallel_for_each_index(
          count, [&](std::size_t i) { answers[i] = ask(pairs[first + i]); }, 8);
      for (std::size_t i = 0; i < count; ++i) {
        const NeighbourPair& pair = pairs[first + i];
        if (!graph_.links_of(pair.from).contains(pair.to)) continue;
        if (answers[i].changes != changes_at(pair)) answers[i] = ask(pair);
        if (!answers[i].may_merge) {
          refuse(pair);
          continue;
        }
        for (const auto& [other, link] : graph_.links_of(pair.from)) fresh[other] = true;
        merge(pair.from, pair.to, answers[i]);
        again = true;
      }
    }
  }
  return changed;
}

/// Those of which one is fresh, the shortest first.
std::vector<NeighbourPair> VertexMerging::pairs_to_ask(const std::vector<char>& fresh) const {
  std::vector<NeighbourPair> pairs;
  const auto for_each_fresh = [&](const auto& body) {
    for (Number v = 0; v < graph_.size(); ++v)
      for (const auto& [w, link] : graph_.links_of(v))
        if (fresh[v] || fresh[w]) body(v, w);
  };
  std::size_t count = 0;  // growing would take twice the memory, where there is most
  for_each_fresh([&](Number, Number) { ++count; });
  pairs.reserve(count);
  for_each_fresh([&](Number v, Number w) { pairs.push_back({graph_.length(v, w), v, w}); });
  parallel_sort(pairs.begin(), pairs.end());
  return pairs;
}

std::uint64_t VertexMerging::changes_at(const NeighbourPair& pair) const {
  return std::uint64_t{graph_.changes(pair.from)} << 32 | graph_.changes(pair.to);
}

bool VertexMerging::was_refused(const NeighbourPair& pair) const {
  const auto& refused = refused_[pair.from];
  return std::find(refused.begin(), refused.end(), std::pair(pair.to, changes_at(pair))) !=
         refused.end();
}

void VertexMerging::refuse(const NeighbourPair& pair) {
  auto& refused = refused_[pair.from];
  const auto place = std::find_if(refused.begin(), refused.end(),
                                  [&](const auto& r) { return r.first == pair.to; });
  if (place != refused.end()) {
    place->second = changes_at(pair);
  } else {
    refused.emplace_back(pair.to, changes_at(pair));
  }
}

VertexMerging::Answer VertexMerging::ask(const NeighbourPair& pair) const {
  Answer answer;
  answer.changes = changes_at(pair);
  if (!graph_.links_of(pair.from).contains(pair.to) || was_refused(pair)) return answer;
  answer.may_merge = may_merge(pair.from, pair.to);
  if (!answer.may_merge) return answer;
  // Most new links are soon replaced by others: how wide they are beyond all that is kept is
  // measured in the end.
  const EditableGraph::Links& there = graph_.links_of(pair.to);
  for (const auto& [other, link] : graph_.links_of(pair.from))
    if (other != pair.to && !there.contains(other))
      answer.new_links.emplace_back(other, space_.clearance(graph_.at(pair.to), graph_.at(other),
                                                            widths_.widest + widths_.step));
  return answer;
}

bool VertexMerging::may_merge(Number from, Number to) const {
  const EditableGraph::Links &here = graph_.links_of(from), &there = graph_.links_of(to);
  if (here.size() == 1) return false;
  if (here.size() > 2 &&
      (graph_.length(from, to) > graph_.clearance(to) ||
       std::pair(graph_.clearance(from), to) > std::pair(graph_.clearance(to), from)))
    return false;
  for (const auto& [other, link] : here) {  // what takes no look first
    const auto known = there.find(other);
    if (known != there.end() && known->second.clearance < width_needed(from, to, link))
      return false;
  }
  for (const auto& [other, link] : here)
    if (other != to && !there.contains(other) &&
        !space_.is_free(graph_.at(to), graph_.at(other), width_needed(from, to, link)))
      return false;
  return std::all_of(here.begin(), here.end(), [&](const auto& link) {
    return link.first == to ||
           sweeps(space_, widths_.radius,
                  {graph_.at(to), graph_.at(from), graph_.at(link.first), widths_.radius});
  });
}

/// What a link from `to` must be as wide as if it replaces that of `from`, so that the widest ways
/// stay as wide.
double VertexMerging::width_needed(Number from, Number to,
                                   const EditableGraph::Link& replaced) const {
  const EditableGraph::Links& here = graph_.links_of(from);
  if (replaced.widest) {
    const auto others = std::count_if(
        here.begin(), here.end(), [&](const auto& l) { return l.first != to && l.second.widest; });
    if (others > 1) return widths_.kept(replaced.clearance);
  }
  return widths_.kept(std::min(replaced.clearance, here.at(to).clearance));
}

void VertexMerging::merge(Number from, Number to, const Answer& answer) {
  auto new_link = answer.new_links.begin();
  for (const auto& [other, replaced] : EditableGraph::Links(graph_.links_of(from))) {
    graph_.unlink(from, other);
    if (other == to) continue;
    const EditableGraph::Links& there = graph_.links_of(to);
    const auto known = there.find(other);
    EditableGraph::Link link = known != there.end()
                                   ? known->second
                                   : EditableGraph::Link{new_link++->second, false, true, to};
    link.widest |= replaced.widest;
    graph_.link(to, other, link);
  }
}

}  // namespace ridgeway::detail
