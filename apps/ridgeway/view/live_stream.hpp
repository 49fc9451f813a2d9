// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "view/live_view.hpp"

namespace ridgeway::cli {

/// What one page is sent of a run: server-sent events with what has changed since the last one, as
/// docs/viewer.md describes them. Of one thread. It holds the map that the page has, so that what
/// is missing is found when the page takes the next event, however long that is after.
class LiveStream {
 public:
  explicit LiveStream(LiveView& view) : view_(view) {}

  /// The next event; after a moment in which nothing happens nothing, or a sign of life.
  std::string next();

 private:
  using Clock = std::chrono::steady_clock;
  std::string event_of(const LiveView::Update& update);

  LiveView& view_;
  LiveView::Seen seen_;
  std::shared_ptr<const Roadmap> sent_;  // none: nothing was
  bool has_begun_ = false;
  Clock::time_point last_sign_ = Clock::now();
};

}  // namespace ridgeway::cli
