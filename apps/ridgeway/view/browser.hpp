// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>

namespace ridgeway::cli {

/// Asks the desktop to open an address (xdg-open); false where that cannot be started.
bool open_in_browser(const std::string& address);

}  // namespace ridgeway::cli
