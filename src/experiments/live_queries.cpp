// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_queries.hpp"

#include <chrono>
#include <utility>

#include "common/clock.hpp"
#include "common/random.hpp"
#include "ridgeway/live/graph_delta.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kMostKept = 2000;  // queries that are asked again
constexpr int kTries = 1000;             // to meet a traversable voxel

Point random_place(const Roadmap& roadmap, Random& random) {
  const EsdfMap& esdf = roadmap.esdf;
  VoxelId id = 0;
  for (int i = 0; i < kTries; ++i) {
    id = static_cast<VoxelId>(random.below(esdf.layout.voxel_count()));
    if (roadmap.attach.next[id] != AttachField::kNotTraversable) break;
  }
  return to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
}

}  // namespace

LiveQueryLoad::LiveQueryLoad(const LiveRoadmap& live, std::size_t allowed, std::uint64_t seed,
                             LiveQueries& results)
    : results_(results), allowed_(allowed), thread_([this, &live, seed] {
        try {
          run(live, seed);
        } catch (...) {
          const std::lock_guard lock(mutex_);
          error_ = std::current_exception();
        }
      }) {}

LiveQueryLoad::~LiveQueryLoad() { end(End::kNow); }

void LiveQueryLoad::allow(std::size_t queries) {
  {
    const std::lock_guard lock(mutex_);
    allowed_ = queries;
  }
  changed_.notify_one();
}

void LiveQueryLoad::end(End when) {
  {
    const std::lock_guard lock(mutex_);
    end_ = when;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void LiveQueryLoad::finish() {
  end(End::kWhenAllAreAsked);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void LiveQueryLoad::ask_again() {
  end(End::kNow);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  for (const Asked& asked : asked_) {
    const double start = detail::thread_seconds_now();
    plan(*asked.roadmap, asked.start, asked.goal);
    results_.alone.push_back(detail::thread_seconds_now() - start);
  }
}

std::shared_ptr<const Roadmap> LiveQueryLoad::wait_for_next(const LiveRoadmap& live) {
  constexpr std::chrono::milliseconds kPause{2};  // a first snapshot tells nobody that it is there
  std::unique_lock lock(mutex_);
  while (end_ != End::kNow) {
    const bool is_allowed = results_.asked < allowed_;
    if (is_allowed)
      if (std::shared_ptr<const Roadmap> now = live.snapshot()) return now;
    if (end_ == End::kWhenAllAreAsked) break;
    if (is_allowed)
      changed_.wait_for(lock, kPause);
    else
      changed_.wait(lock);
  }
  return nullptr;
}

/// So that those that are kept are as likely of any time of the flight.
void LiveQueryLoad::keep(const Asked& asked, double seconds, Random& random) {
  if (asked_.size() < kMostKept) {
    results_.meanwhile.push_back(seconds);
    asked_.push_back(asked);
  } else if (const std::uint64_t place = random.below(results_.asked); place < kMostKept) {
    results_.meanwhile[place] = seconds;
    asked_[place] = asked;
  }
}

void LiveQueryLoad::run(const LiveRoadmap& live, std::uint64_t seed) {
  Random random(seed, 1), chosen(seed, 2);
  while (const std::shared_ptr<const Roadmap> now = wait_for_next(live)) {
    const Asked asked{now, random_place(*now, random), random_place(*now, random)};
    const double start = detail::thread_seconds_now();
    const PlanResult path = plan(*now, asked.start, asked.goal);
    const double seconds = detail::thread_seconds_now() - start;
    ++results_.asked;
    results_.solved += path.ok();
    results_.wrong += path.ok() && !still_safe(path.waypoints, now->min_clearance, *now);
    keep(asked, seconds, chosen);
  }
}

}  // namespace ridgeway
