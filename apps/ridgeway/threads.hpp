// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "command.hpp"

namespace ridgeway::cli {

/// Threads for the work: those asked for, or fewer, with a warning, where the system allows no
/// more (ulimit -u, the limit of a container). Bounds what oneTBB makes, too, which would fail.
int threads_to_use(const Globals& globals);

}  // namespace ridgeway::cli
