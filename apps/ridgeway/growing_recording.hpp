// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "console.hpp"
#include "files/natural_order.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway::cli {

/// Frames of a folder that may still be written to: each once, those first that come first.
class GrowingRecording {
 public:
  /// `patience`: seconds to wait for the next frame.
  GrowingRecording(std::string folder, double patience, std::string until)
      : folder_(std::move(folder)), patience_(patience), until_(std::move(until)) {}

  /// The next frames; false where none came for as long as the user waits. `bar`: asked meanwhile
  /// whether the user still does.
  bool find(DepthSequence& sequence, std::vector<DepthFrame>& next, ProgressBar& bar) {
    const Stopwatch idle;
    next.clear();
    while (!is_over_) {
      const bool has_last = open(sequence, true);
      // Where the last frame is listed, only poses of it and of those before it can still come.
      is_over_ = idle.seconds() >= (has_last ? std::min(patience_, 1.0) : patience_);
      if (is_over_) open_at_the_end(sequence);
      for (const DepthFrame& frame : sequence.frames) {
        if (!is_over_ && frame.time.value_or(0.0) > sequence.poses_until) continue;
        if (done_.contains(frame.image.string())) continue;
        if (!is_over_ && !is_next(frame)) break;
        next.push_back(frame);
      }
      if (!next.empty()) return true;
      if (is_over_) break;
      bar.show("wait", 0.0);
      std::this_thread::sleep_for(kPause);
    }
    return false;
  }
  /// What is the matter with what follows the frames that were found; empty: nothing.
  const std::string& ending() const { return ending_; }
  /// How many frames were taken with another pose than they have at the end.
  std::size_t moved(const DepthSequence& sequence) const {
    return static_cast<std::size_t>(
        std::count_if(sequence.frames.begin(), sequence.frames.end(), [&](const DepthFrame& frame) {
          const auto taken = done_.find(frame.image.string());
          return taken != done_.end() &&
                 !taken->second.isApprox(frame.T_world_camera.matrix(), 1e-9);
        }));
  }
  void done(const DepthFrame& frame) {
    done_.emplace(frame.image.string(), frame.T_world_camera.matrix());
  }
  bool is_last(const DepthFrame& frame) const {
    return !until_.empty() && frame.image.filename() == std::filesystem::path(until_).filename();
  }

 private:
  static constexpr std::chrono::milliseconds kPause{100};

  /// What the folder holds so far; whether the last frame is among it.
  bool open(DepthSequence& sequence, bool is_growing) {
    sequence.frames.clear();
    try {
      sequence = open_sequence(folder_, {.is_growing = is_growing});
    } catch (const InputError&) {
      if (!is_growing) throw;
      return false;  // nothing yet
    }
    return std::any_of(sequence.frames.begin(), sequence.frames.end(),
                       [&](const DepthFrame& frame) { return is_last(frame); });
  }

  /// Whether a frame follows the one before, by the numbers in their names where images have no
  /// times: one that is missing between them, or its pose, is waited for for a second.
  bool is_next(const DepthFrame& frame) {
    if (frame.time || patience_ == 0.0) return true;
    const auto number = last_number(frame.image.stem().string());
    if (!number) return true;
    const std::int64_t step = last_ ? *number - *last_ : 1;
    if (step > step_) {
      if (!missing_since_) missing_since_.emplace();
      if (missing_since_->seconds() < std::min(patience_, 1.0)) return false;
    }
    missing_since_.reset();
    last_ = std::max(last_.value_or(*number), *number);
    step_ = std::max<std::int64_t>(step, 1);
    return true;
  }

  /// All that it holds, a last line without an end too; where that is wrong, what came before it.
  void open_at_the_end(DepthSequence& sequence) {
    const DepthSequence whole = sequence;
    try {
      open(sequence, false);
    } catch (const InputError& error) {
      const bool is_followed = patience_ > 0.0;  // else what is wrong is wrong
      if (!is_followed || (whole.frames.empty() && done_.empty())) throw;
      ending_ = error.what();
      sequence = whole;
    }
  }

  const std::string folder_;
  const double patience_;
  const std::string until_;                      // the last frame's name; empty: there is none
  std::map<std::string, Eigen::Matrix4d> done_;  // image to pose
  std::optional<std::int64_t> last_;             // of the images that were taken
  std::int64_t step_ = 1;                        // between the last two
  std::optional<Stopwatch> missing_since_;
  std::string ending_;
  bool is_over_ = false;
};

/// Whether a later image than that of a frame is there.
inline bool is_overtaken(const DepthSequence& sequence, const DepthFrame& frame) {
  const auto at = std::find_if(sequence.frames.begin(), sequence.frames.end(),
                               [&](const DepthFrame& one) { return one.image == frame.image; });
  return at != sequence.frames.end() &&
         std::any_of(at + 1, sequence.frames.end(), [](const DepthFrame& later) {
           std::error_code unused;
           return std::filesystem::exists(later.image, unused);
         });
}

/// Of an image that is still to come or being written, once it is whole; nothing, and what is the
/// matter, for one that never is. `longest`: seconds to wait for it to come; at most one once it is
/// there, or one after it.
inline std::optional<DepthImage> read_when_whole(const DepthSequence& sequence,
                                                 const DepthFrame& frame, double longest,
                                                 ProgressBar& bar, std::string& problem) {
  const Stopwatch since_asked;
  Stopwatch since_there;
  for (;;) {
    try {
      return read_frame(sequence, frame);
    } catch (const InputError& error) {  // real recordings have damaged ones
      problem = error.what();
    }
    std::error_code unused;
    if (!std::filesystem::exists(frame.image, unused) && !is_overtaken(sequence, frame))
      since_there = Stopwatch();
    if (since_asked.seconds() >= longest || since_there.seconds() >= std::min(longest, 1.0))
      return std::nullopt;
    bar.show("wait", 0.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace ridgeway::cli
