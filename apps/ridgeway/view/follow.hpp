// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>

#include "command.hpp"
#include "view/live_view.hpp"
#include "view/server.hpp"

namespace ridgeway::cli {

/// Of commands whose map grows: whether a page follows it.
struct FollowOptions {
  bool view = false, open = false;
  std::optional<int> port;
};
void add_follow_options(Command& command, FollowOptions& options);

/// Shows a run to pages, where that was asked for; else does nothing.
class FollowedRun {
 public:
  /// Serves from here on, and tells where, on stderr. Throws InputError where the port cannot be
  /// had, or one was given for no page. `map`: the file that the run writes.
  FollowedRun(const FollowOptions& options, const std::string& map, const Globals& globals);

  bool is_followed() const { return server_.has_value(); }
  /// Takes no longer than it takes to hand the scene over, whoever looks.
  void show(LiveScene scene);
  /// The last scene, with the map that was written.
  void show_last(std::shared_ptr<const Roadmap> roadmap);
  /// Until the user has seen enough (Ctrl-C); the results must have been printed.
  void stay();

 private:
  const Globals& globals_;
  LiveView view_;
  LiveScene last_;
  std::optional<PageServer> server_;  // ends before what it shows
};

}  // namespace ridgeway::cli
