// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace ridgeway {

/// Runs `work` in a process of its own and returns the bytes that it makes; nothing where it
/// crashed, threw, or took more processor time than `seconds`. For libraries that do not stand up
/// to damaged files. What `work` changes in memory or prints is lost; it may not use threads.
/// Throws InputError where the system gives no process.
std::optional<std::vector<std::byte>> run_apart(const std::function<std::vector<std::byte>()>& work,
                                                unsigned seconds);

}  // namespace ridgeway
