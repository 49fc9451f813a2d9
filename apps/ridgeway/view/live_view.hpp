// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"
#include "view/map_answers.hpp"

namespace ridgeway::cli {

/// A map that grows, as it is after a scan.
struct LiveScene {
  std::shared_ptr<const Roadmap> roadmap = {};  ///< none as long as the robot fits nowhere
  Point position = Point::Zero();               ///< of the sensor, or of the drone that carries it
  double yaw = 0.0;                             ///< where it looks, radians
  std::vector<Point> ahead = {};                ///< where it is going to fly; may be empty
  std::size_t scan = 0;                         ///< counted from 1
  std::optional<std::size_t> scans = {};        ///< how many there will be, if that is known
  double seconds = 0.0;  ///< from the first scan on: of the flight, or of the run
  bool is_last = false;
};

/// The newest scene of a run, for those who look. Who shows waits for nobody; who looks gets the
/// newest, and not what there was in between. Thread-safe.
class LiveView {
 public:
  /// `name`: of the map, for people.
  explicit LiveView(const std::string& name);

  void show(LiveScene scene);

  /// What a page has of a run so far.
  struct Seen {
    std::uint64_t version = 0;
    std::size_t positions = 0;
  };
  struct Update {
    LiveScene scene;
    std::vector<Point> positions;  ///< those that have not been seen, in order
  };
  /// What is newer than what was seen, which is brought up to date; nothing where that takes
  /// longer.
  std::optional<Update> next(Seen& seen, std::chrono::milliseconds patience);

  /// As MapAnswers, of the newest map; 503 as long as there is none.
  Reply answer(const Question& question);

 private:
  /// Answers of a snapshot, which they keep.
  struct Snapshot {
    Snapshot(std::shared_ptr<const Roadmap> of, const std::string& name)
        : roadmap(std::move(of)), answers(*roadmap, name) {}
    const std::shared_ptr<const Roadmap> roadmap;
    MapAnswers answers;
  };
  std::shared_ptr<Snapshot> newest();

  const std::string name_;
  std::mutex mutex_;  // of what follows
  std::condition_variable shown_;
  std::uint64_t version_ = 0;
  LiveScene scene_;
  std::vector<Point> positions_;
  std::shared_ptr<Snapshot> snapshot_;
};

}  // namespace ridgeway::cli
