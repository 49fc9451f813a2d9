// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/random.hpp"
#include "live_flight.hpp"

namespace ridgeway {

/// Plans between random places on the snapshots of a live roadmap in a thread of its own;
/// `results` must outlive it. They may be read once that thread has ended.
class LiveQueryLoad {
 public:
  /// `allowed`: so many queries, until allow() says more.
  LiveQueryLoad(const LiveRoadmap& live, std::size_t allowed, std::uint64_t seed,
                LiveQueries& results);
  ~LiveQueryLoad();  ///< Ends the thread, whatever is left to be asked.
  LiveQueryLoad(const LiveQueryLoad&) = delete;
  LiveQueryLoad& operator=(const LiveQueryLoad&) = delete;

  /// So many queries in all.
  void allow(std::size_t queries);
  /// Waits until all that are allowed were asked, unless there is no roadmap, and ends the thread.
  void finish();
  /// Ends the thread, and asks the same again with nothing else running.
  void ask_again();

 private:
  struct Asked {
    std::shared_ptr<const Roadmap> roadmap;
    Point start, goal;
  };
  enum class End : std::uint8_t { kNotYet, kWhenAllAreAsked, kNow };

  void run(const LiveRoadmap& live, std::uint64_t seed);
  void keep(const Asked& asked, double seconds, Random& random);
  /// What the next one is asked of; none where the thread is to end.
  std::shared_ptr<const Roadmap> wait_for_next(const LiveRoadmap& live);
  void end(End when);

  LiveQueries& results_;
  std::vector<Asked> asked_;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::size_t allowed_;
  End end_ = End::kNotYet;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace ridgeway
