// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/follow.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "console.hpp"
#include "interruption.hpp"
#include "ridgeway/common/error.hpp"
#include "view/browser.hpp"

namespace ridgeway::cli {

namespace {

/// Of each run another one: what a page has of one does not go on with the next.
std::string word_for_run() {
  return std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
}

}  // namespace

void add_follow_options(Command& command, FollowOptions& options) {
  command.flag(
      "--view", options.view,
      "Show in a browser how the map grows, and plan in it; goes on with the last map until "
      "Ctrl-C");
  command.whole("--port", options.port, {0, 65535},
                "Port to serve --view at, 0 for any that is free (default: 0)");
  command.flag("--open", options.open, "Open --view in the browser of the desktop");
}

FollowedRun::FollowedRun(const FollowOptions& options, const std::string& map,
                         const Globals& globals)
    : globals_(globals), view_(std::filesystem::path(map).filename().string()) {
  if (!options.view) {
    if (options.port || options.open)
      throw InputError(options.port ? "--port" : "--open", "is of a page that follows the map",
                       "give --view too, or leave it out");
    return;
  }
  require_page("--view");
  server_.emplace(
      Served{word_for_run(), [this](const Question& question) { return view_.answer(question); },
             &view_},
      options.port.value_or(0), is_interrupted);
  const std::string address = address_of(server_->port());
  note(globals, "open " + address + " to see the map grow");
  if (options.open) open_page(address, globals);
}

void FollowedRun::show(LiveScene scene) {
  if (!is_followed()) return;
  last_ = scene;
  view_.show(std::move(scene));
}

void FollowedRun::show_last(std::shared_ptr<const Roadmap> roadmap) {
  last_.roadmap = std::move(roadmap);
  last_.ahead.clear();
  last_.is_last = true;
  show(last_);
}

void FollowedRun::stay() {
  if (!is_followed()) return;
  std::fflush(stdout);
  note(globals_, "the map is done, and shown until Ctrl-C");
  server_->wait();
}

}  // namespace ridgeway::cli
