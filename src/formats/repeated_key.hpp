// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <set>
#include <string>

namespace ridgeway {

/// The first key of a map that stands there for a second time: yaml-cpp takes the first of them and
/// passes over the others without a word.
inline std::optional<YAML::Node> find_repeated_key(const YAML::Node& map) {
  std::set<std::string> keys;
  for (const auto& entry : map)
    if (entry.first.IsScalar() && !keys.insert(entry.first.Scalar()).second) return entry.first;
  return std::nullopt;
}

}  // namespace ridgeway
