// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>

#include "command.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::cli {

/// How long to look for a shorter path, by a word or a factor.
struct QualityOption {
  std::string word = "default";
  std::optional<double> factor;  // in place of the word

  /// As PlanConfig has them.
  bool quick() const { return word == "quick"; }
  double within() const { return factor.value_or(word == "best" ? PlanConfig::kBestWithin : 0.0); }
};

inline Option add_quality_option(Command& command, QualityOption& quality,
                                 const std::string& text) {
  return command.choice_or_number("--quality", quality.word, {"quick", "default", "best"},
                                  quality.factor, {1.0, 1e6}, text);
}

}  // namespace ridgeway::cli
