// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "command.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/planning/check.hpp"

namespace ridgeway::cli {

// Results, on stdout.
void print_json(const nlohmann::ordered_json& json);
void print_row(std::string_view label, const std::string& value);

// For a person, on stderr.
/// The text as a terminal may show it: what would move the cursor, set a title or end the text
/// stands as \x1b; what is no UTF-8 too.
std::string printable(std::string_view text);
void note(const Globals& globals, const std::string& text);
void warn(const Globals& globals, const std::string& text);
/// Warns where a file that nothing was written to is there from before; tells whether it is.
bool warn_of_unwritten(const Globals& globals, const std::filesystem::path& file);

// Numbers as a person reads them.
std::string text_of(double value, int decimals = 3);  ///< without trailing zeros
double rounded_down(double value);                    ///< to three decimals
double rounded_up(double value);                      ///< likewise
std::string count_text(std::uint64_t count);          ///< 1,234,567
std::string bytes_text(std::uint64_t bytes);          ///< 1.2 MB
std::string seconds_text(double seconds);             ///< 1.23 s, 4.5 ms
std::string point_text(const Point& p);               ///< 1,-2.5,0.7

nlohmann::ordered_json json_of(const Point& p);
nlohmann::ordered_json json_of(const Box& box);
nlohmann::ordered_json json_of(const Spread& spread);

/// One line of progress on stderr, if that is a terminal and nobody asked for quiet.
class ProgressBar {
 public:
  explicit ProgressBar(const Globals& globals);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Throws Cancelled once the user has asked for an end.
  void show(std::string_view stage, double share);
  void clear();
  /// For the stages of the library, which it cancels; the bar must outlive it.
  Progress callback();

 private:
  void draw(std::string_view stage, double share);

  bool enabled_;
  bool visible_ = false;
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Resident, of this program.
std::uint64_t peak_memory_bytes();

}  // namespace ridgeway::cli
