// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

namespace ridgeway::detail {

/// Removes a file, or a folder with all that is in it; what cannot be removed stays. Links are not
/// followed. Uses system calls alone, so that handlers of signals may call it.
void remove_tree(const char* path) noexcept;

}  // namespace ridgeway::detail
