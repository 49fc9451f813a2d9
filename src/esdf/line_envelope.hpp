// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway::detail {

/// One candidate on a line: a voxel whose best site so far lies at `cost` (4 d^2) across the line.
struct LineCandidate {
  int position;
  std::int64_t cost;
};

constexpr std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return quotient - (a % b < 0 ? 1 : 0);
}

/// First position at which candidate `b` is strictly nearer than `a` (a.position < b.position).
/// Along the line a cube at distance k costs q(k) = max(2 |k| - 1, 0)^2, which is convex, so the
/// difference of two of them is monotone and crosses once; it has one closed form on either side
/// of, and between, the two positions.
constexpr std::int64_t crossing(const LineCandidate& a, const LineCandidate& b) {
  const std::int64_t sum = std::int64_t{a.position} + b.position;
  const std::int64_t m = std::int64_t{b.position} - a.position;
  const std::int64_t t = a.cost - b.cost;
  const std::int64_t at_ends = (2 * m - 1) * (2 * m - 1);
  if (t > at_ends) return floor_divide(4 * m * (sum - 1) - t, 8 * m) + 1;
  if (m > 1 && t > (2 * m - 2) * (4 - 2 * m)) {
    const std::int64_t between = floor_divide(4 * (m - 1) * sum - t, 8 * (m - 1)) + 1;
    return between > a.position ? between : a.position + 1;
  }
  if (t > -at_ends) return b.position;
  const std::int64_t beyond = floor_divide(4 * m * (sum + 1) - t, 8 * m) + 1;
  return beyond > b.position ? beyond : b.position + 1;
}

/// Lower envelope of the candidates of one run of a line, built left to right. Equal distances go
/// to the candidate on the left, which holds the (z, y, x) tie rule through all three sweeps.
class LineEnvelope {
 public:
  void clear() { pieces_.clear(); }

  void add(const LineCandidate& candidate) {
    std::int64_t from = INT64_MIN;
    while (!pieces_.empty()) {
      from = crossing(pieces_.back().candidate, candidate);
      if (from > pieces_.back().from) break;
      pieces_.pop_back();
      from = INT64_MIN;
    }
    pieces_.push_back({candidate, from});
  }

  bool empty() const { return pieces_.empty(); }

  /// Calls assign(begin, end, winner's position) for the stretches of [first, last], end excluded.
  template <typename Assign>
  void for_each_stretch(int first, int last, const Assign& assign) const {
    int begin = first;
    for (std::size_t piece = 0; piece < pieces_.size() && begin <= last; ++piece) {
      const std::int64_t next = piece + 1 < pieces_.size() ? pieces_[piece + 1].from : INT64_MAX;
      const int end = static_cast<int>(std::min<std::int64_t>(next, last + 1));
      if (end <= begin) continue;
      assign(begin, end, pieces_[piece].candidate.position);
      begin = end;
    }
  }

 private:
  struct Piece {
    LineCandidate candidate;
    std::int64_t from;  // first position at which this candidate wins
  };
  std::vector<Piece> pieces_;
};

}  // namespace ridgeway::detail
