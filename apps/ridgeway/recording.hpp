// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ridgeway::cli {

enum class RecordingKind : std::uint8_t { kImages, kScans };

/// Throws InputError where a folder is no recording.
RecordingKind kind_of_recording(const std::string& folder);

/// Throws InputError where a file that is to be written is part of a recording.
void require_outside(const std::filesystem::path& output, const std::filesystem::path& folder);

}  // namespace ridgeway::cli
