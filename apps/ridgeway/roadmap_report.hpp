// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ridgeway/roadmap/components.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::cli {

inline constexpr std::size_t kShownComponents = 10;  ///< the others are in the JSON alone

/// What a roadmap's file and its parts are.
nlohmann::ordered_json roadmap_json(const std::string& name, const Roadmap& roadmap);
void print_roadmap(const EsdfMap& esdf, const nlohmann::ordered_json& json);

nlohmann::ordered_json json_of(const ComponentReport& report);
void print_components(const EsdfMap& esdf, const ComponentReport& report);

/// "12.5 m3" of a part of space: in the plane its area.
std::string size_text(double volume, const EsdfMap& esdf);
/// "unknown space" or "obstacles".
std::string blocker_text(Blocker by);

}  // namespace ridgeway::cli
