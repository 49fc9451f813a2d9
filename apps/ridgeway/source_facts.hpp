// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "commands.hpp"

namespace ridgeway::cli {

/// Does a file begin like a .ridge file? One that is damaged beyond that, but is named so, counts.
bool is_roadmap_file(const std::filesystem::path& file);

/// What a map holds that `build` reads: format, bounds, counts. Clouds need no bounds for that.
nlohmann::ordered_json describe_source(const std::filesystem::path& file, const Globals& globals);
void print_source(const nlohmann::ordered_json& facts);

/// "x,y,z to x,y,z" of the JSON object of a box.
std::string bounds_text(const nlohmann::ordered_json& box);

}  // namespace ridgeway::cli
