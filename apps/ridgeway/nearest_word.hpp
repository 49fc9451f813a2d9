// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ridgeway::cli {

/// The one of the known words that a misspelt one was meant for; empty where none is near: one that
/// it begins, or that few letters left out, added, changed or swapped make of it.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace ridgeway::cli
