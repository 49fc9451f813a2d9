// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "ridgeway/roadmap/tangent_graph.hpp"

namespace ridgeway::detail {

/// More links followed and labels compared than this are too many: some ten seconds.
inline constexpr std::size_t kMostLabelSteps = 4'000'000'000;

/// What label_hubs gives; nothing where that takes more than `most_steps`. How much work it is, a
/// graph does not show: labels are few as a rule, but in the worst case the work is cubic.
std::optional<HubLabels> label_hubs_within(const SparseGraph& graph,
                                           std::size_t most_steps = kMostLabelSteps);

}  // namespace ridgeway::detail
