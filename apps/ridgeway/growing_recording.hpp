// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "console.hpp"
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
      for (const DepthFrame& frame : sequence.frames)
        if ((is_over_ || frame.time.value_or(0.0) <= sequence.poses_until) &&
            !done_.contains(frame.image.string()))
          next.push_back(frame);
      if (!next.empty()) return true;
      if (is_over_) break;
      bar.show("wait", 0.0);
      std::this_thread::sleep_for(kPause);
    }
    return false;
  }
  /// What is the matter with what follows the frames that were found; empty: nothing.
  const std::string& ending() const { return ending_; }
  void done(const DepthFrame& frame) { done_.insert(frame.image.string()); }
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
  const std::string until_;  // the last frame's name; empty: there is none
  std::set<std::string> done_;
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
