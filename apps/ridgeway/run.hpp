// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

namespace ridgeway::cli {

/// The whole program but for its signals, as main() is called; returns the exit code.
int run(int argc, const char* const* argv);

}  // namespace ridgeway::cli
