// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ridgeway::fuzz {

/// The content of a .ridge file without compression and checksums, which would hide it from a
/// fuzzer: u32 size of the header, header; then for each section 16 bytes of name, u32 type, u32
/// chunks, and for each chunk u32 size and its bytes.
std::string unpack_ridge(const std::filesystem::path& file);

/// The reverse: a .ridge file that is whole in every byte, whatever is in it. What is left of bytes
/// that end too early becomes the last chunk.
void pack_ridge(std::string_view bytes, const std::filesystem::path& file);

}  // namespace ridgeway::fuzz
