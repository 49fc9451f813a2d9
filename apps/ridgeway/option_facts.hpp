// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"

namespace ridgeway::cli {

/// What is known of an option, to describe it.
struct OptionFacts {
  std::string type = {};   ///< of its value, one word
  std::string shown = {};  ///< the same in the help
  std::string help = {};
  std::string initial = {};  ///< as it would be given; empty: none
  bool repeated = false;
  std::vector<std::string> choices = {};
  std::optional<Range> range = {};
  std::optional<Wholes> wholes = {};
};

}  // namespace ridgeway::cli
