// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <ios>
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

/// How far the lists of a recording have been written. A line that is cut short may be one of
/// another pose: half a number is a number.
struct ListsSeen {
  std::vector<std::streamoff> bytes;
  bool end_with_lines = true;

  static ListsSeen of(const std::filesystem::path& folder) {
    ListsSeen seen;
    for (const char* name : {"depth.txt", "groundtruth.txt", "trajectory.log"}) {
      std::error_code error;  // a pipe would be waited for
      if (!std::filesystem::is_regular_file(folder / name, error)) continue;
      std::ifstream list(folder / name, std::ios::binary | std::ios::ate);
      const auto size = static_cast<std::streamoff>(list.tellg());
      seen.bytes.push_back(size);
      if (size > 0 && list.seekg(-1, std::ios::end) && list.get() != '\n')
        seen.end_with_lines = false;
    }
    return seen;
  }
};

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
    for (;;) {
      next.clear();
      try {
        const ListsSeen before = ListsSeen::of(folder_);
        sequence = open_sequence(folder_, {});
        const bool is_whole = before.end_with_lines && before.bytes == ListsSeen::of(folder_).bytes;
        // A last line that stays as it is has no end of its own.
        if (is_whole || idle.seconds() >= patience_)
          for (const DepthFrame& frame : sequence.frames)
            if (!done_.contains(frame.image.string())) next.push_back(frame);
      } catch (const InputError&) {  // nothing yet, or a line that is not whole
        if (idle.seconds() >= patience_) throw;
      }
      if (!next.empty()) return true;
      if (idle.seconds() >= patience_) return false;
      bar.show("wait", 0.0);
      std::this_thread::sleep_for(kPause);
    }
  }
  void done(const DepthFrame& frame) { done_.insert(frame.image.string()); }
  bool is_last(const DepthFrame& frame) const {
    return !until_.empty() && frame.image.filename() == until_;
  }

 private:
  static constexpr std::chrono::milliseconds kPause{100};

  const std::string folder_;
  const double patience_;
  const std::string until_;  // the last frame's name; empty: there is none
  std::set<std::string> done_;
};

/// Of an image that is still being written, once it is whole; nothing, and what is the matter, for
/// one that never is.
inline std::optional<DepthImage> read_when_whole(const DepthSequence& sequence,
                                                 const DepthFrame& frame, double longest,
                                                 std::string& problem) {
  const Stopwatch watch;
  for (;;) {
    try {
      return read_frame(sequence, frame);
    } catch (const InputError& error) {  // real recordings have damaged ones
      problem = error.what();
      if (watch.seconds() >= std::min(longest, 1.0)) return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace ridgeway::cli
