// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "view/live_view.hpp"
#include "view/map_answers.hpp"

namespace ridgeway::cli {

/// What a server gives to its page.
struct Served {
  std::string map;                               ///< stands for it; another map has another one
  std::function<Reply(const Question&)> answer;  ///< thread-safe
  LiveView* live = nullptr;                      ///< what /api/live follows; none: nothing
};

/// Serves the page and the answers to this machine alone (127.0.0.1), in threads of its own, from
/// its making until it is destroyed, or `is_over`, which is asked several times a second.
///
/// A request must be a GET or HEAD, name this server as its host (a page elsewhere whose name was
/// made to lead here does not), come from its own page or none, and be whole within seconds and
/// kilobytes; otherwise it is refused, or the connection closed. There are so many connections at
/// once at most; others wait. Of those fewer follow a map; others are told so.
class PageServer {
 public:
  /// `port`: 0 for any that is free. Throws InputError where it cannot be had.
  PageServer(Served served, int port, std::function<bool()> is_over);
  ~PageServer();

  int port() const;
  /// Returns when it has ended.
  void wait() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

/// Whether the program was built with its page; throws InputError, naming who wants to show it,
/// where it was not.
void require_page(const std::string& who);

}  // namespace ridgeway::cli
