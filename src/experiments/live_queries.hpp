// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "live_flight.hpp"

namespace ridgeway {

/// Plans on the snapshots of a live roadmap in a thread of its own until it goes, then asks the
/// same again; `results` must outlive it.
class LiveQueryLoad {
 public:
  LiveQueryLoad(const LiveRoadmap& live, bool asks, std::uint64_t seed, LiveQueries& results);
  ~LiveQueryLoad();
  LiveQueryLoad(const LiveQueryLoad&) = delete;
  LiveQueryLoad& operator=(const LiveQueryLoad&) = delete;

 private:
  struct Asked {
    std::shared_ptr<const Roadmap> roadmap;
    Point start, goal;
  };

  void run(const LiveRoadmap& live, std::uint64_t seed);

  LiveQueries& results_;
  std::vector<Asked> asked_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace ridgeway
