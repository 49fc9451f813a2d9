// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"

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

/// What a candidate gives a position at `steps` >= 0 from its own.
constexpr std::int64_t value_at(const LineCandidate& candidate, std::int64_t steps) {
  const std::int64_t twice = 2 * steps - (steps > 0 ? 1 : 0);
  return candidate.cost + twice * twice;
}

/// Whether candidate `b` is strictly nearer than `a` to a position.
constexpr bool is_nearer(const LineCandidate& b, const LineCandidate& a, std::int64_t position) {
  const auto value = [position](const LineCandidate& c) {
    return value_at(c, position < c.position ? c.position - position : position - c.position);
  };
  return value(b) < value(a);
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

/// The same for neighbours, which are the most frequent. Where `b` lies, it wins unless its cost is
/// higher; every position further adds 8 to the difference.
constexpr std::int64_t crossing_of_neighbours(const LineCandidate& a, const LineCandidate& b) {
  const std::int64_t t = a.cost - b.cost;
  if (t > 1) return a.position - ((t - 1) >> 3);
  return t >= 0 ? b.position : b.position + (-t >> 3) + 1;
}

/// Lower envelope of the candidates of one run of a line, built left to right. Equal distances go
/// to the candidate on the left, which holds the (z, y, x) tie rule through all three sweeps.
///
/// Plain form: plain_winner() in plain_envelope.hpp, for each position. From it,
/// docs/fast-kernels.md section 1: two candidates cross once (4), so that each wins one stretch
/// (5); those that win nothing between the last and the next are left out (6).
class LineEnvelope {
 public:
  /// For runs of up to so many positions.
  explicit LineEnvelope(std::size_t positions) { pieces_.reserve(positions + 2); }

  /// Begins a run over the positions first to last.
  void begin(int first, int last) {
    pieces_.clear();
    first_ = first;
    last_ = last;
  }

  /// Adds a candidate inside the run, where the cost of the next position is known: most that win
  /// nothing lie between one on the left that reaches past them and the next.
  void add_before(const LineCandidate& candidate, std::int64_t next_cost) {
    if (!pieces_.empty() && !wins_before_next(candidate, next_cost)) return;
    add(candidate);
  }

  void add(const LineCandidate& candidate) {
    if (!pieces_.empty() && pieces_.back().candidate.position + 1 == candidate.position) {
      const std::int64_t from = crossing_of_neighbours(pieces_.back().candidate, candidate);
      if (from > pieces_.back().from) {
        if (from <= last_) pieces_.push_back({candidate, from});
        return;
      }
      pieces_.pop_back();
    }
    while (!pieces_.empty() && is_nearer(candidate, pieces_.back().candidate, pieces_.back().from))
      pieces_.pop_back();
    if (pieces_.empty()) {
      pieces_.push_back({candidate, first_});
    } else if (is_nearer(candidate, pieces_.back().candidate, last_)) {
      pieces_.push_back({candidate, crossing(pieces_.back().candidate, candidate)});
    }
  }

  /// Calls assign(begin, end, winner's position) for the stretches of the run, end excluded.
  template <typename Assign>
  void for_each_stretch(const Assign& assign) const {
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
      const bool is_last = piece + 1 == pieces_.size();
      assign(static_cast<int>(pieces_[piece].from),
             is_last ? last_ + 1 : static_cast<int>(pieces_[piece + 1].from),
             pieces_[piece].candidate.position);
    }
  }

 private:
  /// Whether a candidate may win over the last one of the envelope where it wins over the next
  /// position: that wins from where it lies on, or 8 to a position further for what it costs more.
  bool wins_before_next(const LineCandidate& candidate, std::int64_t next_cost) const {
    const LineCandidate& back = pieces_.back().candidate;
    const std::int64_t behind = candidate.position - back.position;
    if (behind == 1) return true;  // as cheap to add
    const std::int64_t rise = next_cost - candidate.cost;
    const std::int64_t ahead =
        rise <= 0 ? 0 : std::min<std::int64_t>(1 + (rise >> 3), last_ - candidate.position);
    return value_at(candidate, ahead) < value_at(back, behind + ahead);
  }

  struct Piece {
    LineCandidate candidate;
    std::int64_t from;  // first position of the run at which this candidate wins
  };
  std::vector<Piece> pieces_;
  int first_ = 0, last_ = 0;
};

}  // namespace ridgeway::detail
