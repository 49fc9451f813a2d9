// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ridgeway {

/// Something that a caller handed in is bad. Functions with a Progress throw Cancelled besides;
/// that memory is not enough, and defects of the library itself, are told by exceptions of std.
/// Outcomes of planning ("no route") are values, never exceptions.
class InputError : public std::runtime_error {
 public:
  /// `what_went_wrong`: the defect; `where`: the file, field or value that has it;
  /// `remedy`: what the caller can do about it.
  InputError(const std::string& where, const std::string& what_went_wrong,
             const std::string& remedy)
      : std::runtime_error(where + ": " + what_went_wrong + " (" + remedy + ")"),
        where_(where),
        problem_(what_went_wrong),
        remedy_(remedy) {}

  /// The same, found in something larger: a file that has the field, a recording that has the pose.
  InputError within(const std::string& whole) const {
    return {whole + " " + where_, problem_, remedy_};
  }

  /// The file, field or value that is bad.
  const std::string& where() const noexcept { return where_; }
  /// What is wrong with it.
  const std::string& problem() const noexcept { return problem_; }
  /// What the caller can do about it.
  const std::string& remedy() const noexcept { return remedy_; }

 private:
  std::string where_;
  std::string problem_;
  std::string remedy_;
};

/// Thrown out of a long stage when the caller's progress callback asks to stop.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled by the caller") {}
};

/// Called by long stages, from the calling thread, with the stage's name and the share done in
/// [0, 1]: at its beginning, and by those that can be cancelled anywhere (with_progress) some
/// twenty times a second meanwhile. Return false to cancel: the stage then throws `Cancelled`.
using Progress = std::function<bool(std::string_view stage, double share)>;

}  // namespace ridgeway
