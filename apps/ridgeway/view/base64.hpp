// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

namespace ridgeway::cli {

/// Standard base64 (RFC 4648), padded.
std::string base64(std::string_view bytes);

}  // namespace ridgeway::cli
