// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>

#include "command.hpp"

namespace ridgeway::cli {

/// Asks the desktop to open an address (xdg-open); false where that cannot be started.
bool open_in_browser(const std::string& address);

/// Of a server of ours.
std::string address_of(int port);

/// The same, with a warning where it cannot be done.
void open_page(const std::string& address, const Globals& globals);

}  // namespace ridgeway::cli
