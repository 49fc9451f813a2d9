// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "line_envelope.hpp"

namespace ridgeway::detail {

/// What LineEnvelope finds for all positions of a run, position by position, for tests: the
/// candidate that gives the position least, of equal ones the leftmost (the first of those given).
inline int plain_winner(const std::vector<LineCandidate>& candidates, std::int64_t position) {
  LineCandidate best = candidates.front();
  for (const LineCandidate& c : candidates)
    if (is_nearer(c, best, position)) best = c;
  return best.position;
}

}  // namespace ridgeway::detail
