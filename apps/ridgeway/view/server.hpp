// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>

#include "view/map_answers.hpp"

namespace ridgeway::cli {

/// Serves the page and the answers to this machine alone (127.0.0.1) until `is_over`, which is
/// asked several times a second. `port`: 0 for any that is free. `on_ready` is called with the port
/// once it can be connected to. Throws InputError where the port cannot be had.
///
/// A request must be a GET or HEAD, name this server as its host (a page elsewhere whose name was
/// made to lead here does not), come from its own page or none, and be whole within seconds and
/// kilobytes; otherwise it is refused, or the connection closed. There are so many connections at
/// once at most; others wait.
void serve(MapAnswers& answers, int port, const std::function<void(int port)>& on_ready,
           const std::function<bool()>& is_over);

}  // namespace ridgeway::cli
