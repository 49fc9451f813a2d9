// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "commands.hpp"

namespace ridgeway::cli {

/// What a recording holds that `fuse` reads: layout, topics, camera, where the sensor was. Images
/// and clouds are not read, but for the first image's size. Throws InputError where a folder is no
/// recording.
nlohmann::ordered_json describe_recording(const std::string& folder, const Globals& globals);
void print_recording(const nlohmann::ordered_json& facts);

}  // namespace ridgeway::cli
